#pragma once
/// Reads isolators of frames and of shear buildings.

#include <pounding/input/input.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {

/// Reads a section `isolator` but for `coupled`. Numbers that a law needs are there; what they may be, the weight on it
/// apart, is checked. Throws InputError at the place of what is wrong.
IsolatorOptions read_isolator_law(const Input& isolator);

}  // namespace pounding
