#pragma once
/// Reads the law by which storeys yield.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/input/input.hpp>
#include <pounding/structures/yielding_law.hpp>

namespace pounding {

/// The law of yielding whose name is a key of this map; nullptr for none. `what` follows it, for the refusal of a
/// second one: "a storey".
const hysteresis::Entry* law_among_keys(const Input& map, const char* what);

/// The numbers of a law that are chosen by words, as they are given in its map.
std::map<std::string, std::string, std::less<>> read_choices(const Input& law, const hysteresis::Entry& entry);

/// The key of the law that a refusal begins with, or the law itself.
Input location_of(const std::string& refusal, const Input& law, const hysteresis::Entry& entry);

/// Reads the section `spring`, for storeys with these stiffnesses [N/m], the first of which has this number. Throws
/// InputError at the place of what is missing, unknown or out of range.
SpringOptions read_storey_spring(const Input& spring, const std::vector<double>& stiffness, int first_storey = 1);

}  // namespace pounding
