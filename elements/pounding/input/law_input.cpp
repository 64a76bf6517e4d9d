#include <pounding/input/law_input.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/laws/all.hpp>

namespace pounding {
namespace {

// A zero is left to the law, which says what it means or which laws take it.
double read_restitution(const Input& node, const laws::Entry& entry) {
  if (node.as_quantity(dimension::none) == 0) return 0;
  return node.as_quantity(dimension::none, entry.sticks_at_zero ? bounds::from_0_to_1 : bounds::above_0_to_1);
}

}  // namespace

laws::Settings read_law(const Input& link, std::span<const std::string_view> link_keys) {
  std::vector<std::string_view> names;
  for (const laws::Entry& entry : laws::catalogue()) names.push_back(entry.name);
  laws::Settings settings;
  const Input law_node = link.at("law", "hertz_damped");
  settings.law = law_node.as_choice("law", names);
  const laws::Entry& entry = laws::find_law(settings.law);

  std::vector<std::string_view> keys(link_keys.begin(), link_keys.end());
  keys.insert(keys.end(), {"law", "formula", "restitution", "impact_velocity", "reduced_mass"});
  for (const laws::ParameterInfo& parameter : entry.parameters) keys.push_back(parameter.name);
  link.only_keys(keys);

  double exponent = 1.5;
  if (const auto node = link.find("exponent")) exponent = node->as_number(bounds::positive);
  for (const laws::ParameterInfo& parameter : entry.parameters)
    if (laws::must_be_given(entry.parameters, parameter, [&](std::string_view name) { return link.has(name); }) &&
        !link.has(parameter.name))
      law_node.fail(fmt::format("{0} needs {1} ({2}); type {1}: {3:g} {4}", settings.law, parameter.name, parameter.meaning,
                                parameter.typical, laws::resolved_unit(parameter.unit, exponent)));

  if (const auto restitution = link.find("restitution"))
    settings.restitution = read_restitution(*restitution, entry);
  if (const auto velocity = link.find("impact_velocity"))
    settings.impact_velocity = velocity->as_quantity(dimension::velocity, bounds::positive);
  if (const auto formula = link.find("formula")) {
    std::vector<std::string_view> formulas;
    for (const laws::Formula& each : entry.formulas) formulas.push_back(each.name);
    if (formulas.empty()) formula->fail_at_key(fmt::format("the law {} has no damping formula; leave it out", settings.law));
    settings.formula = formula->as_choice(fmt::format("formula of {}", settings.law), formulas);
  }
  // A unit such as "N/m^n" depends on the exponent that the link chose.
  for (const laws::ParameterInfo& parameter : entry.parameters)
    if (const auto node = link.find(parameter.name))
      settings.values.emplace(
          std::string(parameter.name),
          node->as_quantity(parse_unit_dimension(laws::resolved_unit(parameter.unit, exponent))));
  return settings;
}

Input place_of_law(const std::string& refusal, const Input& link) {
  const Input law = link.at("law");
  const laws::Entry& entry = laws::find_law(law.as_text());
  std::vector<std::string_view> keys{"formula", "restitution", "impact_velocity", "reduced_mass"};
  for (const laws::ParameterInfo& parameter : entry.parameters) keys.push_back(parameter.name);
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz_";
  for (std::size_t begin = 0; (begin = refusal.find_first_of(letters, begin)) != std::string::npos;) {
    const std::size_t end = std::min(refusal.find_first_not_of(letters, begin), refusal.size());
    const std::string_view word = std::string_view(refusal).substr(begin, end - begin);
    if (std::find(keys.begin(), keys.end(), word) != keys.end())
      if (const auto found = link.find(word)) return *found;
    begin = end;
  }
  return law;
}

}  // namespace pounding
