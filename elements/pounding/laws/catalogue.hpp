#pragma once
/// Catalogue of laws by name: contact laws or hysteretic laws, from the tables of the laws.

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <pounding/base/excerpt.hpp>
#include <pounding/base/nearest_name.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// The `name` of each item.
template <class Range>
std::vector<std::string_view> names(const Range& range) {
  std::vector<std::string_view> result;
  for (const auto& item : range) result.push_back(item.name);
  return result;
}

/// Sets a parameter by name, value in SI. Throws std::invalid_argument if the law has no such parameter.
template <class L>
void set(L& law, std::string_view name, double value) {
  for (const Parameter<L>& p : L::parameters)
    if (p.info.name == name) return p.set(law, value);
  throw std::invalid_argument(std::string(L::name) + " has no parameter \"" + excerpt(name) + "\"." +
                              suggestion(name, names(infos<L::parameters>)));
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
