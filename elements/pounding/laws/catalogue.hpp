#pragma once
/// Catalogue of laws by name: contact laws or hysteretic laws, from the tables of the laws.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <pounding/base/excerpt.hpp>
#include <pounding/base/nearest_name.hpp>
#include <pounding/laws/points.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// The `name` of each item.
template <class Range>
std::vector<std::string_view> names(const Range& range) {
  std::vector<std::string_view> result;
  for (const auto& item : range) result.push_back(item.name);
  return result;
}

/// Sets a parameter by name, value in SI; "force[2]" is the second item of a list. Throws std::invalid_argument if the
/// law has no such parameter.
template <class L>
void set(L& law, std::string_view name, double value) {
  const auto item = list_item(name);
  for (const Parameter<L>& p : L::parameters) {
    if (p.info.name == name) return p.set(law, value);
    if (item && p.list && p.info.name == item->first) return p.set_item(law, item->second, value);
  }
  throw std::invalid_argument(std::string(L::name) + " has no parameter \"" + excerpt(name) + "\"." +
                              suggestion(name, names(infos<L::parameters>)));
}

/// Throws std::invalid_argument for a list that is given by its plain name and also item by item.
template <class Values>
void refuse_mixed_lists(std::span<const ParameterInfo> parameters, const Values& values) {
  for (const ParameterInfo& p : parameters) {
    if (!p.is_list() || !values.contains(p.name)) continue;
    for (const auto& each : values)
      if (each.first != p.name && parameter_name(each.first) == p.name)
        throw std::invalid_argument(std::string(p.name) + " is given as one value and as a list; keep one of the two");
  }
}

/// Values of a law with the typical values of the parameters that `wanted` selects, by name; lists item by item.
template <class Values, class Wanted>
void add_typical(std::span<const ParameterInfo> parameters, Values& values, Wanted&& wanted) {
  for (const ParameterInfo& p : parameters) {
    if (!wanted(p)) continue;
    if (!p.is_list()) values.emplace(p.name, p.typical);
    for (std::size_t i = 0; i < p.typical_list.size(); ++i) values.emplace(item_name(p.name, i), p.typical_list[i]);
  }
}

/// Laws of a variant. The namespace of `Settings` and `Entry` provides law_from<L>(settings), which returns a validated
/// law, and unknown_law(name, entries), which returns an error message.
template <class Settings, class Entry, class Any>
struct Catalogue;
template <class Settings, class Entry, class... L>
struct Catalogue<Settings, Entry, std::variant<L...>> {
  static constexpr std::array<Entry, sizeof...(L)> entries{Entry::template of<L>()...};

  /// Entry by name. Throws std::invalid_argument, with the nearest known name, if there is none.
  static const Entry& find(std::string_view name) {
    const auto named = std::ranges::find(entries, name, &Entry::name);
    if (named == entries.end()) throw std::invalid_argument(unknown_law(name, std::span<const Entry>(entries)));
    return *named;
  }
  /// Creates a validated law. Throws like find() and law_from().
  static std::variant<L...> make(const Settings& settings) {
    find(settings.law);
    std::optional<std::variant<L...>> law;
    ((settings.law == L::name && (law = law_from<L>(settings), true)) || ...);
    return *law;
  }
};

}  // namespace pounding::laws
