#pragma once
/// Estimates of the contact stiffness in the input.

#include <optional>

#include <pounding/input/input.hpp>
#include <pounding/model/contact_stiffness.hpp>

namespace pounding {

/// True if the stiffness is `auto` or a map, and therefore estimated.
bool is_estimate(const Input& node);
/// The estimate for `stiffness: auto` or a map; `nullopt` for a number. Throws InputError with the location.
std::optional<StiffnessEstimate> read_stiffness_estimate(const Input& node);

}  // namespace pounding
