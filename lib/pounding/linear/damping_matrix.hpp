#pragma once
/// The damping of structures that are solved by matrices.

#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// C without the Rayleigh damping. Forms the full matrix of modal damping where the system has none; throws
/// std::invalid_argument for a group of more modes than max_for_modal_damping.
SparseMatrix damping_matrix(const System& system);

}  // namespace pounding::petsc
