#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <pounding/base/power.hpp>
#include <pounding/laws/damping_formulas.hpp>
#include <pounding/laws/exact_damping.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F = k d^1.5 + c d' in approach (d' > 0), k d^1.5 in restitution; c = 2 xi sqrt(k sqrt(d) m).
///
/// k [N/m^1.5], xi [-], m [kg] reduced mass, d [m], d' [m/s], c [N s/m]. The nonlinear viscoelastic model, Jankowski
/// 2005, EESD 34:595; paper Eqs. 8-10. Stored as a prefactor: c = C d^0.25 with C = 2 xi sqrt(k m) [N s/m^1.25]. For a
/// target of 0.50, the formula of 2005 yields 0.558 and that of 2006 yields 0.495.
///
/// dF/dd is infinite at d = 0 (d^0.25); it is bounded there by its value at shallowest_slope, while the
/// force is exact. dF/dd' jumps at the reversal; at d' = 0 it is that of the restitution phase. Never
/// pulls.
struct Jankowski {
  static constexpr std::string_view
      name = "jankowski",
      shape = "F = k d^1.5 + c d' for d' > 0, k d^1.5 for d' <= 0; c = 2 xi sqrt(k sqrt(d) m)";
  static constexpr std::string_view summary = "Hertz spring, nonlinear dashpot in the approach only";
  static constexpr std::string_view source = "Jankowski 2005, EESD 34:595";
  static constexpr std::string_view symbols = "k [N/m^1.5] contact stiffness, xi [-] damping ratio, c [N s/m]";
  static constexpr std::string_view range = "any xi >= 0";
  static constexpr std::string_view beware =
      "dF/dd' jumps at the reversal. dF/dd is infinite at the touch and is bounded there, while the "
      "force is exact. The force never pulls";
  static constexpr Quantity number{"damping_ratio", ""}, coefficient{"damping_prefactor", "N s/m^1.25"};

  static constexpr std::array formulas{
      Formula{"exact", "xi = sqrt(5) z/2, z the root of e = exp(-z arccos(z)/sqrt(1-z^2))",
              "closed form: a linear oscillator in stretched time", "reaches the target restitution", &exact_jankowski},
      Formula{"jankowski_2005", "xi = sqrt(5) (1-e^2)/(2 pi e)", "Jankowski 2005, EESD 34:595; paper Eq. 10",
              "yields 0.558 for a target of 0.50", &jankowski_2005},
      Formula{"jankowski_2006", "xi = 9 sqrt(5)/2 (1-e^2)/{e [e (9 pi-16) + 16]}", "Jankowski 2006, EESD 35:517",
              "yields 0.495 for a target of 0.50", &jankowski_2006},
      Formula{"naderpour_2015_eq38", "xi = [2 (1-e^2)/(e sqrt(pi))]^2", "Naderpour, Barros & Khatami 2015, Eq. 38",
              "much too high below a target of 0.85", &naderpour_2015_eq38}};

  double stiffness = 0;                   ///< k [N/m^1.5]
  std::optional<double> restitution{};    ///< e in (0, 1], or
  std::optional<double> damping_ratio{};  ///< xi >= 0 [-]
  double reduced_mass = 0;                ///< m [kg]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m^1.5", "contact stiffness k", 2.75e9}, &Jankowski::stiffness},
      Parameter{{"damping_ratio", "", "damping ratio xi", 0.35, Need::damping}, &Jankowski::damping_ratio}};

  void check() const { check_dashpot(*this); }

  /// xi [-].
  double damping_number(double) const { return restitution ? formula({.restitution = *restitution}) : *damping_ratio; }
  /// C = 2 xi sqrt(k m) [N s/m^1.25], the same at every closing speed.
  double damping_for(double closing_speed) const {
    return 2 * damping_number(closing_speed) * std::sqrt(stiffness * reduced_mass);
  }

  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    const Power spring = power(penetration, 1.5);
    if (!(rate > 0)) return {stiffness * spring.value, stiffness * spring.slope, 0};
    const Power dashpot = power(penetration, 0.25);
    return {stiffness * spring.value + impact.damping * dashpot.value * rate,
            stiffness * spring.slope + impact.damping * dashpot.slope * rate, impact.damping * dashpot.value};
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

}  // namespace pounding::laws
