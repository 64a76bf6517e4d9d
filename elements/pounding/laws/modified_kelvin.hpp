#pragma once
#include <array>
#include <optional>
#include <string_view>

#include <pounding/laws/damping_formulas.hpp>
#include <pounding/laws/exact_damping.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F = k d + zeta d d' = k d (1 + a d'/v), zeta = a k/v: linear spring, damping proportional to the penetration.
///
/// k [N/m], zeta [N s/m^2], a [-], d [m], d' [m/s], v [m/s] closing speed of the impact. Ye, Li & Zhu 2009, Earthq.
/// Eng. Eng. Vib. 8:433; paper Eq. 13. It is hertz_damped with n = 1, with the same relation between restitution and a;
/// the published formula yields 0.488 for a target of 0.50. The force starts from zero and never pulls in a free
/// impact.
struct ModifiedKelvin {
  static constexpr std::string_view name = "modified_kelvin", shape = "F = k d (1 + a d'/v)";
  static constexpr std::string_view summary = "linear spring, damping proportional to the penetration";
  static constexpr std::string_view source = "Ye, Li & Zhu 2009, Earthq. Eng. Eng. Vib. 8:433";
  static constexpr std::string_view symbols = "k [N/m] contact stiffness, a [-] damping factor, zeta = a k/v [N s/m^2]";
  static constexpr std::string_view range =
      "free impacts, a < 1/e; the force is cut off at zero for bodies torn apart faster than v/a";
  static constexpr std::string_view beware =
      "the damping is calibrated to the closing speed v of each impact, or to a fixed impact_velocity. The force "
      "starts from zero and does not pull in a free impact";
  static constexpr Quantity number{"damping_factor", ""}, coefficient{"damping_coefficient", "N s/m^2"};

  static constexpr std::array formulas{
      Formula{"exact", "root of a(1+e) = ln[(1+a)/(1-a e)]", "closed form", "reaches the target restitution",
              &exact_factor},
      Formula{"ye_2009_linear", "a = 3(1-e)/(2e)", "Ye, Li & Zhu 2009, Earthq. Eng. Eng. Vib. 8:433; paper Eq. 13",
              "yields 0.488 for a target of 0.50", &hu_guo}};

  double stiffness = 0;                         ///< k [N/m]
  std::optional<double> restitution{};          ///< e in (0, 1], or
  std::optional<double> damping_factor{};       ///< a >= 0 [-], or
  std::optional<double> damping_coefficient{};  ///< zeta >= 0 [N s/m^2]
  std::optional<double> impact_velocity{};      ///< fixed design velocity; default: closing speed of each impact [m/s]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "contact stiffness k", 9.35e7}, &ModifiedKelvin::stiffness},
      Parameter{{"damping_factor", "", "damping factor a", 0.79, Need::damping}, &ModifiedKelvin::damping_factor},
      Parameter{{"damping_coefficient", "N s/m^2", "damping zeta", 7.4e7, Need::damping},
                &ModifiedKelvin::damping_coefficient}};

  void check() const { check_dashpot(*this); }

  /// a [-] of an impact at this closing speed [m/s].
  double damping_number(double closing_speed) const {
    if (damping_coefficient)
      return *damping_coefficient * calibration_speed(impact_velocity, closing_speed) / stiffness;
    return damping_factor ? *damping_factor : formula({.restitution = *restitution});
  }
  /// zeta [N s/m^2] of an impact at this closing speed [m/s].
  double damping_for(double closing_speed) const {
    if (damping_coefficient) return *damping_coefficient;
    return damping_number(closing_speed) * stiffness / calibration_speed(impact_velocity, closing_speed);
  }

  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    const double factor = stiffness + impact.damping * rate;
    return {penetration * factor, factor, penetration * impact.damping};
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

}  // namespace pounding::laws
