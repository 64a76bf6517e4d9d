#pragma once
/// Hysteretic laws by name, for any variant of them: the catalogue, and creation of a law from settings. All data are
/// read from the tables of the laws. all.hpp applies it to the laws of this library.

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/laws/entry.hpp>
#include <pounding/laws/excerpt.hpp>
#include <pounding/laws/nearest_name.hpp>

namespace pounding::hysteresis::by_name {

using laws::by_name::names;

/// The `info` of each row of a table.
template <auto& table>
inline constexpr auto infos = [] {
  std::array<decltype(table[0].info), table.size()> result{};
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = table[i].info;
  return result;
}();

/// Catalogue entry of a law, from its members.
template <Law L>
constexpr Entry entry() {
  Entry e{.name = L::name,
          .shape = L::shape,
          .summary = L::summary,
          .source = L::source,
          .symbols = L::symbols,
          .range = L::range,
          .beware = L::beware,
          .parameters = infos<L::parameters>,
          .choices = {},
          .state = infos<L::state>,
          .has_corners = has_corners<L>};
  if constexpr (requires { L::choices; }) e.choices = infos<L::choices>;
  if constexpr (requires { L::is_symmetric; }) e.is_symmetric = L::is_symmetric;
  return e;
}

/// Entries of all laws of a variant.
template <class Any>
struct List;
template <class... L>
struct List<std::variant<L...>> {
  static constexpr std::array<Entry, sizeof...(L)> entries{entry<L>()...};
};

/// Sets a number by name, value in SI units. Throws std::invalid_argument if the law has no such parameter.
template <Law L>
void set(L& law, std::string_view name, double value) {
  for (const Parameter<L>& p : L::parameters) {
    if (p.info.name != name) continue;
    if (p.value)
      law.*p.value = value;
    else
      law.*p.choice = value;
    return;
  }
  throw std::invalid_argument(std::string(L::name) + " has no parameter \"" + laws::excerpt(name) + "\"." +
                              laws::suggestion(name, names(infos<L::parameters>)));
}

/// Sets a choice to a keyword. Throws std::invalid_argument for an unknown name or keyword.
template <Law L>
void choose(L& law, std::string_view name, std::string_view word) {
  std::vector<std::string_view> known;
  if constexpr (requires { L::choices; })
    for (const Choice<L>& choice : L::choices) {
      known.push_back(choice.info.name);
      if (choice.info.name != name) continue;
      for (std::size_t i = 0; i < choice.info.words.size(); ++i)
        if (choice.info.words[i] == word) return choice.set(law, i);
      throw std::invalid_argument(std::string(name) + " of " + std::string(L::name) + " cannot be \"" +
                                  laws::excerpt(word) + "\"." + laws::suggestion(word, choice.info.words));
    }
  throw std::invalid_argument(std::string(L::name) + " has no parameter \"" + laws::excerpt(name) +
                              "\" that takes a keyword." + laws::suggestion(name, known));
}

/// Creates a validated law L. Throws std::invalid_argument for a setting that is missing, unknown or out of range.
template <Law L>
L make(const Settings& s) {
  L law;
  for (const auto& [name, value] : s.values) set(law, name, value);
  for (const auto& [name, word] : s.words) choose(law, name, word);
  for (const ParameterInfo& p : infos<L::parameters>)
    if (p.need == Need::required && !s.values.contains(p.name))
      throw std::invalid_argument(std::string(L::name) + " needs " + std::string(p.name) + " (" +
                                  std::string(p.meaning) + ")");
  law.check();
  return law;
}

/// Creates the validated law of the variant Any with the name in the settings. Throws like make, and for an unknown
/// name.
template <class Any, std::size_t I = 0>
Any make_any(const Settings& s) {
  if constexpr (I == std::variant_size_v<Any>) {
    throw std::invalid_argument("unknown law of yielding \"" + laws::excerpt(s.law) + "\"." +
                                laws::suggestion(s.law, names(List<Any>::entries)));
  } else {
    using L = std::variant_alternative_t<I, Any>;
    if (s.law == L::name) return Any(std::in_place_index<I>, make<L>(s));
    return make_any<Any, I + 1>(s);
  }
}

}  // namespace pounding::hysteresis::by_name
