#pragma once
#include <array>
#include <cmath>
#include <string_view>

#include <pounding/hysteresis/imk.hpp>

namespace pounding::hysteresis {

/// Bilinear law of Ibarra, Medina & Krawinkler as modified by Lignos & Krawinkler: yield, hardening to a maximum force,
/// softening to a residual force; strength, softening line and unloading stiffness deteriorate with the work.
///
/// Ke [N/m] initial stiffness, Fy [N] yield force, dp [m] deformation from yield to the maximum force, dpc [m] from
/// there to zero force, Lambda [m] energy capacity over Fy. The rules are those of the material IMKBilin of OpenSees,
/// applied at exact points (zero force, reversal) instead of one step late: OpenSees agrees to 1e-7 as its steps are
/// refined. Deterioration makes later forces depend on every reversal on the backbone.
struct ImkBilinear : Imk<ImkBilinear> {
  static constexpr std::string_view name = "imk_bilinear",
                                    shape =
                                        "yield, hardening over dp, softening to zero over dpc; beta = (E/(Et-SE))^c";
  static constexpr std::string_view summary = "steel with deterioration and softening (IMKBilin)";
  static constexpr std::string_view source = imk_source;
  static constexpr std::string_view symbols =
      "dp, dpc [m] deformations from yield to the maximum force and on to zero force, E [J] work since the last zero "
      "force, SE [J] total work, Et = Lambda Fy [J], c [-] exponents";
  static constexpr std::string_view range =
      "FmaxFy >= 1, 0 <= FresFy < 1; Lambda has the unit of the deformation and is lambda theta_p, not lambda";
  static constexpr std::string_view beware =
      "softens, so equilibrium may be lost: a run can end in collapse. At a hinge dp and dpc are rotations of the "
      "spring alone. Each reversal on the backbone reduces the unloading stiffness, also that of a ripple. The spring "
      "fails for good when its energy capacity is used up";
  /// With typical parameters: a softer reversal returns more than a stiffer one, near the end of the energy capacity
  /// and where the residual branch halves the stiffness. The total loss is never negative.
  static constexpr double gives_back = 0.2;
  static constexpr bool turns_everywhere = false, halves_after_residual = true, keeps_other_side = true,
                        hardens_below_residual = false;

  static constexpr std::array parameters = imk_parameters<ImkBilinear>();
  static constexpr std::array state = imk_state<ImkBilinear>;

  /// Reduces the backbone of the side that is entered.
  void deteriorate(State& s, double beta_S, double beta_C) const noexcept {
    const Direction d = direction(s.side);
    const double residual = d.residual;
    ImkSide& a = of(s, s.side);
    if (a.slope + a.soft == 0) return;
    a.yield *= 1 - beta_S;
    a.slope *= 1 - beta_S;
    a.top *= 1 - beta_C;
    a.soft = std::max(d.maximum / d.dpc * (a.yield - residual) / (d.yield - residual), 0.0);
    a.base = a.yield - a.slope * a.yield / initial_stiffness;
    const double x = cap(a), force = std::isfinite(x) ? a.base + a.slope * x : 0;
    if (force < residual) {
      a.yield = a.base = a.top = residual;
      a.slope = a.soft = 0;
      return;
    }
    // As in OpenSees, a hardening line that begins below the residual force is rotated about the maximum.
    const double steepest = (force - residual) / (x - s.side * s.deformation - residual / initial_stiffness);
    if (steepest > 0 && steepest < a.slope) {
      a.slope = steepest;
      a.base = force - steepest * x;
    }
  }
  /// Loads from zero force along the unloading stiffness.
  void reload(State& s) const noexcept { climb(s, s.side * s.deformation, 0); }
  /// Continues beyond the last reversal.
  void resume(State& s) const noexcept {
    const ImkSide& a = of(s, s.side);
    s.is_on_backbone ? enter_backbone(s, a.turn) : climb(s, a.turn, a.turn_force);
  }
  /// This law reloads in one line.
  void go_on(State&) const noexcept {}
};

}  // namespace pounding::hysteresis
