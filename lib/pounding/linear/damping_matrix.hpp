#pragma once
/// Damping matrix of structures solved with assembled matrices.

#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// C without Rayleigh damping. Forms the full matrix of modal damping if the system has none. Throws
/// std::invalid_argument for a group with more modes than max_for_modal_damping.
SparseMatrix damping_matrix(const System& system);

}  // namespace pounding::petsc
