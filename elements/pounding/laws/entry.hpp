#pragma once
/// Laws by name and parameters: settings, catalogue entry, and the suggestion for a mistyped name.

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/laws/catalogue.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// Settings of a law in an input. SI units.
struct Settings {
  std::string law;
  std::string formula;                                  ///< empty: "exact", if a restitution is given
  std::optional<double> restitution{};                  ///< (0, 1], or 0 for laws in which the bodies stick
  std::optional<double> impact_velocity{};              ///< fixed design velocity [m/s]
  double reduced_mass = 0;                              ///< of the colliding bodies [kg]; ignored by some laws
  std::map<std::string, double, std::less<>> values{};  ///< the law's own parameters; "force[1]" of a list
};

/// Catalogue entry of a law, read from the tables of its struct.
struct Entry {
  std::string_view name, shape, summary, source;
  std::string_view symbols;                   ///< symbols of `shape` with units, except F, d, d', v and m
  std::string_view range;                     ///< range of validity
  std::string_view beware;                    ///< limitations: jumps, tension, dependence on the speed
  std::span<const ParameterInfo> parameters;  ///< except restitution, impact_velocity and reduced_mass
  std::span<const Formula> formulas;          ///< "exact" first; empty if the law has no damping to calibrate
  bool takes_restitution = false, takes_impact_velocity = false, takes_reduced_mass = false;
  bool may_pull = false, leaves_indentation = false, instantaneous = false;
  bool sticks_at_zero = false;  ///< accepts a restitution of 0
  bool presses_soil = false;    ///< its stiffness does not apply to two bodies
  Quantity number;       ///< dimensionless damping number that formulas compute; its name is empty without damping
  Quantity coefficient;  ///< value returned by damping_for

  /// Entry of a law, from its members.
  template <class L>
  static constexpr Entry of();

  /// First parameter that gives the damping instead of a restitution; empty if there is none.
  std::string_view direct_damping() const noexcept {
    const auto found = std::ranges::find(parameters, Need::damping, &ParameterInfo::need);
    return found == parameters.end() ? std::string_view{} : found->name;
  }
};

/// Typical values of concrete floors, for examples and tables: restitution [-], closing speed [m/s], and the reduced
/// mass of floors of 100 t and 150 t [kg].
inline constexpr double typical_restitution = 0.65, typical_closing_speed = 0.5, typical_reduced_mass = 6e4;

/// Settings of a law with the typical values of its table, calibrated to the typical restitution.
inline Settings typical_settings(const Entry& entry) {
  Settings s{.law = std::string(entry.name), .formula = {}, .reduced_mass = typical_reduced_mass};
  if (entry.takes_restitution) s.restitution = typical_restitution;
  add_typical(entry.parameters, s.values,
              [](const ParameterInfo& p) { return p.need == Need::required || p.need == Need::optional; });
  return s;
}

/// Message about an unknown law: the suggested law, or how to type a damping formula that was given instead of a law,
/// or all laws. A formula is found by its name or by its first author.
inline std::string unknown_law(std::string_view read, std::span<const Entry> catalogue) {
  const std::string unknown = "unknown law \"" + excerpt(read) + "\".";
  const std::vector<std::string_view> laws = names(catalogue);
  if (!nearest_name(read, laws).empty()) return unknown + suggestion(read, laws);
  std::vector<std::string_view> formulas;
  for (const Entry& entry : catalogue)
    for (const Formula& formula : entry.formulas)
      if (formula.name != "exact") formulas.push_back(formula.name);
  std::string_view meant = nearest_name(read, formulas);
  if (meant.empty())  // the shortest formula with this prefix: ye_2009 before ye_2009_linear
    for (const std::string_view formula : formulas)
      if (formula.size() > read.size() && formula[read.size()] == '_' &&
          edit_distance(read, formula.substr(0, read.size())) == 0 && (meant.empty() || formula.size() < meant.size()))
        meant = formula;
  if (meant.empty()) return unknown + suggestion(read, laws);
  std::string with;
  for (const Entry& entry : catalogue)
    if (std::ranges::find(entry.formulas, meant, &Formula::name) != entry.formulas.end())
      with += (with.empty() ? "" : " or ") + std::string(entry.name);
  return unknown + " \"" + std::string(meant) + "\" is a damping formula, not a law; type law: " + with +
         ", formula: " + std::string(meant) + ".";
}

}  // namespace pounding::laws
