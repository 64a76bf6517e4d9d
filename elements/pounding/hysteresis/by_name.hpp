#pragma once
/// Hysteretic laws by name, for any variant of them: the catalogue, and creation of a law from settings. All data are
/// read from the tables of the laws. all.hpp applies it to the laws of this library.

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/hysteresis/entry.hpp>

namespace pounding::hysteresis {

/// Catalogue entry of a law, from its members.
template <Law L>
constexpr Entry Entry::of() {
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
          .has_corners = hysteresis::has_corners<L>};
  if constexpr (requires { L::choices; }) e.choices = infos<L::choices>;
  if constexpr (requires { L::is_symmetric; }) e.is_symmetric = L::is_symmetric;
  if constexpr (requires { L::replaced_by; }) e.replaced_by = L::replaced_by;
  return e;
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
      throw std::invalid_argument(std::string(name) + " of " + std::string(L::name) + " cannot be \"" + excerpt(word) +
                                  "\"." + suggestion(word, choice.info.words));
    }
  throw std::invalid_argument(std::string(L::name) + " has no parameter \"" + excerpt(name) +
                              "\" that takes a keyword." + suggestion(name, known));
}

/// Creates a validated law L. Throws std::invalid_argument for a setting that is missing, unknown or out of range.
template <Law L>
L law_from(const Settings& s) {
  L law;
  for (const auto& [name, value] : s.values) laws::set(law, name, value);
  for (const auto& [name, word] : s.words) choose(law, name, word);
  for (const ParameterInfo& p : infos<L::parameters>)
    if (p.need == Need::required && !laws::is_given(s.values, p.name))
      throw std::invalid_argument(std::string(L::name) + " needs " + std::string(p.name) + " (" +
                                  std::string(p.meaning) + ")");
  laws::refuse_mixed_lists(infos<L::parameters>, s.values);
  law.check();
  return law;
}

}  // namespace pounding::hysteresis
