#pragma once
/// Reads isolators of frames and of shear buildings.

#include <pounding/input/input.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {

/// Reads the section `isolator`, except `coupled`. Checks all parameters except the weight. Throws InputError with the
/// location.
IsolatorOptions read_isolator_law(const Input& isolator);

}  // namespace pounding
