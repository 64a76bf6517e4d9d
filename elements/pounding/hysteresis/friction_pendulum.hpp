#pragma once
#include <array>
#include <string_view>

#include <pounding/hysteresis/bilinear.hpp>
#include <pounding/hysteresis/made_of.hpp>

namespace pounding::hysteresis {

/// f = W d/R + q, |q| <= mu W behind a spring mu W/u_y: a slider in a dish with one coefficient of friction.
///
/// W [N] weight on it, R [m] radius of the dish, mu [-] coefficient of friction, u_y [m] deformation before it slides,
/// 0.5 to 1 mm. Zayas, Low & Mahin 1990, Earthq. Spectra 6:317. W stays that at rest, and mu does not depend on the
/// velocity.
struct FrictionPendulum : MadeOf<FrictionPendulum, Bilinear> {
  static constexpr std::string_view name = "friction_pendulum",
                                    shape = "f = W d/R + q, |q| <= mu W behind a spring mu W/u_y";
  static constexpr std::string_view summary = "sliding isolator in a dish, constant friction (singleFPBearing)";
  static constexpr std::string_view source = "Zayas, Low & Mahin 1990, Earthq. Spectra 6:317";
  static constexpr std::string_view symbols =
      "W [N] weight on it, R [m] radius of the dish, mu [-] coefficient of friction, u_y [m] deformation before it "
      "slides";
  static constexpr std::string_view range = "any d; a real dish ends at its rim";
  static constexpr std::string_view beware =
      "the weight stays that at rest and the friction does not depend on the velocity; uplift and the rim are not in "
      "it";

  double weight = 0;                    ///< W > 0 [N]
  double radius = 0;                    ///< R > 0 [m]
  double friction = 0;                  ///< mu > 0 [-]
  double sliding_deformation = 0.5e-3;  ///< u_y > 0 [m]

  static constexpr std::array parameters{
      Parameter{{"weight", "N", "weight on it W", 5e6}, &FrictionPendulum::weight},
      Parameter{{"radius", "m", "radius of the dish R", 2}, &FrictionPendulum::radius},
      Parameter{{"friction", "", "coefficient of friction mu", 0.06}, &FrictionPendulum::friction},
      Parameter{{"yield_displacement", "m", "deformation before it slides u_y", 0.5e-3, Need::optional},
                &FrictionPendulum::sliding_deformation}};
  static constexpr std::array state{StateValue<FrictionPendulum>{
      {"slip", "m", "slip of the slider"}, [](const Bilinear::State& kept) { return kept.slip; }}};

  void check() const {
    laws::require_positive("weight", weight);
    laws::require_positive("radius", radius);
    laws::require_positive("friction", friction);
    laws::require_positive("yield_displacement", sliding_deformation);
  }
  /// The law that it is.
  Bilinear made() const noexcept {
    const double dish = weight / radius, stick = friction * weight / sliding_deformation, k = dish + stick;
    return {.initial_stiffness = k, .yield_force = k * sliding_deformation, .hardening = dish / k};
  }
};

}  // namespace pounding::hysteresis
