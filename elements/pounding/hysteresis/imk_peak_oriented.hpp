#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <pounding/hysteresis/imk.hpp>

namespace pounding::hysteresis {

/// Table of the parameters of law L, derived from ImkReloading, which may have more.
template <class L, class... More>
constexpr auto imk_reloading_parameters(const More&... more) {
  using P = Parameter<L>;
  return imk_parameters<L>(
      P{{"Lambda_A", "m", "energy capacity Lambda of accelerated reloading (default: no deterioration)", 1.5,
         Need::optional},
        &L::Lambda_A},
      P{{"c_A", "", "exponent of this deterioration", 1, Need::optional}, &L::c_A}, more...);
}

/// Base of the laws that reload towards earlier peaks, with a fourth deterioration: at zero force, the deformation of
/// the peak of the side that is entered is multiplied by 1 + beta_A.
template <class Self>
struct ImkReloading : Imk<Self> {
  using State = ImkState;  ///< accepted state
  static constexpr bool turns_everywhere = true, halves_after_residual = false, keeps_other_side = false,
                        hardens_below_residual = false;
  /// With typical parameters: reloading may be stiffer than unloading. The total loss is never negative.
  static constexpr double gives_back = 0.1;

  std::optional<double> Lambda_A{};  ///< energy capacity of accelerated reloading over Fy [m]
  double c_A = 1;                    ///< exponent > 0 [-]
  /// Reduces the backbone of the side that is entered and moves its peak outwards.
  void deteriorate(State& s, double beta_S, double beta_C) const noexcept {
    const double beta_A = this->beta(s, Lambda_A, c_A);
    ImkSide& a = this->of(s, s.side);
    a.yield *= 1 - beta_S;
    a.slope *= 1 - beta_S;
    a.top *= 1 - beta_C;
    a.peak *= 1 + this->direction(s.side).D * beta_A;
    a.base = a.yield - a.slope * a.yield / this->initial_stiffness;
    if (beta_A >= 1 || !(this->backbone(a, a.peak) > 0)) this->fail(s);
  }

 protected:
  /// Line from (x, f) to a point; straight to the backbone if that point does not lie ahead.
  void go_to(State& s, ImkRule rule, double x, double f, double to, double force) const noexcept {
    if (to > x)
      this->begin(s, rule, x, f, (force - f) / (to - x), to);
    else
      this->enter_backbone(s, x);
  }
  void go_to_peak(State& s, double x, double f) const noexcept {
    const ImkSide& a = this->of(s, s.side);
    go_to(s, ImkRule::reloading, x, f, a.peak, this->backbone(a, a.peak));
  }
  /// Line from (x, f) to the last reversal if it is steeper than that to the peak, which otherwise is the target.
  void go_to_turn_or_peak(State& s, double x, double f) const noexcept {
    const ImkSide& a = this->of(s, s.side);
    const double peak_force = this->backbone(a, a.peak);
    const bool is_ahead = x < a.turn && f < a.turn_force && a.turn_force < peak_force;
    if (is_ahead && (a.turn_force - f) / (a.turn - x) > (peak_force - f) / (a.peak - x))
      return go_to(s, ImkRule::to_turn, x, f, a.turn, a.turn_force);
    go_to_peak(s, x, f);
  }
};

/// Peak-oriented law of Ibarra, Medina & Krawinkler: the backbone and the deterioration of ImkBilinear; reloading from
/// zero force towards the last reversal of the side, then towards its peak.
///
/// The rules are those of the material IMKPeakOriented of OpenSees, applied at exact points. The backbone never falls
/// below the residual force.
struct ImkPeakOriented : ImkReloading<ImkPeakOriented> {
  static constexpr std::string_view name = "imk_peak_oriented",
                                    shape =
                                        "backbone of imk_bilinear; reloading towards the last reversal and the peak";
  static constexpr std::string_view summary = "reinforced concrete with deterioration and softening (IMKPeakOriented)";
  static constexpr std::string_view source = imk_source;
  static constexpr std::string_view symbols =
      "dp, dpc [m] deformations from yield to the maximum force and on to zero force, Lambda [m] energy capacity over "
      "Fy, c [-] exponents";
  static constexpr std::string_view range =
      "FmaxFy >= 1, 0 <= FresFy < 1; Lambda has the unit of the deformation and is lambda theta_p, not lambda";
  static constexpr std::string_view beware =
      "softens, so equilibrium may be lost: a run can end in collapse. At a hinge dp and dpc are rotations of the "
      "spring alone. Each reversal after yield reduces the unloading stiffness, also that of a ripple. The spring "
      "fails for good when its energy capacity is used up";

  static constexpr std::array parameters = imk_reloading_parameters<ImkPeakOriented>();
  static constexpr std::array state = imk_state<ImkPeakOriented>;

  /// Loads from zero force towards the last reversal or the peak.
  void reload(State& s) const noexcept { go_to_turn_or_peak(s, s.side * s.deformation, 0); }
  /// Continues beyond the last reversal towards the peak.
  void resume(State& s) const noexcept { go_to_peak(s, of(s, s.side).turn, of(s, s.side).turn_force); }
  /// Continues beyond the last reversal towards the peak.
  void go_on(State& s) const noexcept { go_to_peak(s, s.end, of(s, s.side).turn_force); }
};

}  // namespace pounding::hysteresis
