#include <pounding/input/law_input.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/input/fail_at.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/stiffness_input.hpp>
#include <pounding/laws/compiled.hpp>

namespace pounding {
namespace {

// The law decides whether zero is allowed.
double read_restitution(const Input& node, const laws::Entry& entry) {
  const double value = node.as_quantity(dimension::none, bounds::any);
  const auto refuse = [&](const std::string& why) {
    node.fail(fmt::format("takes a ratio of the speeds after and before an impact in {}0, 1] such as 0.65; {}",
                          entry.sticks_at_zero ? '[' : '(', why));
  };
  if (value > 1 && value <= 100 && value == std::floor(value)) refuse(fmt::format("did you mean \"{:g} %\"?", value));
  if (value > 1) refuse(fmt::format("\"{}\" would add energy at each impact; 1 is elastic", excerpt(node.as_text())));
  if (value < 0) refuse(fmt::format("\"{}\" is outside", excerpt(node.as_text())));
  return value;
}

}  // namespace

LawInput read_law(const Input& node) {
  LawInput read;
  laws::Settings& settings = read.settings;
  const Input law_node = node.at("law");
  settings.law = law_node.as_text();
  const laws::Entry& entry = placed(law_node, [&]() -> const laws::Entry& { return laws::find_law(settings.law); });
  const Input link = node.in(keys::link_with(entry));
  link.only_keys();

  const double exponent = link.knows("exponent") ? link.quantity("exponent") : 1.5;
  for (const laws::ParameterInfo& parameter : entry.parameters)
    if (laws::must_be_given(entry.parameters, parameter, [&](std::string_view name) { return link.has(name); }) &&
        !link.has(parameter.name))
      law_node.fail(fmt::format("{0} requires {1} ({2}); type {1}: {3:g} {4}", settings.law, parameter.name,
                                parameter.meaning, parameter.typical, laws::resolved_unit(parameter.unit, exponent)));

  if (const auto restitution = link.find("restitution")) settings.restitution = read_restitution(*restitution, entry);
  settings.impact_velocity = link.find_quantity("impact_velocity");
  if (const auto formula = link.find("formula")) {
    std::vector<std::string_view> formulas;
    for (const laws::Formula& each : entry.formulas) formulas.push_back(each.name);
    if (formulas.empty())
      formula->fail_at_key(fmt::format("the law {} has no damping formula; leave it out", settings.law));
    settings.formula = formula->as_choice(fmt::format("formula of {}", settings.law), formulas);
  }
  // A unit such as "N/m^n" depends on the exponent of the link.
  for (const laws::ParameterInfo& parameter : entry.parameters) {
    const auto value = link.find(parameter.name);
    if (!value) continue;
    if (parameter.name == "stiffness" && entry.presses_soil && is_estimate(*value))
      value->fail(fmt::format("can be estimated for two solid bodies only, and {} compresses soil; type {}: {:g} {}",
                              settings.law, parameter.name, parameter.typical,
                              laws::resolved_unit(parameter.unit, exponent)));
    if (parameter.name == "stiffness") read.stiffness = read_stiffness_estimate(*value);
    if (parameter.name == "stiffness" && read.stiffness) continue;
    if (parameter.is_flag) {
      settings.values.emplace(parameter.name, value->as_bool() ? 1 : 0);
      continue;
    }
    const Dimension dimension = parse_unit_dimension(laws::resolved_unit(parameter.unit, exponent));
    if (value->is_list())
      for (std::size_t i = 0; const Input& item : value->items())
        settings.values.emplace(laws::item_name(parameter.name, i++), item.as_quantity(dimension, bounds::any));
    else
      settings.values.emplace(parameter.name, value->as_quantity(dimension, bounds::any));
  }
  return read;
}

void refuse_unknown_keys(const Input& link) {
  const auto law = link.find("law");
  if (!law || !law->is_scalar()) return;
  for (const laws::Entry& entry : laws::Laws::entries)
    if (entry.name == law->as_text()) link.in(keys::link_with(entry)).only_keys();
}

Input location_of_law(const std::string& refusal, const Input& node) {
  const Input law = node.at("law");
  const laws::Entry& entry = laws::find_law(law.as_text());
  const Input link = node.in(keys::link_with(entry));
  std::vector<std::string_view> keys{"formula", "restitution", "impact_velocity", "reduced_mass"};
  for (const laws::ParameterInfo& parameter : entry.parameters) keys.push_back(parameter.name);
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz_";
  for (std::size_t begin = 0; (begin = refusal.find_first_of(letters, begin)) != std::string::npos;) {
    const std::size_t end = std::min(refusal.find_first_not_of(letters, begin), refusal.size());
    const std::string_view spec = std::string_view(refusal).substr(begin, end - begin);
    if (std::find(keys.begin(), keys.end(), spec) != keys.end())
      if (const auto found = link.find(spec)) return *found;
    begin = end;
  }
  return law;
}

}  // namespace pounding
