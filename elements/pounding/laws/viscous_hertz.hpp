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

/// F = max(0, k d^n + alpha sqrt(m k) d^((n-1)/2) d'): damping in both phases; the restitution does not depend on the
/// speed.
///
/// k [N/m^n], n >= 1 [-], alpha [-], m [kg] reduced mass, d [m], d' [m/s]. Tsuji et al. 1992; Antypov & Elliott 2011.
/// In stretched time it is a linear oscillator with damping ratio alpha/sqrt(2 (n+1)). The published alpha assumes
/// contact until d = 0, where the force pulls; this law cuts off the tension, so it yields 0.55 for a target of 0.50.
/// `exact` accounts for the cut-off.
///
/// The parameter damping_ratio is alpha. For n < 3, dF/dd is infinite at d = 0; it is bounded there by its
/// value at shallowest_slope, while the force is exact.
struct ViscousHertz {
  static constexpr std::string_view name = "viscous_hertz",
                                    shape = "F = max(0, k d^n + alpha sqrt(m k) d^((n-1)/2) d')";
  static constexpr std::string_view summary = "Hertz spring, dashpot with speed-independent restitution, no tension";
  static constexpr std::string_view source = "Tsuji et al. 1992; Antypov & Elliott 2011";
  static constexpr std::string_view symbols = "k [N/m^n] contact stiffness, n [-] exponent, alpha [-] damping ratio";
  static constexpr std::string_view range = "n >= 1, any alpha >= 0";
  static constexpr std::string_view beware =
      "tension near separation is cut off, so the published alpha, which assumes contact until d = 0, yields a higher "
      "restitution than its target. For n < 3, dF/dd is infinite at the touch and is bounded there, while the "
      "force is exact";
  static constexpr Quantity number{"damping_ratio", ""}, coefficient{"damping_prefactor", "N s/m^((n+1)/2)"};

  static constexpr std::array formulas{
      Formula{"exact", "alpha = sqrt(2 (n+1)) z, z the root of e = exp(-2 z arccos(z)/sqrt(1-z^2))",
              "closed form in stretched time, contact until F = 0", "reaches the target restitution", &exact_viscous},
      Formula{"antypov_elliott", "alpha = sqrt(2 (n+1)) (-ln e)/sqrt(pi^2 + ln^2 e)",
              "Antypov & Elliott 2011; Feng 2026", "assumes contact until d = 0; yields 0.55 for a target of 0.50",
              &antypov_elliott}};

  double stiffness = 0;                   ///< k [N/m^n]
  double exponent = 1.5;                  ///< n [-]
  std::optional<double> restitution{};    ///< e in (0, 1], or
  std::optional<double> damping_ratio{};  ///< alpha >= 0 [-]
  double reduced_mass = 0;                ///< m [kg]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m^n", "contact stiffness k", 2.75e9}, &ViscousHertz::stiffness},
      Parameter{{"exponent", "", "exponent n", 1.5, Need::optional}, &ViscousHertz::exponent},
      Parameter{{"damping_ratio", "", "alpha of the law, not a fraction of critical damping", 0.33, Need::damping},
                &ViscousHertz::damping_ratio}};

  void check() const { check_dashpot(*this); }

  /// alpha [-].
  double damping_number(double) const {
    return restitution ? formula({.restitution = *restitution, .exponent = exponent}) : *damping_ratio;
  }
  /// alpha sqrt(m k) [N s/m^((n+1)/2)], the same at every closing speed.
  double damping_for(double closing_speed) const {
    return damping_number(closing_speed) * std::sqrt(stiffness * reduced_mass);
  }

  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    if (!(penetration > 0)) return {};
    const Power spring = power(penetration, exponent);
    const Power dashpot = exponent > 1 ? power(penetration, 0.5 * (exponent - 1)) : Power{1, 0};
    return {stiffness * spring.value + impact.damping * dashpot.value * rate,
            stiffness * spring.slope + impact.damping * dashpot.slope * rate, impact.damping * dashpot.value};
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

}  // namespace pounding::laws
