#pragma once
/// Reads the damping of a structure.

#include <pounding/input/input.hpp>
#include <pounding/structures/structure_damping.hpp>

namespace pounding {

/// Reads `damping` of a structure that is not rigid: a ratio, or a map with one damping model. Throws InputError with
/// the location.
Damping read_damping(const Input& node, const Structure& s);

}  // namespace pounding
