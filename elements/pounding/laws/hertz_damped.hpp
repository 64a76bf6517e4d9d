#pragma once
#include <array>
#include <optional>
#include <string_view>

#include <pounding/base/power.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/laws/damping_formulas.hpp>
#include <pounding/laws/exact_damping.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F = k d^n + zeta d^n d' = k d^n (1 + a d'/v), zeta = a k/v: damping proportional to d^n (Hertzdamp).
///
/// k [N/m^n], n >= 1 [-], zeta [N s/m^(n+1)], a [-], d [m], d' [m/s], v [m/s] closing speed of the impact. Hunt &
/// Crossley 1975; Lankarani & Nikravesh 1990; Muthukumar & DesRoches 2006, EESD 35:811. The restitution depends only on
/// a, not on k, m, n, v. In a free impact the force never pulls; it is cut off at zero if the bodies are torn apart
/// faster than v/a. Published formulas can miss their target widely: for 0.40, Lankarani-Nikravesh yields 0.70 and Ye
/// 0.36.
struct HertzDamped {
  static constexpr std::string_view name = "hertz_damped", shape = "F = k d^n (1 + a d'/v)";
  static constexpr std::string_view summary = "Hertz spring, damping proportional to d^n (Hertzdamp, Hunt-Crossley)";
  static constexpr std::string_view source = "Hunt & Crossley 1975; Muthukumar & DesRoches 2006, EESD 35:811";
  static constexpr std::string_view symbols =
      "k [N/m^n] contact stiffness, n [-] exponent, a [-] damping factor, zeta = a k/v [N s/m^(n+1)]";
  static constexpr std::string_view range =
      "free impacts, n >= 1, a < 1/e; the force is cut off at zero for bodies torn apart faster than v/a";
  static constexpr std::string_view beware =
      "the restitution depends only on a, not on k, m, n and v, but published formulas for a can miss their target "
      "widely. The damping is calibrated to the closing speed v of each impact, or to a fixed impact_velocity";
  static constexpr Quantity number{"damping_factor", ""}, coefficient{"damping_coefficient", "N s/m^(n+1)"};

  static constexpr std::array formulas{
      Formula{"exact", "root of a(1+e) = ln[(1+a)/(1-a e)]", "closed form", "reaches the target restitution",
              &exact_factor},
      Formula{"lankarani_nikravesh", "a = 3(1-e^2)/4",
              "Lankarani & Nikravesh 1990, J. Mech. Des. 112:369; paper Eq. 12", "yields 0.725 for a target of 0.50",
              &lankarani_nikravesh},
      Formula{"hunt_crossley", "a = 3(1-e)/2", "Hunt & Crossley 1975", "yields 0.663 for a target of 0.50",
              &hunt_crossley},
      Formula{"ye_2009", "a = 8(1-e)/(5e)", "Ye, Li & Zhu 2009, EESD 38:1135; Flores et al. 2011; paper Eq. 14",
              "yields 0.470 for a target of 0.50", &ye_2009},
      Formula{"hu_guo", "a = 3(1-e)/(2e)", "Hu & Guo 2015; paper Eq. 13 on a Hertz spring",
              "yields 0.488 for a target of 0.50", &hu_guo},
      Formula{"gonthier", "a = (1-e^2)/e", "Gonthier et al. 2004", "yields 0.488 for a target of 0.50", &gonthier},
      Formula{"herbert_mcwhannell", "a = 6(1-e)/[(2e-1)^2 + 3]", "Herbert & McWhannell 1977",
              "yields 0.594 for a target of 0.50", &herbert_mcwhannell},
      Formula{"lee_wang", "a = 3(1-e)/4", "Lee & Wang 1983", "yields 0.799 for a target of 0.50", &lee_wang},
      Formula{"zhiying_qishao", "a = 3(1-e^2) exp[2(1-e)]/4", "Zhiying & Qishao 2006",
              "yields 0.483 for a target of 0.50", &zhiying_qishao},
      Formula{"gharib_hurmuzlu", "a = 1/e", "Gharib & Hurmuzlu 2012",
              "for small restitutions only; yields 0.411 for a target of 0.50", &gharib_hurmuzlu},
      Formula{"naderpour_2015", "a = (k/v)^(N-1) (1-e^2)/e^M, N and M tabulated over e",
              "Naderpour, Barros & Khatami 2015, Eqs. 15-17, Table 2",
              "not homogeneous: k/v is in kN, m, s as printed; 0.1 <= e <= 0.9", &naderpour_2015}};

  double stiffness = 0;                         ///< k [N/m^n]
  double exponent = 1.5;                        ///< n [-]
  std::optional<double> restitution{};          ///< e in (0, 1], or
  std::optional<double> damping_factor{};       ///< a >= 0 [-], or
  std::optional<double> damping_coefficient{};  ///< zeta >= 0 [N s/m^(n+1)]
  std::optional<double> impact_velocity{};      ///< fixed design velocity; default: closing speed of each impact [m/s]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m^n", "contact stiffness k", 2.75e9}, &HertzDamped::stiffness},
      Parameter{{"exponent", "", "exponent n", 1.5, Need::optional}, &HertzDamped::exponent},
      Parameter{{"damping_factor", "", "damping factor a", 0.79, Need::damping}, &HertzDamped::damping_factor},
      Parameter{{"damping_coefficient", "N s/m^(n+1)", "damping zeta", 2.2e9, Need::damping},
                &HertzDamped::damping_coefficient}};

  void check() const {
    check_dashpot(*this);
    if (restitution) damping_number(1);
  }

  /// a [-] of an impact at this closing speed [m/s].
  double damping_number(double closing_speed) const {
    const double v = calibration_speed(impact_velocity, closing_speed);
    if (damping_coefficient) return *damping_coefficient * v / stiffness;
    if (damping_factor) return *damping_factor;
    return formula({.restitution = *restitution, .closing_speed = v, .stiffness = stiffness, .exponent = exponent});
  }
  /// zeta [N s/m^(n+1)] of an impact at this closing speed [m/s].
  double damping_for(double closing_speed) const {
    if (damping_coefficient) return *damping_coefficient;
    return damping_number(closing_speed) * stiffness / calibration_speed(impact_velocity, closing_speed);
  }

  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    const Power p = power(penetration, exponent);
    const double factor = stiffness + impact.damping * rate;
    return {p.value * factor, p.slope * factor, p.value * impact.damping};
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

}  // namespace pounding::laws
