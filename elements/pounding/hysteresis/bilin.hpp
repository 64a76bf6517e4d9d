#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <pounding/hysteresis/imk_superseded.hpp>

namespace pounding::hysteresis {

/// Bilinear law of Ibarra, Medina & Krawinkler in its first implementation, the material Bilin of OpenSees, in the
/// limit of small steps. Its authors replaced it by ImkBilinear.
///
/// After a deterioration the next zero force deteriorates only if the backbone was reached in between, or if the last
/// reversal at a peak of the side lies on its new hardening or softening line. The softening line turns about the
/// maximum; where it begins on the elastic line below yield, the spring fails if it reaches zero force before the
/// earlier peak. The unloading stiffness is at least 0.1 of the initial one, and reversals from the negative side keep
/// it if a softening line is flatter than 1e-3 of it. Both sides stop to deteriorate once the yield force has fallen
/// to the residual one.
///
/// OpenSees agrees to 1e-6 as its steps are refined, with these exceptions. If Lambda_C is well below Lambda_S, so
/// that the softening line begins on the elastic one, 1 path in 20 differs on its residual branch, as some do at zero
/// force with FresFy = 0. If unloading meets the other backbone within 1e-10 of zero deformation, OpenSees omits that
/// deterioration. Exponents other than whole numbers make its result NaN by round-off of an energy that is zero.
/// Lambda_A has no effect there.
///
/// nFactor is the ratio n of the spring to the member in series: the betas reduce ratios of the member.
struct Bilin : SupersededImk<Bilin> {
  static constexpr std::string_view name = "bilin", replaced_by = "imk_bilinear",
                                    shape =
                                        "yield, hardening over dp, softening to zero over dpc; beta = (E/(Et-SE))^c";
  static constexpr std::string_view summary = "steel with deterioration and softening, superseded (Bilin)";
  static constexpr std::string_view source = imk_source;
  static constexpr std::string_view symbols =
      "dp, dpc [m] deformations from yield to the maximum force and on to zero force, E [J] work since the last "
      "deterioration, SE [J] total work, Et = Lambda Fy [J], twice that for the unloading stiffness, c [-] exponents";
  static constexpr std::string_view range =
      "FmaxFy >= 1, 0 <= FresFy < 1, nFactor >= 0; Lambda has the unit of the deformation and is lambda theta_p, not "
      "lambda";
  static constexpr std::string_view beware =
      "superseded: its authors replaced it by imk_bilinear (IMKBilin). Softens, so equilibrium may be lost: a run can "
      "end in collapse. Each reversal on the backbone reduces the unloading stiffness, also that of a ripple";
  /// With typical parameters, from the softer unloading of later reversals. The total loss is never negative.
  static constexpr double gives_back = 0.1;

  double nFactor = 0;  ///< n >= 0; stiffness and hardening are those of the spring, K0 (1 + n) [-]

  static constexpr std::array parameters = imk_parameters<Bilin>(
      Parameter<Bilin>{{"nFactor", "", "ratio of the stiffness of the spring to that of its member, for deterioration",
                        0, Need::optional},
                       &Bilin::nFactor});
  static constexpr std::array state = imk_state<Bilin>;

  void check(Use use = Use::spring) const {
    Imk::check(use);
    laws::require_not_negative("nFactor", nFactor);
  }
  /// Slope of the softening line before any deterioration [N/m].
  double softening(const Direction& d) const noexcept {
    return -initial_stiffness * in_series(-d.maximum / d.dpc * (1 + nFactor) / initial_stiffness);
  }
  static constexpr bool fails_at_beta_1 = false;
  /// True if strength deteriorates at this zero of the force.
  bool is_due(const State& s) const noexcept { return s.is_due && !s.is_final && s.rule == ImkRule::unloading; }
  /// Reverses the direction of loading; keeps the largest deformation on the backbone.
  void turn(State& s, int way) const noexcept {
    if (s.rule > ImkRule::below && s.rule < ImkRule::lost && way != s.side) {
      ImkSide& a = of(s, s.side);
      if (const double x = s.side * s.deformation; x >= a.peak) a.limit = a.peak = x;
    }
    Imk::turn(s, way);
  }
  /// Unloading stiffness after a reversal here [N/m]; 0 if the spring fails.
  double unloading_stiffness(const State& s) const noexcept {
    if (s.rule < ImkRule::below || !Lambda_K) return s.k;
    const double force = force_at(s, s.deformation), returned = 0.5 * force * force / s.k;
    const double rest = 2 * *Lambda_K * yield_force - s.work + returned, added = s.work - s.begun - returned;
    if (!(rest > 0)) return 0;
    const double k = initial_stiffness, flat = 1e-3 * k / (1 + nFactor);
    if (s.is_final || ((s.side < 0) != is_mirrored && std::min(s.sides[0].soft, s.sides[1].soft) < flat)) return s.k;
    const double beta = std::min(std::pow(std::max(added, 0.0) / rest, c_K), 1.0);
    return k * in_series(std::max(0.1, of_member(s.k / k) * (1 - beta)));
  }
  /// Lowers the backbone of the side that is entered.
  void deteriorate(State& s, double beta_S, double /*beta_A*/, double beta_C) const noexcept {
    const Direction d = direction(s.side);
    const double k = initial_stiffness, steep = softening(d);
    ImkSide& a = of(s, s.side);
    const double peak = cap(a), intercept = (1 - beta_C) * (a.base + (a.slope + steep) * peak);
    const double yield = (1 - beta_S) * a.yield;
    s.is_final = yield <= d.residual;
    if (s.is_final)
      lower(a, d, d.residual, 1e-4 * k, d.residual, 1e-6 * k);
    else
      lower(a, d, yield, k * in_series((1 - beta_S) * of_member(a.slope / k)), intercept,
            -k * in_series(of_member(-steep / k) * (yield - d.residual) / (d.yield - d.residual)));
    // Below the earlier peak, a softening line that begins on the elastic one continues to zero force.
    if (a.residual < d.residual && a.top < a.soft * a.peak) a.residual = 0;
    s.is_due = a.limit > a.yield / k && (a.limit <= cap(a) || a.limit <= (a.top - a.residual) / a.soft);
  }
  /// Residual force of the present side [N].
  double plateau(const State& s) const noexcept { return of(s, s.side).residual > 0 ? direction(s.side).residual : 0; }
  /// True if a softening line that reaches zero force at x ends the law.
  bool fails_without_residual(const ImkSide& a, double x) const noexcept { return x < a.peak; }
  /// Loads from zero force along the unloading stiffness.
  void reload(State& s) const noexcept { climb(s, s.side * s.deformation, 0); }
  /// Continues beyond the last reversal.
  void resume(State& s) const noexcept {
    const ImkSide& a = of(s, s.side);
    s.is_on_backbone ? enter_backbone(s, a.turn) : climb(s, a.turn, a.turn_force);
  }
  /// This law reloads in one line.
  void go_on(State&) const noexcept {}

 private:
  /// Ratio of a stiffness to the initial one, of the spring for that of the member, and of the member.
  double in_series(double ratio) const noexcept { return ratio / (1 + nFactor * (1 - ratio)); }
  double of_member(double ratio) const noexcept { return ratio * (1 + nFactor) / (1 + nFactor * ratio); }
};

}  // namespace pounding::hysteresis
