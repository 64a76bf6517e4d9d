#pragma once
/// Reads the hysteretic law of storeys.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/input/input.hpp>
#include <pounding/structures/yielding_law.hpp>

namespace pounding {

/// Adds a list parameter, or its only item, to the values of a law: "force[1]", "force[2]".
template <class Values>
void read_list(const Input& list, Values& values) {
  if (!list.is_list()) {
    values.emplace(list.key(), list.as_quantity());
    return;
  }
  for (std::size_t i = 0; const Input& item : list.items())
    values.emplace(laws::item_name(list.key(), i++), item.as_quantity());
}

/// The hysteretic law whose name is a key of this map; null if there is none. Throws InputError for a second one;
/// `what` names the owner in the message: "a storey".
const hysteresis::Entry* law_among_keys(const Input& map, const char* what);

/// The choices of a law that are given in its map.
std::map<std::string, std::string, std::less<>> read_choices(const Input& law, const hysteresis::Entry& entry);

/// Location of an error of the law: the key that the text begins with, else the law.
Input location_of(const std::string& refusal, const Input& law, const hysteresis::Entry& entry);

/// Reads the section `spring` for storeys with these stiffnesses [N/m]; `first_storey` is the number of the first one.
/// Throws InputError with the location.
SpringOptions read_storey_spring(const Input& spring, const std::vector<double>& stiffness, int first_storey = 1);

}  // namespace pounding
