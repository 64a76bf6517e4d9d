#pragma once
#include <array>
#include <optional>
#include <string_view>

#include <pounding/base/power.hpp>
#include <pounding/laws/integrated_impact.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// A v/D for a restitution: one universal curve, from integrated impacts. D = (m v^2/k)^(2/5).
double exact_kuwabara_kono(const CalibrationTarget& target);

/// F = max(0, k d^1.5 + (3/2) A k d^0.5 d'): viscoelastic spheres; the restitution decreases with the closing speed.
///
/// k [N/m^1.5], A [s] dissipation time of the material, d [m], d' [m/s]. Kuwabara & Kono 1987; Brilliantov et al. 1996.
/// Tension near separation is cut off. A given restitution is reached at each impact with its own A = A* D/v, D = (m
/// v^2/k)^(2/5); with a fixed impact_velocity or a given dissipation_time, the restitution depends on the speed.
///
/// dF/dd is infinite at d = 0; it is bounded there by its value at shallowest_slope, while the force is
/// exact.
struct KuwabaraKono {
  static constexpr std::string_view name = "kuwabara_kono", shape = "F = max(0, k d^1.5 + (3/2) A k d^0.5 d')";
  static constexpr std::string_view summary = "viscoelastic Hertz contact, restitution decreases with speed";
  static constexpr std::string_view source = "Kuwabara & Kono 1987; Brilliantov et al. 1996";
  static constexpr std::string_view symbols = "k [N/m^1.5] contact stiffness, A [s] dissipation time";
  static constexpr std::string_view range = "spheres, any A >= 0";
  static constexpr std::string_view beware =
      "with a given dissipation_time, or a fixed impact_velocity, the restitution decreases with the closing speed. "
      "With only a restitution, A is computed at each impact. Tension near separation is cut off. dF/dd is infinite at "
      "the touch and is bounded there";
  static constexpr bool is_dashpot = true;
  static constexpr Quantity number{"damping_factor", ""}, coefficient{"dissipation_time", "s"};

  static constexpr std::array formulas{Formula{"exact", "A = A* D/v, D = (m v^2/k)^(2/5), A* the root of e(A*) = e",
                                               "integrated impact", "reaches the target restitution",
                                               &exact_kuwabara_kono}};

  double stiffness = 0;                      ///< k [N/m^1.5]
  std::optional<double> restitution{};       ///< e in (0, 1], or
  std::optional<double> dissipation_time{};  ///< A >= 0 [s]
  std::optional<double> impact_velocity{};   ///< fixed design velocity; default: closing speed of each impact [m/s]
  double reduced_mass = 0;                   ///< m [kg]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m^1.5", "contact stiffness k", 2.75e9}, &KuwabaraKono::stiffness},
      Parameter{{"dissipation_time", "s", "dissipation time A", 0.003, Need::damping},
                &KuwabaraKono::dissipation_time}};

  void check() const { check_dashpot(*this); }

  /// A v/D [-] of an impact at this closing speed [m/s].
  double damping_number(double closing_speed) const {
    if (restitution) return formula({.restitution = *restitution});
    return *dissipation_time / time_scale(closing_speed);
  }
  /// A [s] of an impact at this closing speed [m/s].
  double damping_for(double closing_speed) const {
    return restitution ? damping_number(closing_speed) * time_scale(closing_speed) : *dissipation_time;
  }

  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    const Power spring = power(penetration, 1.5), dashpot = power(penetration, 0.5);
    const double c = 1.5 * impact.damping * stiffness;
    return {stiffness * spring.value + c * dashpot.value * rate, stiffness * spring.slope + c * dashpot.slope * rate,
            c * dashpot.value};
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }

 private:
  double time_scale(double closing_speed) const {
    const double v = calibration_speed(impact_velocity, closing_speed);
    return impact_length(reduced_mass, v, stiffness, 1.5) / v;
  }
};

inline double exact_kuwabara_kono(const CalibrationTarget& target) {
  return number_of_restitution(target.restitution, [](double number) {
    return KuwabaraKono{.stiffness = 1, .dissipation_time = number, .reduced_mass = 1};
  });
}

}  // namespace pounding::laws
