#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <pounding/base/power.hpp>
#include <pounding/laws/integrated_impact.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// c D/(m v) for a restitution: one curve per exponent, from integrated impacts. D = (m v^2/k)^(1/(n+1)).
double exact_limited_damper(const CalibrationTarget& target);

/// F = k d^n + clamp(c d', -k d^n, k d^n): the dashpot force is limited to the spring force.
///
/// k [N/m^n], n >= 1 [-], c [N s/m], d [m], d' [m/s]. Modelica ElastoGap; MapleSim contact. The force starts from zero
/// and never pulls. A given restitution is reached at each impact with c = c* m v/D, D = (m v^2/k)^(1/(n+1)). If the
/// dashpot force reaches the limit in the approach, the force is 2 k d^n; the slopes jump there.
struct LimitedDamper {
  static constexpr std::string_view name = "limited_damper", shape = "F = k d^n + clamp(c d', -k d^n, k d^n)";
  static constexpr std::string_view summary = "power-law spring, dashpot force limited to the spring force";
  static constexpr std::string_view source = "Modelica ElastoGap; MapleSim contact";
  static constexpr std::string_view symbols = "k [N/m^n] contact stiffness, n [-] exponent, c [N s/m]";
  static constexpr std::string_view range = "n >= 1, any c >= 0";
  static constexpr std::string_view beware =
      "where the dashpot force is limited, the force is 2 k d^n in the approach and zero in the restitution phase, and "
      "the slopes jump. With a given c, the restitution depends on the closing speed";
  static constexpr Quantity number{"damping_factor", ""}, coefficient{"damping_coefficient", "N s/m"};

  static constexpr std::array formulas{
      Formula{"exact", "c = c* m v/D, D = (m v^2/k)^(1/(n+1)), c* the root of e(c*) = e", "integrated impact",
              "reaches the target restitution", &exact_limited_damper}};

  double stiffness = 0;                         ///< k [N/m^n]
  double exponent = 1.5;                        ///< n [-]
  std::optional<double> restitution{};          ///< e in (0, 1], or
  std::optional<double> damping_coefficient{};  ///< c >= 0 [N s/m]
  std::optional<double> impact_velocity{};      ///< fixed design velocity; default: closing speed of each impact [m/s]
  double reduced_mass = 0;                      ///< m [kg]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m^n", "contact stiffness k", 2.75e9}, &LimitedDamper::stiffness},
      Parameter{{"exponent", "", "exponent n", 1.5, Need::optional}, &LimitedDamper::exponent},
      Parameter{{"damping_coefficient", "N s/m", "damping c", 8e5, Need::damping},
                &LimitedDamper::damping_coefficient}};

  void check() const { check_dashpot(*this); }

  /// c D/(m v) [-] of an impact at this closing speed [m/s].
  double damping_number(double closing_speed) const {
    if (restitution) return formula({.restitution = *restitution, .exponent = exponent});
    return *damping_coefficient / coefficient_scale(closing_speed);
  }
  /// c [N s/m] of an impact at this closing speed [m/s].
  double damping_for(double closing_speed) const {
    return restitution ? damping_number(closing_speed) * coefficient_scale(closing_speed) : *damping_coefficient;
  }

  /// Without the lower limit in the restitution phase, so that the sign changes at the release; `respond` applies the
  /// cut-off.
  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    const Power p = power(penetration, exponent);
    const double spring = stiffness * p.value, slope = stiffness * p.slope, dashpot = impact.damping * rate;
    const bool limited = dashpot > spring;
    return {spring + std::min(dashpot, spring), slope + only_if(limited, slope), only_if(!limited, impact.damping)};
  }
  /// Changes sign where the slopes jump [N].
  double corner(double penetration, double rate, const Impact& impact) const noexcept {
    return stiffness * power(penetration, exponent).value - impact.damping * rate;
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }

 private:
  double coefficient_scale(double closing_speed) const {
    const double v = calibration_speed(impact_velocity, closing_speed);
    return reduced_mass * v / impact_length(reduced_mass, v, stiffness, exponent);
  }
};

inline double exact_limited_damper(const CalibrationTarget& target) {
  return number_of_restitution(target.restitution, [&](double number) {
    return LimitedDamper{.stiffness = 1, .exponent = target.exponent, .damping_coefficient = number, .reduced_mass = 1};
  });
}

}  // namespace pounding::laws
