#pragma once
#include <pounding/laws/linear_dashpot.hpp>

namespace pounding::laws {

/// Texts and formulas of ModifiedLinearViscoelastic.
struct ModifiedLinearViscoelasticTraits {
  static constexpr std::string_view name = "modified_linear_viscoelastic",
                                    shape = "F = k d + c d' for d' > 0, k d for d' <= 0; c = 2 zeta sqrt(k m)";
  static constexpr std::string_view summary = "linear spring, dashpot in the approach only";
  static constexpr std::string_view source = "Mahmoud & Jankowski 2011, Iran. J. Sci. Tech. 35(C1):51";
  static constexpr std::string_view range = "any zeta >= 0";
  static constexpr std::string_view beware =
      "the force jumps to c v at the touch and is continuous at the reversal, where dF/dd' jumps. The force "
      "never pulls";
  static constexpr bool damps_approach_only = true;

  static constexpr std::array formulas{
      Formula{"exact", "root of e = exp(-zeta arccos(zeta)/sqrt(1-zeta^2))", "closed form",
              "reaches the target restitution", &exact_approach_ratio},
      Formula{"mahmoud_jankowski_2011", "zeta = (1-e^2)/{e [e (pi-2) + 2]}", "Mahmoud & Jankowski 2011",
              "yields 0.506 for a target of 0.50", &mahmoud_jankowski_2011},
      Formula{"simple", "zeta = (1-e^2)/(pi e)", "paper Table 4", "yields 0.558 for a target of 0.50",
              &simple_approach},
      Formula{"naderpour_2015_eq38", "zeta = [2 (1-e^2)/(e sqrt(pi))]^2", "Naderpour, Barros & Khatami 2015, Eq. 38",
              "yields 0.161 for a target of 0.50; accurate only near 0.88", &naderpour_2015_eq38}};
};

/// F = k d + c d' in approach (d' > 0), k d in restitution; c = 2 zeta sqrt(k m).
///
/// k [N/m], c [N s/m], zeta [-], m [kg] reduced mass, d [m], d' [m/s]. Mahmoud & Jankowski 2011, Iran. J. Sci. Tech.
/// 35(C1):51. The force jumps to c v at the touch and is continuous at the reversal; dF/dd' jumps there, and
/// at d' = 0 is that of the restitution phase. Never pulls.
using ModifiedLinearViscoelastic = LinearDashpotLaw<ModifiedLinearViscoelasticTraits>;

}  // namespace pounding::laws
