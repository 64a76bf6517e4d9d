#pragma once
/// Estimates of the stiffness of a contact in the input.

#include <optional>

#include <pounding/input/input.hpp>
#include <pounding/model/contact_stiffness.hpp>

namespace pounding {

/// Whether a stiffness is given as `auto` or as a map, which an estimate follows from.
bool is_estimate(const Input& node);
/// The estimate that `stiffness: auto` or a map asks for; nothing for a number. Throws InputError at what is wrong.
std::optional<StiffnessEstimate> read_stiffness_estimate(const Input& node);

}  // namespace pounding
