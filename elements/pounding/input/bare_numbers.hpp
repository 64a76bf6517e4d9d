#pragma once
/// Detects numbers in an input that are implausible for buildings, usually because of a missing unit.

#include <vector>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Warnings about implausible numbers as typed: `pga: 0.35` without a unit, which is 0.036 g; `floor_mass: 90`, which
/// is 90 kg; densities, damping ratios, stiffness factors, heights and isolator parameters. One warning per key. May
/// throw InputError for an input that read_model() does not accept.
std::vector<Warning> doubtful_numbers(const Input& input);

}  // namespace pounding
