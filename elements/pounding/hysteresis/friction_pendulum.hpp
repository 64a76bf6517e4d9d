#pragma once
#include <array>
#include <string_view>

#include <pounding/hysteresis/bilinear.hpp>
#include <pounding/hysteresis/made_of.hpp>

namespace pounding::hysteresis {

/// f = W d/R + q, |q| <= mu W in series with a spring mu W/u_y: a slider on a spherical surface with constant friction.
///
/// W [N] weight on the isolator, R [m] radius of the surface, mu [-] coefficient of friction, u_y [m] deformation at
/// the start of sliding, 0.5 to 1 mm. Zayas, Low & Mahin 1990, Earthq. Spectra 6:317. W is the static weight, and mu
/// does not depend on the velocity.
struct FrictionPendulum : MadeOf<FrictionPendulum, Bilinear> {
  static constexpr std::string_view name = "friction_pendulum",
                                    shape = "f = W d/R + q, |q| <= mu W in series with a spring mu W/u_y";
  static constexpr std::string_view summary =
      "sliding isolator on a spherical surface, constant friction (singleFPBearing)";
  static constexpr std::string_view source = "Zayas, Low & Mahin 1990, Earthq. Spectra 6:317";
  static constexpr std::string_view symbols =
      "W [N] weight on the isolator, R [m] radius of the surface, mu [-] coefficient of friction, u_y [m] deformation "
      "at the start of sliding";
  static constexpr std::string_view range = "any d; the rim of the surface is not modelled";
  static constexpr std::string_view beware =
      "the weight is the static one and the friction does not depend on the velocity. Uplift and the rim are not "
      "modelled";

  double weight = 0;                    ///< W > 0 [N]
  double radius = 0;                    ///< R > 0 [m]
  double friction = 0;                  ///< mu > 0 [-]
  double sliding_deformation = 0.5e-3;  ///< u_y > 0 [m]

  static constexpr std::array parameters{
      Parameter{{"weight", "N", "weight W on the isolator", 5e6}, &FrictionPendulum::weight},
      Parameter{{"radius", "m", "radius R of the surface", 2}, &FrictionPendulum::radius},
      Parameter{{"friction", "", "coefficient of friction mu", 0.06}, &FrictionPendulum::friction},
      Parameter{{"yield_displacement", "m", "deformation u_y at the start of sliding", 0.5e-3, Need::optional},
                &FrictionPendulum::sliding_deformation}};
  static constexpr std::array state{StateValue<FrictionPendulum>{
      {"slip", "m", "slip of the slider"}, [](const Bilinear::State& kept) { return kept.slip; }}};

  void check() const {
    laws::require_positive("weight", weight);
    laws::require_positive("radius", radius);
    laws::require_positive("friction", friction);
    laws::require_positive("yield_displacement", sliding_deformation);
  }
  /// The equivalent bilinear law.
  Bilinear made() const noexcept {
    const double dish = weight / radius, stick = friction * weight / sliding_deformation, k = dish + stick;
    return {.initial_stiffness = k, .yield_force = k * sliding_deformation, .hardening = dish / k};
  }
};

}  // namespace pounding::hysteresis
