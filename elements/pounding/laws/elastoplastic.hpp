#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <pounding/base/power.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// d_p/d_m = 1 - e^2: the loading curve stores k d_m^(n+1)/(n+1), and unloading returns the fraction (d_m - d_p)/d_m of
/// it.
inline double exact_indentation(const CalibrationTarget& q) { return (1 - q.restitution) * (1 + q.restitution); }

/// F = k d^n in first loading, F_m [(d - d_p)/(d_m - d_p)]^n in unloading and reloading; the indentation is added to
/// the gap.
///
/// k [N/m^n], n >= 1 [-], d [m] penetration from the undamaged surface, d_m [m] its running maximum, F_m = k d_m^n [N],
/// d_p = r d_m [m] indentation, r in [0, 1) [-]. The initial unloading stiffness is 1/(1-r) times the final loading
/// stiffness. At F = 0 the contact ends and d_p remains: later impacts find a gap that is wider by d_p, follow the
/// unloading curve up to (d_m, F_m), and crush from there on. n = 1: Walton & Braun 1986, J. Rheol. 30:949, with k1 =
/// k, k2 = k/e^2, e = sqrt(k1/k2). Any n: Lankarani & Nikravesh 1994, Nonlinear Dyn. 5:193. For concrete: van Mier et
/// al. 1991, J. Struct. Eng. 117:354.
///
/// The first impact has e = sqrt(1-r) at every speed. A later impact with energy E, after crushing up to E_m = k
/// d_m^(n+1)/(n+1), has restitution 1 if E <= e^2 E_m, otherwise sqrt{e^2 [1 + (1-e^2) E_m/E]}.
struct Elastoplastic {
  static constexpr std::string_view name = "elastoplastic",
                                    shape =
                                        "F = k d^n for d = d_m, k d_m^n [(d-d_p)/(d_m-d_p)]^n for d < d_m; d_p = r d_m";
  static constexpr std::string_view summary =
      "power-law spring with crushing: steeper unloading, permanent indentation";
  static constexpr std::string_view source =
      "Lankarani & Nikravesh 1994, Nonlinear Dyn. 5:193; n = 1: Walton & Braun 1986, J. Rheol. 30:949; for concrete: "
      "van Mier et al. 1991, J. Struct. Eng. 117:354";
  static constexpr std::string_view symbols =
      "k [N/m^n] contact stiffness, n [-] exponent, d measured from the undamaged surface, d_m [m] its running maximum "
      "over all impacts, d_p [m] indentation, r [-] indentation ratio";
  static constexpr std::string_view range = "n >= 1, 0 <= r < 1";
  static constexpr std::string_view beware =
      "the indentation is added to the gap for the rest of the run. The given restitution applies to an impact on "
      "undamaged surfaces; later impacts that crush no deeper dissipate nothing. The force does not depend on the "
      "speed";
  static constexpr Quantity number{"indentation_ratio", ""}, coefficient{"indentation_ratio", ""};
  static constexpr bool leaves_indentation = true;

  static constexpr std::array formulas{
      Formula{"exact", "r = 1 - e^2", "closed form, the same for every n: Walton & Braun 1986",
              "reaches the target restitution on undamaged surfaces", &exact_indentation}};

  double stiffness = 0;                       ///< k [N/m^n]
  double exponent = 1.5;                      ///< n [-]
  std::optional<double> restitution{};        ///< e in (0, 1], or
  std::optional<double> indentation_ratio{};  ///< r in [0, 1) [-]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m^n", "contact stiffness k", 2.75e9}, &Elastoplastic::stiffness},
      Parameter{{"exponent", "", "exponent n", 1.5, Need::optional}, &Elastoplastic::exponent},
      Parameter{{"indentation_ratio", "", "ratio r of indentation to maximum penetration", 0.58, Need::damping},
                &Elastoplastic::indentation_ratio}};

  void check() const {
    require_positive("stiffness", stiffness);
    require_exponent(exponent);
    require_restitution(restitution);
    if (indentation_ratio && !(*indentation_ratio >= 0 && *indentation_ratio < 1))
      refuse("indentation_ratio", *indentation_ratio, "in [0, 1)");
    require_one_damping(*this);
  }

  /// r [-], the same at every closing speed.
  double damping_number(double) const {
    return restitution ? formula({.restitution = *restitution}) : *indentation_ratio;
  }
  double damping_for(double closing_speed) const { return damping_number(closing_speed); }

  /// d_m [m], with r = impact.damping.
  double crushed(const Impact& impact) const noexcept {
    return std::max(impact.crushed, impact.damping * impact.crushed + impact.largest_penetration);
  }
  /// Growth of d_p in this impact [m].
  double indentation(const Impact& impact) const noexcept {
    return impact.damping * (crushed(impact) - impact.crushed);
  }

  Response contact(double penetration, double, const Impact& impact) const noexcept {
    const double deepest = crushed(impact), d = penetration + impact.damping * impact.crushed;
    if (!(d < deepest) || !(deepest > 0)) {
      const Power p = power(d, exponent);
      return {stiffness * p.value, stiffness * p.slope, 0};
    }
    const double reach = (1 - impact.damping) * deepest, part = (d - impact.damping * deepest) / reach;
    const double top = stiffness * power(deepest, exponent).value;
    // Continued as an odd function beyond the zero of the force.
    const Power p = power(std::abs(part), exponent);
    return {top * std::copysign(p.value, part), top * p.slope / reach, 0};
  }
  /// Area under the unloading curve [J].
  double stored_energy(double penetration, const Impact& impact) const noexcept {
    const double d = penetration + impact.damping * impact.crushed, deepest = std::max(d, crushed(impact));
    const double reach = (1 - impact.damping) * deepest, part = std::max(d - impact.damping * deepest, 0.0) / reach;
    return stiffness * power(deepest, exponent).value * reach * power(part, exponent + 1).value / (exponent + 1);
  }
  /// Changes sign at the maximum penetration reached, where the slope jumps [m].
  double corner(double penetration, double, const Impact& impact) const noexcept {
    return penetration + impact.damping * impact.crushed - crushed(impact);
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

}  // namespace pounding::laws
