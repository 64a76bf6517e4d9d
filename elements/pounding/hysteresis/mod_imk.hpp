#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <pounding/hysteresis/imk_peak_oriented.hpp>
#include <pounding/hysteresis/imk_superseded.hpp>

namespace pounding::hysteresis {

/// Base of the superseded laws that reload towards earlier peaks: from the last zero force of the side over a corner,
/// which Self provides, to the peak. A path below this line has the unloading stiffness; at the peak the force jumps to
/// the backbone. Every reversal, also below the backbone and during unloading, reduces the unloading stiffness.
///
/// OpenSees agrees to 1e-6 as its steps are refined. It loses all force at the first zero force if its Lamda_D is 0,
/// where this law without Lambda_C does not deteriorate the softening line; 1e9 does the same there. Exponents other
/// than whole numbers make its result NaN by round-off of an energy that is zero.
template <class Self>
struct ModImk : SupersededImk<Self> {
  using State = ImkState;  ///< accepted state
  /// With typical parameters: from the jump at the peak and the softer unloading of later reversals.
  static constexpr double gives_back = 0.2;
  static constexpr bool ripples_give_back = true;  ///< each reversal unloads softer than it reloads

  /// A point of the line of reloading.
  struct Point {
    double x = 0, force = 0;
  };

  /// True if strength deteriorates at this zero of the force: always.
  bool is_due(const State&) const noexcept { return true; }
  /// True if a softening line that reaches zero force ends the law: never.
  bool fails_without_residual(const ImkSide&, double) const noexcept { return false; }
  /// Reverses the direction of loading, with the weakened unloading stiffness.
  void turn(State& s, int way) const noexcept {
    const bool loads = s.rule != ImkRule::unloading;
    if (s.rule == ImkRule::elastic || s.rule == ImkRule::failed || (way == s.side) == loads) return;
    ImkSide& a = this->of(s, s.side);
    const double x = s.side * s.deformation, f = s.side * this->force_at(s, s.deformation), before = s.k;
    std::tie(s.ratio, s.k) = weakened(s);
    if (s.k == 0) return this->fail(s);
    if (!loads) return load(s, x, f);
    if (s.rule >= ImkRule::below) {
      a.peak = x;
      a.zero = x - f / s.k;
    }
    if (s.rule >= ImkRule::below || s.slope != before || s.k != before) {
      a.turn = x;
      a.turn_force = f;
    }
    if (f == 0) return this->cross(s, way);
    this->begin(s, ImkRule::unloading, x, f, s.k, 0);
  }
  /// Unloading stiffness after a reversal here [N/m].
  double unloading_stiffness(const State& s) const noexcept {
    return s.rule == ImkRule::unloading ? s.k : weakened(s).second;
  }
  /// Lowers the backbone of the side that is entered, and moves its peak outwards.
  void deteriorate(State& s, double beta_S, double beta_A, double beta_C) const noexcept {
    ImkSide& a = this->of(s, s.side);
    a.peak *= 1 + beta_A;
    this->lower(a, this->direction(s.side), (1 - beta_S) * a.yield, (1 - beta_S) * a.slope, (1 - beta_C) * a.top,
                a.soft);
  }
  /// Loads from zero force.
  void reload(State& s) const noexcept {
    ImkSide& a = this->of(s, s.side);
    a.zero = s.side * s.deformation;
    a.peak < this->direction(s.side).du ? load(s, a.zero, 0) : this->fail(s);
  }
  /// turn() begins the way back to the last reversal.
  void resume(State&) const noexcept {}
  /// Continues on the line of reloading.
  void go_on(State& s) const noexcept { load(s, s.end, s.side * this->force_at(s, s.side * s.end)); }

 private:
  const Self& self() const noexcept { return static_cast<const Self&>(*this); }

  /// Product of all 1 - beta_K and the unloading stiffness after a reversal here, 0 if the spring fails.
  std::pair<double, double> weakened(State s) const noexcept {
    const int way = s.rule == ImkRule::unloading ? s.side : -s.side;
    if (s.rule >= ImkRule::below) this->of(s, s.side).peak = s.side * s.deformation;
    if (!this->Lambda_K || self().keeps_stiffness(s, way)) return {s.ratio, s.k};
    const double force = this->force_at(s, s.deformation), returned = 0.5 * force * force / s.k;
    const double rest = 2 * *this->Lambda_K * this->yield_force - s.work + returned;
    const double added = std::max(s.work - s.begun - returned, 0.0);
    if (!(rest > 0)) return {0, 0};
    const double ratio = s.ratio * (1 - std::pow(added / rest, this->c_K));
    const double k = std::max(this->initial_stiffness * ratio, self().min_stiffness(s));
    return {ratio, k > this->of(s, -way).slope ? k : 0};
  }
  /// Loads from (x, f), on the line of reloading or below it.
  void load(State& s, double x, double f) const noexcept {
    const ImkSide& a = this->of(s, s.side);
    if (x >= a.peak) return this->enter_backbone(s, x);
    if (x < a.zero) return this->begin(s, ImkRule::to_turn, x, f, s.k, a.zero);
    const Point corner = self().corner_of(s), peak{a.peak, this->backbone(a, a.peak)}, zero{a.zero, 0};
    const bool is_first = x < corner.x;
    const Point from = is_first ? zero : corner, to = is_first ? corner : peak;
    const double slope = (to.force - from.force) / (to.x - from.x), line = from.force + slope * (x - from.x);
    if (Self::fails_if_steeper && slope > s.k * (1 + 1e-8)) return this->fail(s);
    const ImkRule rule = is_first ? ImkRule::to_turn : ImkRule::reloading;
    if (slope <= s.k && f >= line - 1e-12 * a.yield) return this->begin(s, rule, x, line, slope, to.x);
    const double meets = slope < s.k ? x + (line - f) / (s.k - slope) : HUGE_VAL;
    meets < to.x ? this->begin(s, ImkRule::to_turn, x, f, s.k, meets) : this->begin(s, rule, x, f, s.k, to.x);
  }
};

/// Peak-oriented law of Ibarra, Medina & Krawinkler in its first implementation, the material ModIMKPeakOriented of
/// OpenSees, in the limit of small steps. Its authors replaced it by ImkPeakOriented.
///
/// Reloading from zero force goes towards the last reversal of the side if that is steeper, then towards its peak.
struct ModImkPeakOriented : ModImk<ModImkPeakOriented> {
  static constexpr std::string_view name = "mod_imk_peak_oriented", replaced_by = "imk_peak_oriented",
                                    shape = "backbone of bilin; reloading towards the last reversal and the peak";
  static constexpr std::string_view summary =
      "reinforced concrete with deterioration and softening, superseded (ModIMKPeakOriented)";
  static constexpr std::string_view source = imk_source;
  static constexpr std::string_view symbols =
      "dp, dpc [m] deformations from yield to the maximum force and on to zero force, Lambda [m] energy capacity over "
      "Fy, twice that for the unloading stiffness, c [-] exponents";
  static constexpr std::string_view range =
      "FmaxFy >= 1, 0 <= FresFy < 1; Lambda has the unit of the deformation and is lambda theta_p, not lambda";
  static constexpr std::string_view beware =
      "superseded: its authors replaced it by imk_peak_oriented (IMKPeakOriented). Softens, so equilibrium may be "
      "lost: "
      "a run can end in collapse. Each reversal reduces the unloading stiffness, also that of a ripple, and the force "
      "jumps where reloading with it reaches the peak";

  static constexpr std::array parameters = imk_reloading_parameters<ModImkPeakOriented>();
  static constexpr std::array state = imk_state<ModImkPeakOriented>;
  static constexpr bool fails_if_steeper = false, fails_at_beta_1 = false;

  /// True if a reversal keeps the unloading stiffness: never.
  bool keeps_stiffness(const State&, int) const noexcept { return false; }
  /// Lower bound of the unloading stiffness [N/m].
  double min_stiffness(const State&) const noexcept { return 0; }
  /// The last reversal, if it lies above the straight line to the peak; else the zero force.
  Point corner_of(const State& s) const noexcept {
    const ImkSide& a = of(s, s.side);
    const double force = backbone(a, a.peak);
    // The residual branch of OpenSees rises by 1e-7 N/m, so that an earlier point on it lies below.
    const bool is_lower = a.turn_force < force || (a.turn_force == force && force == a.residual);
    const bool is_above =
        a.turn > a.zero && a.turn < a.peak && is_lower && a.turn_force * (a.peak - a.zero) > force * (a.turn - a.zero);
    return is_above ? Point{a.turn, a.turn_force} : Point{a.zero, 0};
  }
};

/// Pinching law of Ibarra, Medina & Krawinkler in its first implementation, the material ModIMKPinching of OpenSees, in
/// the limit of small steps. Its authors replaced it by ImkPinching.
///
/// Reloading goes first to the deformation A_pinch d_res, with Fpr times the slope to the peak, then to the peak. The
/// spring fails where that is stiffer than unloading. Unloading is no softer than the line between both peaks.
struct ModImkPinching : ModImk<ModImkPinching> {
  static constexpr std::string_view name = "mod_imk_pinching", replaced_by = "imk_pinching",
                                    shape =
                                        "backbone of bilin; reloading with Fpr of the slope to the peak, up to "
                                        "A_pinch d_res";
  static constexpr std::string_view summary =
      "connections and walls with pinching, deterioration and softening, superseded (ModIMKPinching)";
  static constexpr std::string_view source = imk_source;
  static constexpr std::string_view symbols =
      "d_res [m] residual deformation of the peak, Fpr, A_pinch [-] pinching ratios, dp, dpc [m] deformations from "
      "yield to the maximum force and on to zero force, Lambda [m] energy capacity over Fy, twice that for the "
      "unloading stiffness";
  static constexpr std::string_view range =
      "FmaxFy >= 1, 0 <= FresFy < 1, 0 < FprPos, FprNeg <= 1, 0 <= A_pinch <= 1; Lambda is lambda theta_p, not lambda";
  static constexpr std::string_view beware =
      "superseded: its authors replaced it by imk_pinching (IMKPinching). With Lambda_K, the spring loses its force "
      "for "
      "good at the first ripple of unloading behind a peak. Softens, so equilibrium may be lost";

  double FprPos = 0;               ///< in (0, 1] [-]
  std::optional<double> FprNeg{};  ///< in (0, 1], default FprPos [-]
  double A_pinch = 0;              ///< in [0, 1] [-]

  static constexpr std::array parameters = imk_reloading_parameters<ModImkPinching>(
      Parameter<ModImkPinching>{{"FprPos", "", "slope towards the pinching point over that to the peak", 0.4},
                                &ModImkPinching::FprPos},
      Parameter<ModImkPinching>{{"FprNeg", "", "FprPos in the negative direction (default FprPos)", 0.3, Need::extra},
                                &ModImkPinching::FprNeg},
      Parameter<ModImkPinching>{
          {"A_pinch", "", "ratio of the deformation of the pinching point to the residual one of the peak", 0.6},
          &ModImkPinching::A_pinch});
  static constexpr std::array state = imk_state<ModImkPinching>;
  static constexpr bool fails_if_steeper = true, fails_at_beta_1 = true;
  static constexpr bool is_symmetric = false;  ///< see keeps_stiffness()

  void check(Use use = Use::spring) const {
    Imk::check(use);
    for (const auto& [key, ratio] : {std::pair("FprPos", FprPos), {"FprNeg", FprNeg.value_or(FprPos)}})
      if (!(ratio > 0 && ratio <= 1)) laws::refuse(key, ratio, "in (0, 1]");
    if (!(A_pinch >= 0 && A_pinch <= 1)) laws::refuse("A_pinch", A_pinch, "in [0, 1]");
  }
  /// Reversals towards the negative direction reduce the stiffness only once the positive side has yielded.
  bool keeps_stiffness(const State& s, int way) const noexcept {
    return (way < 0) != is_mirrored && !(of(s, -way).peak > yield_deformation(-way));
  }
  double min_stiffness(const State& s) const noexcept {
    const auto& [a, b] = s.sides;
    return (backbone(a, a.peak) + backbone(b, b.peak)) / (a.peak + b.peak);
  }
  /// The pinching point, if it lies ahead of the zero force.
  Point corner_of(const State& s) const noexcept {
    const ImkSide& a = of(s, s.side);
    const double force = backbone(a, a.peak), x = A_pinch * (a.peak - force / s.k);
    const double ratio = (s.side < 0) != is_mirrored ? FprNeg.value_or(FprPos) : FprPos;
    return x > a.zero ? Point{x, ratio * force * (x - a.zero) / (a.peak - a.zero)} : Point{a.zero, 0};
  }
};

}  // namespace pounding::hysteresis
