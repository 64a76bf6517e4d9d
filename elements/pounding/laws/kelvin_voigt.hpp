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

/// F = k d + c d', c = 2 zeta sqrt(k m): linear spring and dashpot, in contact until d = 0.
///
/// k [N/m], c [N s/m], zeta [-], m [kg] reduced mass, d [m], d' [m/s]. Anagnostopoulos 1988, EESD 16:443; paper Eqs.
/// 5-7. The force jumps to c v at the touch and pulls near separation, as published; kelvin_voigt_no_tension cuts off
/// the tension. With zeta >= 1 free bodies never separate; e = 0 corresponds to zeta = 1. The published formula is
/// exact here.
struct KelvinVoigt {
  static constexpr std::string_view name = "kelvin_voigt", shape = "F = k d + c d', c = 2 zeta sqrt(k m)";
  static constexpr std::string_view summary = "linear spring and dashpot as published, with tension near separation";
  static constexpr std::string_view source = "Anagnostopoulos 1988, EESD 16:443";
  static constexpr std::string_view symbols = "k [N/m] contact stiffness, zeta [-] damping ratio, c [N s/m]";
  static constexpr std::string_view range = "zeta < 1; for zeta >= 1, which is e = 0, free bodies never separate";
  static constexpr std::string_view beware =
      "the force jumps to c v at the touch, and pulls near separation, as published: contact lasts until d = 0. The "
      "law kelvin_voigt_no_tension cuts off the tension";
  static constexpr Quantity number{"damping_ratio", ""}, coefficient{"damping_coefficient", "N s/m"};
  static constexpr bool may_pull = true, sticks_at_zero = true, is_linear = true;

  static constexpr std::array formulas{
      Formula{"exact", "zeta = -ln e/sqrt(pi^2 + ln^2 e)", "closed form, contact until d = 0",
              "identical to anagnostopoulos", &anagnostopoulos},
      Formula{"anagnostopoulos", "zeta = -ln e/sqrt(pi^2 + ln^2 e)", "Anagnostopoulos 1988, EESD 16:443; paper Eq. 7",
              "exact for this law", &anagnostopoulos}};

  double stiffness = 0;                         ///< k [N/m]
  std::optional<double> restitution{};          ///< e in [0, 1], or
  std::optional<double> damping_ratio{};        ///< zeta >= 0 [-], or
  std::optional<double> damping_coefficient{};  ///< c >= 0 [N s/m]
  double reduced_mass = 0;                      ///< m [kg]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter<KelvinVoigt>{{"stiffness", "N/m", "contact stiffness k", 9.35e7}, &KelvinVoigt::stiffness},
      Parameter<KelvinVoigt>{
          {"damping_ratio", "", "damping ratio zeta", 0.14, Need::damping}, nullptr, &KelvinVoigt::damping_ratio},
      Parameter<KelvinVoigt>{{"damping_coefficient", "N s/m", "damping c", 6.6e5, Need::damping},
                             nullptr,
                             &KelvinVoigt::damping_coefficient}};

  void check() const { check_dashpot(*this); }

  /// zeta [-].
  double damping_number(double) const { return ratio_of_dashpot(*this); }
  /// c [N s/m], the same at every closing speed.
  double damping_for(double) const { return coefficient_of_dashpot(*this); }

  Response contact(double penetration, double rate, const Impact& impact) const noexcept {
    return {stiffness * penetration + impact.damping * rate, stiffness, impact.damping};
  }
  Response respond(double penetration, double rate, const Impact& impact) const noexcept {
    return pressed(*this, penetration, rate, impact);
  }
};

}  // namespace pounding::laws
