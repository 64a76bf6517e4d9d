#pragma once
/// Laws by name, for any variant of laws: the catalogue, creation of a law from settings, and description of a law. All
/// data are read from the tables of the laws. all.hpp applies it to the laws of this library.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <pounding/laws/checks.hpp>
#include <pounding/laws/entry.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// A resolved value of a law.
struct ResolvedValue {
  std::string name;
  double value = 0;
  std::string unit;
};

/// Substitutes the exponent n in a unit of the tables: "N/m^n" becomes "N/m^1.5" for 1.5 and "N/m" for 1.
inline std::string resolved_unit(std::string_view unit, double exponent) {
  const std::pair<std::string_view, double> forms[] = {
      {"^((n+1)/2)", (exponent + 1) / 2}, {"^(n+1)", exponent + 1}, {"^n", exponent}};
  std::string text(unit);
  for (const auto& [form, power] : forms)
    if (const auto at = text.find(form); at != std::string::npos)
      return text.replace(at, form.size(), power == 1 ? std::string() : std::string("^").append(number_text(power)));
  return text;
}

/// True if a parameter is required; `has(name)` is true for the given ones.
template <class Has>
bool must_be_given(std::span<const ParameterInfo> parameters, const ParameterInfo& parameter, Has&& has) {
  const bool together =
      std::ranges::any_of(parameters, [&](const ParameterInfo& p) { return p.need == Need::together && has(p.name); });
  return parameter.need == (together ? Need::together : Need::required);
}

/// Throws std::invalid_argument for a parameter that has no effect together with parameters of kind `together`; `has`
/// as above.
template <class Has>
void refuse_beside_together(std::span<const ParameterInfo> parameters, Has&& has) {
  const auto other =
      std::ranges::find_if(parameters, [&](const ParameterInfo& p) { return p.need != Need::together && has(p.name); });
  const auto first =
      std::ranges::find_if(parameters, [&](const ParameterInfo& p) { return p.need == Need::together && has(p.name); });
  if (first != parameters.end() && other != parameters.end())
    throw std::invalid_argument(std::string(other->name) + " has no effect together with " + std::string(first->name) +
                                "; remove one of them");
}

/// Dimensionless damping number of a law at this closing speed [m/s], named by Entry::number; 0 if the law has no
/// damping. Throws std::invalid_argument if the formula is undefined for the restitution of the law.
template <class... L>
double damping_number(const std::variant<L...>& law, double closing_speed) {
  return std::visit(
      [closing_speed]<class Law>(const Law& chosen) {
        if constexpr (has_damping<Law>) return chosen.damping_number(closing_speed);
        return 0.0;
      },
      law);
}

/// Damping coefficient of a law at this closing speed [m/s], in the unit of Entry::coefficient; 0 if the law has no
/// damping. Throws like damping_number.
template <class... L>
double damping_coefficient(const std::variant<L...>& law, double closing_speed) {
  return std::visit(
      [closing_speed]<class Law>(const Law& chosen) {
        if constexpr (has_damping<Law>) return chosen.damping_for(closing_speed);
        return 0.0;
      },
      law);
}

/// Catalogue entry of a law, from its members.
template <class L>
constexpr Entry Entry::of() {
  Entry e{.name = L::name,
          .shape = L::shape,
          .summary = L::summary,
          .source = L::source,
          .symbols = L::symbols,
          .range = L::range,
          .beware = L::beware,
          .parameters = infos<L::parameters>,
          .formulas = {},
          .takes_restitution = requires(L law) { law.restitution; },
          .takes_impact_velocity = requires(L law) { law.impact_velocity; },
          .takes_reduced_mass = requires(L law) { law.reduced_mass; },
          .may_pull = laws::may_pull<L>,
          .leaves_indentation = laws::leaves_indentation<L>,
          .instantaneous = laws::instantaneous<L>,
          .sticks_at_zero = laws::sticks_at_zero<L>,
          .presses_soil = laws::presses_soil<L>,
          .number = {},
          .coefficient = {}};
  if constexpr (requires { L::formulas; }) {
    e.formulas = L::formulas;
    e.number = L::number;
    e.coefficient = L::coefficient;
  }
  return e;
}

/// Creates a validated law L. Throws std::invalid_argument for a setting that is missing, unknown or out of range.
template <class L>
L law_from(const Settings& s) {
  const std::string law_name(L::name);
  constexpr std::span<const ParameterInfo> parameters = infos<L::parameters>;
  L law;
  for (const auto& [name, value] : s.values) set(law, name, value);
  const auto given = [&s](std::string_view name) { return is_given(s.values, name); };
  for (const ParameterInfo& p : parameters)
    if (must_be_given(parameters, p, given) && !given(p.name))
      throw std::invalid_argument(law_name + " needs " + std::string(p.name) + " (" + std::string(p.meaning) + ")");
  refuse_beside_together(parameters, given);
  refuse_mixed_lists(parameters, s.values);

  if constexpr (requires { law.restitution; }) {
    if constexpr (std::is_same_v<decltype(law.restitution), double>) {
      if (!s.restitution) throw std::invalid_argument(law_name + " needs restitution");
      law.restitution = *s.restitution;
    } else {
      law.restitution = s.restitution;
    }
  } else if (s.restitution) {
    throw std::invalid_argument(
        law_name + " takes no restitution: " +
        (leaves_indentation<L> ? "its dissipation follows from its curves" : "it dissipates no energy"));
  }

  if (!s.formula.empty()) {
    if constexpr (requires { L::formulas; }) {
      const auto found = std::ranges::find(L::formulas, s.formula, &Formula::name);
      if (found == L::formulas.end())
        throw std::invalid_argument(law_name + " has no formula \"" + excerpt(s.formula) + "\"." +
                                    suggestion(s.formula, names(L::formulas)));
      if (!s.restitution)
        throw std::invalid_argument("formula \"" + excerpt(s.formula) +
                                    "\" needs a restitution to compute the damping of " + law_name);
      law.formula = found->function;
    } else {
      throw std::invalid_argument(law_name + " takes no formula: it has no damping to calibrate");
    }
  }

  if constexpr (requires { law.impact_velocity; })
    law.impact_velocity = s.impact_velocity;
  else if (s.impact_velocity)
    throw std::invalid_argument(law_name + " takes no impact_velocity: it does not depend on the closing speed");
  require_not_negative("reduced_mass", s.reduced_mass);  // 0: not given, for laws that need no mass
  if constexpr (requires { law.reduced_mass; }) law.reduced_mass = s.reduced_mass;
  law.check();
  return law;
}

namespace by_name {

/// Parameters of a law, its damping number and its coefficient at this closing speed [m/s]; only the parameters of kind
/// `together` if these are given. The number may be missing without a reduced mass.
template <class L>
std::vector<ResolvedValue> describe(const L& law, double closing_speed) {
  double exponent = 1;
  if constexpr (requires { law.exponent; }) exponent = law.exponent;
  std::vector<ResolvedValue> result;
  const auto add = [&](std::string_view name, double value, std::string_view unit) {
    if (std::ranges::find(result, name, &ResolvedValue::name) == result.end())
      result.push_back({std::string(name), value, resolved_unit(unit, exponent)});
  };
  const bool together = std::ranges::any_of(
      L::parameters, [&](const Parameter<L>& p) { return p.info.need == Need::together && p.get(law); });
  for (const Parameter<L>& p : L::parameters) {
    const std::optional<double> value = p.get(law);
    if (value && !(p.value && together)) add(p.info.name, *value, p.info.unit);
    if (p.list)
      for (std::size_t i = 0; i < (law.*p.list).size(); ++i)
        add(item_name(p.info.name, i), (law.*p.list)[i], p.info.unit);
  }
  if (together) return result;
  if constexpr (requires { law.restitution.has_value(); }) {
    if (law.restitution) add("restitution", *law.restitution, "");
  } else if constexpr (requires { law.restitution; }) {
    add("restitution", law.restitution, "");
  }
  if constexpr (requires { law.reduced_mass; })
    if (law.reduced_mass > 0) add("reduced_mass", law.reduced_mass, "kg");
  if constexpr (requires { law.impact_velocity; })
    if (law.impact_velocity) add("impact_velocity", *law.impact_velocity, "m/s");
  if constexpr (has_damping<L>) {
    if constexpr (requires { law.impact_velocity; })
      if (!law.impact_velocity) add("closing_speed", closing_speed, "m/s");
    if (const double number = law.damping_number(closing_speed); std::isfinite(number))
      add(L::number.name, number, L::number.unit);
    add(L::coefficient.name, law.damping_for(closing_speed), L::coefficient.unit);
  }
  return result;
}

}  // namespace by_name

/// Parameters of a law, its damping number and its coefficient, for reports. A coefficient that depends on the closing
/// speed is evaluated at `closing_speed` [m/s], which is then listed as well.
template <class... L>
std::vector<ResolvedValue> describe(const std::variant<L...>& law, double closing_speed = 1) {
  return std::visit([&](const auto& chosen) { return by_name::describe(chosen, closing_speed); }, law);
}

/// Name of the calibration formula of a law; empty if its damping was given directly or it has none.
template <class... L>
std::string_view formula_name(const std::variant<L...>& law) noexcept {
  return std::visit(
      [](const auto& chosen) -> std::string_view {
        if constexpr (requires { chosen.formula; })
          if (chosen.restitution)
            for (const Formula& f : chosen.formulas)
              if (f.function == chosen.formula) return f.name;
        return {};
      },
      law);
}

}  // namespace pounding::laws
