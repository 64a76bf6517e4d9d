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

/// F = k d + c d' while positive, c = 2 zeta sqrt(k m); the contact ends at F = 0, and the remaining penetration is
/// added to the gap.
///
/// k [N/m], c [N s/m], zeta [-], m [kg] reduced mass, d [m], d' [m/s]. Komodromos, Polycarpou, Papaloizou & Phocas
/// 2007, EESD 36:1917. A single free impact is the same as with kelvin_voigt_no_tension; the indentation affects later
/// impacts.
struct Komodromos {
  static constexpr std::string_view name = "komodromos",
                                    shape = "F = k d + c d' until F = 0, then the contact ends; c = 2 zeta sqrt(k m)";
  static constexpr std::string_view summary =
      "linear spring and dashpot; ends at zero force, indentation widens the gap";
  static constexpr std::string_view source = "Komodromos et al. 2007, EESD 36:1917";
  static constexpr std::string_view symbols = "k [N/m] contact stiffness, zeta [-] damping ratio, c [N s/m]";
  static constexpr std::string_view range = "any zeta >= 0";
  static constexpr std::string_view beware =
      "the force jumps to c v at the touch. The penetration left at F = 0 is added to the gap for the rest of the run";
  static constexpr Quantity number{"damping_ratio", ""}, coefficient{"damping_coefficient", "N s/m"};
  static constexpr bool leaves_indentation = true, is_linear = true;

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
      Parameter<Komodromos>{{"stiffness", "N/m", "contact stiffness k", 9.35e7}, &Komodromos::stiffness},
      Parameter<Komodromos>{
          {"damping_ratio", "", "damping ratio zeta", 0.14, Need::damping}, nullptr, &Komodromos::damping_ratio},
      Parameter<Komodromos>{{"damping_coefficient", "N s/m", "damping c", 6.6e5, Need::damping},
                            nullptr,
                            &Komodromos::damping_coefficient}};

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
