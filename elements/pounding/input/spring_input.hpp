#pragma once
/// Reads the law by which storeys yield.

#include <vector>

#include <pounding/input/input.hpp>
#include <pounding/structures/yielding_law.hpp>

namespace pounding {

/// Reads the section `spring`, for storeys with these stiffnesses [N/m]. Throws InputError at the place of what is missing, unknown or out
/// of range.
SpringOptions read_storey_spring(const Input& spring, const std::vector<double>& stiffness);

}  // namespace pounding
