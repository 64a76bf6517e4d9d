#pragma once
#include <array>
#include <optional>
#include <string_view>

#include <pounding/laws/damping_formulas.hpp>
#include <pounding/laws/exact_damping.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/linear_dashpot.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F = k d + c d' in approach (d' > 0), k d in restitution; c = 2 zeta sqrt(k m).
///
/// k [N/m], c [N s/m], zeta [-], m [kg] reduced mass, d [m], d' [m/s]. Mahmoud & Jankowski 2011, Iran. J. Sci. Tech.
/// 35(C1):51. The force jumps to c v at the touch and is continuous at the reversal. dF/dd' jumps at the
/// reversal; at d' = 0 it is that of the restitution phase. Never pulls.
struct ModifiedLinearViscoelastic {
  static constexpr std::string_view name = "modified_linear_viscoelastic",
                                    shape = "F = k d + c d' for d' > 0, k d for d' <= 0; c = 2 zeta sqrt(k m)";
  static constexpr std::string_view summary = "linear spring, dashpot in the approach only";
  static constexpr std::string_view source = "Mahmoud & Jankowski 2011, Iran. J. Sci. Tech. 35(C1):51";
  static constexpr std::string_view symbols = "k [N/m] contact stiffness, zeta [-] damping ratio, c [N s/m]";
  static constexpr std::string_view range = "any zeta >= 0";
  static constexpr std::string_view beware =
      "the force jumps to c v at the touch and is continuous at the reversal, where dF/dd' jumps. The force "
      "never pulls";
  static constexpr Quantity number{"damping_ratio", ""}, coefficient{"damping_coefficient", "N s/m"};
  static constexpr bool is_linear = true;

  static constexpr std::array formulas{
      Formula{"exact", "root of e = exp(-zeta arccos(zeta)/sqrt(1-zeta^2))", "closed form",
              "reaches the target restitution", &exact_approach_ratio},
      Formula{"mahmoud_jankowski_2011", "zeta = (1-e^2)/{e [e (pi-2) + 2]}", "Mahmoud & Jankowski 2011",
              "yields 0.506 for a target of 0.50", &mahmoud_jankowski_2011},
      Formula{"simple", "zeta = (1-e^2)/(pi e)", "paper Table 4", "yields 0.558 for a target of 0.50",
              &simple_approach},
      Formula{"naderpour_2015_eq38", "zeta = [2 (1-e^2)/(e sqrt(pi))]^2", "Naderpour, Barros & Khatami 2015, Eq. 38",
              "yields 0.161 for a target of 0.50; accurate only near 0.88", &naderpour_2015_eq38}};

  double stiffness = 0;                         ///< k [N/m]
  std::optional<double> restitution{};          ///< e in (0, 1], or
  std::optional<double> damping_ratio{};        ///< zeta >= 0 [-], or
  std::optional<double> damping_coefficient{};  ///< c >= 0 [N s/m]
  double reduced_mass = 0;                      ///< m [kg]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter<ModifiedLinearViscoelastic>{{"stiffness", "N/m", "contact stiffness k", 9.35e7},
                                            &ModifiedLinearViscoelastic::stiffness},
      Parameter<ModifiedLinearViscoelastic>{{"damping_ratio", "", "damping ratio zeta", 0.14, Need::damping},
                                            nullptr,
                                            &ModifiedLinearViscoelastic::damping_ratio},
      Parameter<ModifiedLinearViscoelastic>{{"damping_coefficient", "N s/m", "damping c", 6.6e5, Need::damping},
                                            nullptr,
                                            &ModifiedLinearViscoelastic::damping_coefficient}};

  void check() const { check_dashpot(*this); }

  /// zeta [-].
  double damping_number(double) const { return ratio_of_dashpot(*this); }
  /// c [N s/m], the same at every closing speed.
  double damping_for(double) const { return coefficient_of_dashpot(*this); }

  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    const double c = only_if(rate > 0, impact.damping);
    return {stiffness * penetration + c * rate, stiffness, c};
  }
  Response respond(double penetration, double rate, const Impact& impact) const noexcept {
    return pressed(*this, penetration, rate, impact);
  }
};

}  // namespace pounding::laws
