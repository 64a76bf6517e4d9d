#pragma once
#include <array>
#include <string_view>

#include <pounding/hysteresis/imk_peak_oriented.hpp>

namespace pounding::hysteresis {

/// Pinching law of Ibarra, Medina & Krawinkler: ImkPeakOriented with a soft first part of reloading, towards the point
/// at (1 - kappaD) times the residual deformation of the peak; its force is kappaF times that of the line to the peak.
///
/// The rules are those of the material IMKPinching of OpenSees, applied at exact points.
struct ImkPinching : ImkReloading<ImkPinching> {
  static constexpr std::string_view
      name = "imk_pinching",
      shape = "backbone of imk_bilinear; reloading with kappaF of the slope to the peak, up to (1 - kappaD) d_res";
  static constexpr std::string_view summary =
      "connections and walls with pinching, deterioration and softening (IMKPinching)";
  static constexpr std::string_view source = imk_source;
  static constexpr std::string_view symbols =
      "d_res [m] residual deformation of the peak, kappaF, kappaD [-] pinching ratios, dp, dpc [m] deformations from "
      "yield to the maximum force and on to zero force, Lambda [m] energy capacity over Fy";
  static constexpr std::string_view range =
      "FmaxFy >= 1, 0 <= FresFy < 1, 0 < kappaF <= 1, 0 <= kappaD <= 1; Lambda is lambda theta_p, not lambda";
  static constexpr std::string_view beware = ImkPeakOriented::beware;

  double kappaF = 0;  ///< in (0, 1] [-]
  double kappaD = 0;  ///< in [0, 1] [-]

  static constexpr std::array parameters = imk_reloading_parameters<ImkPinching>(
      Parameter<ImkPinching>{{"kappaF", "", "force of the pinching point over that of the line to the peak", 0.4},
                             &ImkPinching::kappaF},
      Parameter<ImkPinching>{
          {"kappaD", "", "1 minus the ratio of the deformation of the pinching point to the residual one", 0.6},
          &ImkPinching::kappaD});
  static constexpr std::array state = imk_state<ImkPinching>;

  void check(Use use = Use::spring) const {
    Imk::check(use);
    if (!(kappaF > 0 && kappaF <= 1)) laws::refuse("kappaF", kappaF, "in (0, 1]");
    if (!(kappaD >= 0 && kappaD <= 1)) laws::refuse("kappaD", kappaD, "in [0, 1]");
  }
  /// Loads from zero force towards the pinching point.
  void reload(State& s) const noexcept {
    const ImkSide& a = of(s, s.side);
    const double x = s.side * s.deformation, force = backbone(a, a.peak);
    s.pinch = (1 - kappaD) * (a.peak - force / s.k);
    s.pinch_force = kappaF * force * (s.pinch - x) / (a.peak - x);
    if (x < s.pinch) return go_to(s, ImkRule::to_pinch, x, 0, s.pinch, s.pinch_force);
    go_to_turn_or_peak(s, x, 0);
  }
  /// Continues beyond the last reversal towards the pinching point or the peak.
  void resume(State& s) const noexcept {
    const ImkSide& a = of(s, s.side);
    const double force = backbone(a, a.peak);
    const bool is_ahead = a.turn < s.pinch && a.turn_force < s.pinch_force && s.pinch < a.peak && s.pinch_force < force;
    if (is_ahead && (s.pinch_force - a.turn_force) / (s.pinch - a.turn) < (force - a.turn_force) / (a.peak - a.turn))
      return go_to(s, ImkRule::to_pinch, a.turn, a.turn_force, s.pinch, s.pinch_force);
    go_to_peak(s, a.turn, a.turn_force);
  }
  /// Continues beyond the pinching point or the last reversal.
  void go_on(State& s) const noexcept {
    if (s.rule == ImkRule::to_pinch) return go_to_turn_or_peak(s, s.pinch, s.pinch_force);
    go_to_peak(s, s.end, of(s, s.side).turn_force);
  }
};

}  // namespace pounding::hysteresis
