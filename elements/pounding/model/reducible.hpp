#pragma once
/// Structures of a model that cannot be reduced.

#include <string>

#include <pounding/model/model.hpp>

namespace pounding {

/// Maximum number of unknowns with mass up to which all natural modes are used by default, which is exact.
inline constexpr int small_structure = 500;

/// Reduction of a structure: its own, otherwise that of the model.
Reduction reduction_of(const Model& model, int structure);

/// Reason why a structure cannot be reduced, with what to type if another law or damping helps; empty if it can.
std::string why_not_reduced(const Model& model, int structure);

/// Reason why the requested check of a structure in all unknowns is not possible, with what to type; empty if it is, or
/// if none is requested.
std::string why_not_checked(const Model& model, int structure);

}  // namespace pounding
