#pragma once
/// Dashpot parallel to a linear spring, given by a restitution, a damping ratio or a coefficient. For laws with the
/// members stiffness k [N/m], restitution, damping_ratio zeta [-], damping_coefficient c [N s/m], reduced_mass m [kg]
/// and formula; c = 2 zeta sqrt(k m).

#include <array>
#include <cmath>
#include <optional>

#include <pounding/laws/checks.hpp>
#include <pounding/laws/damping_formulas.hpp>
#include <pounding/laws/exact_damping.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F = k d + c d', c = 2 zeta sqrt(k m). The dashpot is given by a restitution, by zeta or by c.
///
/// `Traits` contains the texts and formulas of a law, and its special properties: `may_pull`, `leaves_indentation`,
/// `sticks_at_zero`, or `damps_approach_only` if c = 0 for d' <= 0.
template <class Traits>
struct LinearDashpotLaw {
  static constexpr std::string_view name = Traits::name, shape = Traits::shape, summary = Traits::summary,
                                    source = Traits::source, range = Traits::range, beware = Traits::beware;
  static constexpr std::string_view symbols = "k [N/m] contact stiffness, zeta [-] damping ratio, c [N s/m]";
  static constexpr Quantity number{"damping_ratio", ""}, coefficient{"damping_coefficient", "N s/m"};
  static constexpr bool is_linear = true, may_pull = laws::may_pull<Traits>,
                        leaves_indentation = laws::leaves_indentation<Traits>,
                        sticks_at_zero = laws::sticks_at_zero<Traits>;
  static constexpr auto& formulas = Traits::formulas;

  double stiffness = 0;                         ///< k [N/m]
  std::optional<double> restitution{};          ///< e in (0, 1], or
  std::optional<double> damping_ratio{};        ///< zeta >= 0 [-], or
  std::optional<double> damping_coefficient{};  ///< c >= 0 [N s/m]
  double reduced_mass = 0;                      ///< m [kg]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "contact stiffness k", 9.35e7}, &LinearDashpotLaw::stiffness},
      Parameter{{"damping_ratio", "", "damping ratio zeta", 0.14, Need::damping}, &LinearDashpotLaw::damping_ratio},
      Parameter{{"damping_coefficient", "N s/m", "damping c", 6.6e5, Need::damping},
                &LinearDashpotLaw::damping_coefficient}};

  void check() const { check_dashpot(*this); }

  /// zeta [-].
  double damping_number(double) const {
    if (damping_coefficient) return *damping_coefficient / (2 * std::sqrt(stiffness * reduced_mass));
    return restitution ? formula({.restitution = *restitution}) : *damping_ratio;
  }
  /// c [N s/m], the same at every closing speed.
  double damping_for(double speed) const {
    return damping_coefficient ? *damping_coefficient : 2 * damping_number(speed) * std::sqrt(stiffness * reduced_mass);
  }

  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    double c = impact.damping;
    if constexpr (requires { Traits::damps_approach_only; }) c = only_if(rate > 0, c);
    return {stiffness * penetration + c * rate, stiffness, c};
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

/// Formulas for contact until F = 0.
inline constexpr std::array cut_dashpot_formulas{
    Formula{"exact", "root of e = exp(-2 zeta arccos(zeta)/sqrt(1-zeta^2))", "closed form, contact until F = 0",
            "reaches the target restitution", &exact_cut_ratio},
    Formula{"anagnostopoulos", "zeta = -ln e/sqrt(pi^2 + ln^2 e)", "Anagnostopoulos 1988, EESD 16:443; paper Eq. 7",
            "assumes contact until d = 0; yields 0.55 for a target of 0.50", &anagnostopoulos}};

}  // namespace pounding::laws
