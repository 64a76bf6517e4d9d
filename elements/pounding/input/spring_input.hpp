#pragma once
/// Reads the law by which storeys yield.

#include <vector>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/input/input.hpp>
#include <pounding/structures/yielding_law.hpp>

namespace pounding {

/// The law of yielding whose name is a key of this map; nullptr for none. `what` follows it, for the refusal of a second one: "a storey".
const hysteresis::Entry* law_among_keys(const Input& map, const char* what);

/// Reads the section `spring`, for storeys with these stiffnesses [N/m]. Throws InputError at the place of what is missing, unknown or out
/// of range.
SpringOptions read_storey_spring(const Input& spring, const std::vector<double>& stiffness);

}  // namespace pounding
