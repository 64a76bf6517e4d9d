#pragma once
#include <pounding/laws/linear_dashpot.hpp>

namespace pounding::laws {

/// Texts and formulas of KelvinVoigtNoTension.
struct KelvinVoigtNoTensionTraits {
  static constexpr std::string_view name = "kelvin_voigt_no_tension",
                                    shape = "F = max(0, k d + c d'), c = 2 zeta sqrt(k m)";
  static constexpr std::string_view summary = "linear spring and dashpot without tension";
  static constexpr std::string_view source = "Anagnostopoulos 2004, EESD 33:897";
  static constexpr std::string_view range = "any zeta >= 0";
  static constexpr std::string_view beware =
      "the force jumps to c v at the touch. It is released at d > 0, so the published ratio, which assumes contact "
      "until d = 0, yields a higher restitution than its target";
  static constexpr auto& formulas = cut_dashpot_formulas;
};

/// F = max(0, k d + c d'), c = 2 zeta sqrt(k m): linear spring and dashpot without tension.
///
/// k [N/m], c [N s/m], zeta [-], m [kg] reduced mass, d [m], d' [m/s]. Anagnostopoulos 1988 and 2004, EESD 33:897.
/// The force jumps to c v at the touch and is released at d > 0. The published ratio assumes contact until d = 0, so
/// with the cut-off it yields a higher restitution than its target (0.25 for 0.10, 0.55 for 0.50); `exact` accounts for
/// the cut-off.
using KelvinVoigtNoTension = LinearDashpotLaw<KelvinVoigtNoTensionTraits>;

}  // namespace pounding::laws
