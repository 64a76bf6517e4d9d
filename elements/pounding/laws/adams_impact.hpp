#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <pounding/base/power.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/laws/integrated_impact.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// c D/(m v) for a restitution at one closing speed, from integrated impacts. D = (m v^2/k)^(1/(n+1)).
double exact_adams_impact(const CalibrationTarget& target);

/// F = max(0, k d^n + c STEP(d) d'), STEP = s^2 (3 - 2 s) with s = d/depth, 1 beyond depth: the IMPACT function.
///
/// k [N/m^n], n >= 1 [-], c [N s/m] full damping, reached at depth [m], d [m], d' [m/s]. MSC Adams, Altair MotionSolve,
/// SolidWorks Motion. The restitution depends on the closing speed; `exact` solves for c at each impact. Tension is cut
/// off; for n < 2 the spring can press again before the penetration returns to zero.
struct AdamsImpact {
  static constexpr std::string_view name = "adams_impact", shape = "F = max(0, k d^n + c STEP(d/depth) d')";
  static constexpr std::string_view summary =
      "IMPACT function of multibody programs, damping grows with depth up to a limit";
  static constexpr std::string_view source = "Altair MotionSolve, SolidWorks Motion: IMPACT function";
  static constexpr std::string_view symbols =
      "k [N/m^n] contact stiffness, n [-] exponent, c [N s/m] full damping, depth [m] at which it is reached; STEP(s) "
      "= s^2 (3 - 2 s), 1 beyond s = 1";
  static constexpr std::string_view range = "n >= 1, depth > 0";
  static constexpr std::string_view beware =
      "with a given c the restitution depends on the closing speed, and a slow impact that does not reach the depth "
      "loses almost no energy. With a given restitution, c is computed at each impact. Tension is cut off; for n < 2 "
      "the spring can press again before the penetration returns to zero";
  static constexpr bool is_dashpot = true;
  static constexpr Quantity number{"damping_factor", ""}, coefficient{"damping_coefficient", "N s/m"};

  static constexpr std::array formulas{Formula{"exact", "root of e(c) = e at each closing speed", "integrated impact",
                                               "reaches the target restitution", &exact_adams_impact}};

  double stiffness = 0;                         ///< k [N/m^n]
  double exponent = 1.5;                        ///< n [-]
  double depth = 0;                             ///< penetration at which damping is full [m]
  std::optional<double> restitution{};          ///< e in (0, 1], or
  std::optional<double> damping_coefficient{};  ///< c >= 0 [N s/m]
  std::optional<double> impact_velocity{};      ///< fixed design velocity; default: closing speed of each impact [m/s]
  double reduced_mass = 0;                      ///< m [kg]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m^n", "contact stiffness k", 2.75e9}, &AdamsImpact::stiffness},
      Parameter{{"exponent", "", "exponent n", 1.5, Need::optional}, &AdamsImpact::exponent},
      Parameter{{"depth", "m", "penetration at which damping is full", 0.001}, &AdamsImpact::depth},
      Parameter{{"damping_coefficient", "N s/m", "damping c", 6e5, Need::damping}, &AdamsImpact::damping_coefficient}};

  void check() const {
    check_dashpot(*this);
    require_positive("depth", depth);
  }

  /// c D/(m v) [-] of an impact at this closing speed [m/s].
  double damping_number(double closing_speed) const {
    if (!restitution) return *damping_coefficient / coefficient_scale(closing_speed);
    return formula({.restitution = *restitution,
                    .closing_speed = calibration_speed(impact_velocity, closing_speed),
                    .stiffness = stiffness,
                    .exponent = exponent,
                    .reduced_mass = reduced_mass,
                    .depth = depth});
  }
  /// c [N s/m] of an impact at this closing speed [m/s].
  double damping_for(double closing_speed) const {
    return restitution ? damping_number(closing_speed) * coefficient_scale(closing_speed) : *damping_coefficient;
  }

  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    const Power p = power(penetration, exponent), part = step(penetration);
    return {stiffness * p.value + impact.damping * part.value * rate,
            stiffness * p.slope + impact.damping * part.slope * rate, impact.damping * part.value};
  }
  /// Changes sign at the depth at which the damping reaches its full value [m].
  double corner(double penetration, double, const Impact&) const noexcept { return penetration - depth; }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }

 private:
  // STEP and its derivative with respect to d [1/m]; no division by a depth of zero.
  Power step(double penetration) const noexcept {
    if (penetration >= depth) return {1, 0};
    const double s = std::max(penetration, 0.0) / depth;
    return {s * s * (3 - 2 * s), 6 * s * (1 - s) / depth};
  }
  double coefficient_scale(double closing_speed) const {
    const double v = calibration_speed(impact_velocity, closing_speed);
    return reduced_mass * v / impact_length(reduced_mass, v, stiffness, exponent);
  }
};

inline double exact_adams_impact(const CalibrationTarget& target) {
  const double length = impact_length(target.reduced_mass, target.closing_speed, target.stiffness, target.exponent);
  const double depth = target.depth / length;
  // In an impact much shallower than the depth of full damping, the damping is 3 (d/depth)^2 of its full value.
  const double scale = std::max(1.0, depth * depth / 3);
  return scale * number_of_restitution(target.restitution, [&](double number) {
           return AdamsImpact{.stiffness = 1,
                              .exponent = target.exponent,
                              .depth = depth,
                              .damping_coefficient = scale * number,
                              .reduced_mass = 1};
         });
}

}  // namespace pounding::laws
