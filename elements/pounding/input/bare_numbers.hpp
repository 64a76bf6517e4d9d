#pragma once
/// Numbers of an input that are far from those of buildings, mostly because their unit is missing.

#include <vector>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Doubts about the numbers of a complete input, as they are typed: a bare `pga: 0.35`, which is 0.036 g; `floor_mass:
/// 90`, which is 90 kg and disappears beside the mass of the members; densities, damping ratios, factors on inertias,
/// heights and numbers of isolators. One doubt per key; an input that read_model() refuses may throw InputError.
std::vector<Warning> doubtful_numbers(const Input& input);

}  // namespace pounding
