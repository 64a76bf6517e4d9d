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

/// F = max(0, k d + c d'), c = 2 zeta sqrt(k m): linear spring and dashpot without tension.
///
/// k [N/m], c [N s/m], zeta [-], m [kg] reduced mass, d [m], d' [m/s]. Anagnostopoulos 1988 and 2004, EESD 33:897.
/// The force jumps to c v at the touch and is released at d > 0. The published ratio assumes contact until d = 0, so
/// with the cut-off it yields a higher restitution than its target (0.25 for 0.10, 0.55 for 0.50); `exact` accounts for
/// the cut-off.
struct KelvinVoigtNoTension {
  static constexpr std::string_view name = "kelvin_voigt_no_tension",
                                    shape = "F = max(0, k d + c d'), c = 2 zeta sqrt(k m)";
  static constexpr std::string_view summary = "linear spring and dashpot without tension";
  static constexpr std::string_view source = "Anagnostopoulos 2004, EESD 33:897";
  static constexpr std::string_view symbols = "k [N/m] contact stiffness, zeta [-] damping ratio, c [N s/m]";
  static constexpr std::string_view range = "any zeta >= 0";
  static constexpr std::string_view beware =
      "the force jumps to c v at the touch. It is released at d > 0, so the published ratio, which assumes contact "
      "until d = 0, yields a higher restitution than its target";
  static constexpr Quantity number{"damping_ratio", ""}, coefficient{"damping_coefficient", "N s/m"};
  static constexpr bool is_linear = true;

  static constexpr std::array formulas{
      Formula{"exact", "root of e = exp(-2 zeta arccos(zeta)/sqrt(1-zeta^2))", "closed form, contact until F = 0",
              "reaches the target restitution", &exact_cut_ratio},
      Formula{"anagnostopoulos", "zeta = -ln e/sqrt(pi^2 + ln^2 e)", "Anagnostopoulos 1988, EESD 16:443; paper Eq. 7",
              "assumes contact until d = 0; yields 0.55 for a target of 0.50", &anagnostopoulos}};

  double stiffness = 0;                         ///< k [N/m]
  std::optional<double> restitution{};          ///< e in (0, 1], or
  std::optional<double> damping_ratio{};        ///< zeta >= 0 [-], or
  std::optional<double> damping_coefficient{};  ///< c >= 0 [N s/m]
  double reduced_mass = 0;                      ///< m [kg]
  DampingFormula formula = formulas[0].function;

  static constexpr std::array parameters{
      Parameter<KelvinVoigtNoTension>{{"stiffness", "N/m", "contact stiffness k", 9.35e7},
                                      &KelvinVoigtNoTension::stiffness},
      Parameter<KelvinVoigtNoTension>{{"damping_ratio", "", "damping ratio zeta", 0.14, Need::damping},
                                      nullptr,
                                      &KelvinVoigtNoTension::damping_ratio},
      Parameter<KelvinVoigtNoTension>{{"damping_coefficient", "N s/m", "damping c", 6.6e5, Need::damping},
                                      nullptr,
                                      &KelvinVoigtNoTension::damping_coefficient}};

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
