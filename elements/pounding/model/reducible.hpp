#pragma once
/// Which structures of a model cannot be reduced.

#include <string>

#include <pounding/model/model.hpp>

namespace pounding {

/// Unknowns with mass of a structure up to which all its natural modes are taken without being asked for: that is
/// exact.
inline constexpr int small_structure = 500;

/// The reduction that a structure has by itself, else that of the model.
Reduction reduction_of(const Model& model, int structure);

/// Why a structure cannot be reduced, with what to type where another law or damping helps; empty where it can.
std::string why_not_reduced(const Model& model, int structure);

/// Why all unknowns of a structure that is asked to be checked cannot be stepped through its impacts, with what to
/// type; empty where they can, and where nothing is asked.
std::string why_not_checked(const Model& model, int structure);

}  // namespace pounding
