#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/input/keys/sections.hpp>
#include <pounding/laws/compiled.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view estimated[] = {"auto"};

/// Keys of one law, with the texts that they refer to.
struct OfLaw {
  std::deque<std::string> texts;
  std::vector<std::string_view> formulas;
  std::vector<Key> own_keys, link_keys;
  Section own, link;

  explicit OfLaw(const laws::Entry& law) {
    for (const laws::Formula& formula : law.formulas) formulas.push_back(formula.name);
    for (const laws::ParameterInfo& parameter : law.parameters) own_keys.push_back(key_of(parameter, law));
    for (const Key& spec : keys::link.keys)
      if (is_taken(spec.key, law)) own_keys.push_back(as_taken(spec, law));

    link_keys.assign(keys::link.keys.begin(), keys::link.keys.end());
    link_keys.insert(link_keys.end(), own_keys.begin(),
                     own_keys.begin() + static_cast<std::ptrdiff_t>(law.parameters.size()));
    const std::string_view name = law.name, summary = law.summary;
    own = {name, kept(fmt::format("links[] with law: {}", name)), summary, own_keys};
    link = {keys::link.name, keys::link.place, keys::link.meaning, link_keys};
  }

 private:
  std::string_view kept(std::string text) { return texts.emplace_back(std::move(text)); }

  static bool is_taken(std::string_view key, const laws::Entry& law) {
    return (key == "formula" && !law.formulas.empty()) || (key == "restitution" && law.takes_restitution) ||
           (key == "impact_velocity" && law.takes_impact_velocity) || (key == "reduced_mass" && law.takes_reduced_mass);
  }

  Key as_taken(Key spec, const laws::Entry& law) {
    if (spec.key == "formula") {
      spec.takes = Takes::choice;
      spec.choices = formulas;
    }
    if (spec.key == "restitution") {
      const std::string_view direct = law.direct_damping();
      spec.need = may_be_together(law) ? Need::optional : direct.empty() ? Need::required : Need::exactly_one;
      spec.otherwise = {};
      if (!law.sticks_at_zero) spec.bounds = bounds::above_0_to_1;
    }
    return spec;
  }

  // True if the law has parameters that are given together, instead of the others.
  static bool may_be_together(const laws::Entry& law) {
    return std::ranges::find(law.parameters, laws::Need::together, &laws::ParameterInfo::need) != law.parameters.end();
  }

  static Need need_of(const laws::ParameterInfo& parameter, const laws::Entry& law) {
    switch (parameter.need) {
      case laws::Need::required: return may_be_together(law) ? Need::at_least_one : Need::required;
      case laws::Need::together: return Need::at_least_one;
      case laws::Need::damping: return Need::exactly_one;
      case laws::Need::optional:
      case laws::Need::instead:
      case laws::Need::extra: break;
    }
    return Need::optional;
  }

  Key key_of(const laws::ParameterInfo& parameter, const laws::Entry& law) {
    const auto exponent = std::ranges::find(law.parameters, "exponent", &laws::ParameterInfo::name);
    const std::string unit =
        laws::resolved_unit(parameter.unit, exponent == law.parameters.end() ? 1.5 : exponent->typical);
    const auto shown = [&unit](double number) {
      return fmt::format("{:g}{}{}", number, unit.empty() ? "" : " ", unit);
    };
    std::string example = shown(parameter.typical);
    if (parameter.is_flag) example = "true";
    for (std::size_t i = 0; i < parameter.typical_list.size(); ++i)
      example = (i == 0 ? "[" : example + ", ") + shown(parameter.typical_list[i]);
    const std::string_view typical = kept(parameter.is_list() ? example + "]" : example);
    Value value = quantity(parse_unit_dimension(unit), parameter.name == "exponent" ? bounds::positive : bounds::any)
                      .in(parameter.unit);
    if (parameter.name == "stiffness" && !law.presses_soil) value = value.or_map(stiffness).or_one_of(estimated);
    if (parameter.is_flag) value = boolean();
    if (parameter.is_list()) value = value.or_list();
    const Presence presence = parameter.need == laws::Need::optional ? otherwise(typical) : need_of(parameter, law);
    return {parameter.name, value, presence, parameter.meaning, typical};
  }
};

const OfLaw& of(const laws::Entry& law) {
  static const std::map<std::string_view, OfLaw> all = [] {
    std::map<std::string_view, OfLaw> made;
    for (const laws::Entry& each : laws::catalogue()) made.try_emplace(each.name, each);
    return made;
  }();
  return all.at(law.name);
}

}  // namespace

bool belongs_to_law(std::string_view key) noexcept {
  return key == "formula" || key == "restitution" || key == "impact_velocity" || key == "reduced_mass";
}

const Section& link_with(const laws::Entry& law) { return of(law).link; }
const Section& parameters_of(const laws::Entry& law) { return of(law).own; }

}  // namespace pounding::keys
