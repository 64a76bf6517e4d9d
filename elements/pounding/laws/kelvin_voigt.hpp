#pragma once
#include <pounding/laws/linear_dashpot.hpp>

namespace pounding::laws {

/// Texts and formulas of KelvinVoigt.
struct KelvinVoigtTraits {
  static constexpr std::string_view name = "kelvin_voigt", shape = "F = k d + c d', c = 2 zeta sqrt(k m)";
  static constexpr std::string_view summary = "linear spring and dashpot as published, with tension near separation";
  static constexpr std::string_view source = "Anagnostopoulos 1988, EESD 16:443";
  static constexpr std::string_view range = "zeta < 1; for zeta >= 1, which is e = 0, free bodies never separate";
  static constexpr std::string_view beware =
      "the force jumps to c v at the touch, and pulls near separation, as published: contact lasts until d = 0. The "
      "law kelvin_voigt_no_tension cuts off the tension";
  static constexpr bool may_pull = true, sticks_at_zero = true;

  static constexpr std::array formulas{
      Formula{"exact", "zeta = -ln e/sqrt(pi^2 + ln^2 e)", "closed form, contact until d = 0",
              "identical to anagnostopoulos", &anagnostopoulos},
      Formula{"anagnostopoulos", "zeta = -ln e/sqrt(pi^2 + ln^2 e)", "Anagnostopoulos 1988, EESD 16:443; paper Eq. 7",
              "exact for this law", &anagnostopoulos}};
};

/// F = k d + c d', c = 2 zeta sqrt(k m): linear spring and dashpot, in contact until d = 0.
///
/// k [N/m], c [N s/m], zeta [-], m [kg] reduced mass, d [m], d' [m/s]. Anagnostopoulos 1988, EESD 16:443; paper Eqs.
/// 5-7. The force jumps to c v at the touch and pulls near separation, as published; kelvin_voigt_no_tension cuts off
/// the tension. With zeta >= 1 free bodies never separate; e = 0 corresponds to zeta = 1. The published formula is
/// exact here.
using KelvinVoigt = LinearDashpotLaw<KelvinVoigtTraits>;

}  // namespace pounding::laws
