#pragma once
/// Common part of the deteriorating laws of Ibarra, Medina & Krawinkler.

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <pounding/hysteresis/imk_table.hpp>
#include <pounding/hysteresis/piecewise_linear.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding::hysteresis {

/// Base of such a law: backbone, rules of paths, and deterioration by beta = (E/(Et - SE))^c at exact points, with E
/// the work since the last zero force, SE the total work, Et = Lambda Fy. At zero force, beta reduces the backbone of
/// the side that is entered; at a reversal on the backbone, beta without the recoverable energy reduces the unloading
/// stiffness. The spring fails if beta reaches 1, and if a reversal would return energy faster than loading adds it.
///
/// Self provides `turns_everywhere` (true if a reversal below the backbone also reduces the stiffness),
/// `halves_after_residual`, `keeps_other_side`, `hardens_below_residual` and, for a State at the zero force or at the
/// last reversal of its side,
///
///     void deteriorate(State&, double beta_S, double beta_C) const noexcept;  // of the side; may fail
///     void reload(State&) const noexcept;  // from zero force
///     void resume(State&) const noexcept;  // behind the last reversal, in the direction of the side
///     void go_on(State&) const noexcept;   // at the end of `to_pinch` and `to_turn`
template <class Self>
struct Imk : PiecewiseLinear<Self, ImkState> {
  using State = ImkState;  ///< accepted state

  double initial_stiffness = 0;      ///< Ke > 0 [N/m]
  double yield_force = 0;            ///< Fy > 0 [N]
  double hardening = 0;              ///< b in [0, 1) [-]
  std::optional<double> FmaxFy{};    ///< >= 1, instead of b [-]
  double dp = 0;                     ///< > 0, from yield to the maximum force [m]
  double dpc = 0;                    ///< > 0, from there to zero force [m]
  std::optional<double> du{};        ///< ultimate deformation [m]
  double FresFy = 0;                 ///< in [0, 1) [-]
  std::optional<double> Lambda_S{};  ///< energy capacity of strength over Fy [m]
  std::optional<double> Lambda_C{};  ///< of the softening line [m]
  std::optional<double> Lambda_K{};  ///< of the unloading stiffness [m]
  double c_S = 1, c_C = 1, c_K = 1;  ///< exponents > 0 [-]
  /// In the negative direction; by default as in the positive one.
  std::optional<double> negative_yield_force{}, hardening_neg{}, FmaxFy_neg{}, dp_neg{}, dpc_neg{}, du_neg{},
      FresFy_neg{};
  double D_pos = 1, D_neg = 1;  ///< factors on beta of each direction, in [0, 1] [-]
  bool is_mirrored = false;     ///< exchanges both directions

  void check(Use use = Use::spring) const {
    const auto name = [use](std::string_view key) {
      const auto* p = Self::parameters.data();
      while (p->info.name != key) ++p;
      return std::string(name_at(use, p->info));
    };
    for (const auto& p : Self::parameters)
      if (const auto value = p.get(self())) require(p.info, name(p.info.name), *value);
    // A hinge at a loose joint sets a hardening of 1e-8.
    if (FmaxFy && hardening > 1e-6)
      throw std::invalid_argument("give FmaxFy or " + name("hardening") + ", not both; FmaxFy = 1 + " +
                                  name("hardening") + " stiffness " + name("dp") + "/" + name("yield_force"));
    if (FmaxFy_neg && hardening_neg)
      throw std::invalid_argument("give FmaxFy_neg or " + name("hardening_neg") + ", not both");
    for (const int way : {1, -1}) {
      const Direction d = direction(way);
      const double dy = d.yield / initial_stiffness, ratio = d.maximum / d.yield, most = 1 + d.dp / dy;
      if (!(d.du > dy))
        laws::refuse(name(way < 0 && du_neg ? "du_neg" : "du"), d.du,
                     "above the yield deformation, " + laws::number_text(dy));
      if (ratio >= most)
        laws::refuse(way < 0 && FmaxFy_neg ? "FmaxFy_neg" : "FmaxFy", ratio,
                     "below " + laws::number_text(most) + ", so that the spring softens at yield");
    }
  }
  double stiffness() const noexcept { return initial_stiffness; }
  /// Minimum of both directions.
  double yield_deformation() const noexcept { return std::min(yield_deformation(1), yield_deformation(-1)); }
  double yield_deformation(double way) const noexcept { return direction(way).yield / initial_stiffness; }
  /// True before the first yield.
  bool is_elastic(const State& s) const noexcept { return s.rule == ImkRule::elastic; }
  /// Deformation at the end of the present piece, at most the ultimate one.
  double end_of_piece(const State& s, int way) const noexcept {
    const double end = end_of_rule(s, way), ultimate = direction(way).du;
    if (s.rule == ImkRule::failed || of(s, way).is_lost || !(way * s.deformation <= ultimate)) return end;
    return way * std::min(way * end, ultimate);
  }
  /// Begins a path in the direction `way`: a reversal unloads, with a reduced stiffness on the backbone.
  void turn(State& s, int way) const noexcept {
    if (s.rule <= ImkRule::unloading || s.rule == ImkRule::failed || way == s.side) return;
    const double force = this->force_at(s, s.deformation);
    if (s.rule == ImkRule::lost) s.k = 0.5 * initial_stiffness;
    s.is_on_backbone = s.rule >= ImkRule::below;
    s.k = self().unloading_stiffness(s);
    if (s.k == 0) return fail(s);
    if (force == 0) return self().cross(s, way);
    ImkSide& a = of(s, s.side);
    a.turn = s.side * s.deformation;
    a.turn_force = s.side * force;
    a.peak = std::max(a.peak, a.turn);
    begin(s, ImkRule::unloading, a.turn, a.turn_force, s.k, 0);
  }
  /// Begins the piece beyond the present one.
  void arrive(State& s, int way) const noexcept {
    if (way * s.deformation >= direction(way).du && !of(s, way).is_lost) return lose(s, way);
    switch (s.rule) {
      case ImkRule::elastic: return yield(s, way);
      case ImkRule::unloading: return way == s.side ? self().resume(s) : self().cross(s, way);
      case ImkRule::to_pinch:
      case ImkRule::to_turn: return self().go_on(s);
      case ImkRule::reloading: return enter_backbone(s, s.end);
      case ImkRule::below: return harden(s, s.end);
      case ImkRule::hardening: return soften(s, s.end);
      case ImkRule::softening: return stay_residual(s, s.end);
      default: return;
    }
  }
  /// Stiffness after a reversal here, 0 if the spring fails there.
  double unloading_stiffness(const State& s) const noexcept {
    if (s.rule == ImkRule::unloading || (s.rule < ImkRule::below && !Self::turns_everywhere)) return s.k;
    if (Self::halves_after_residual && s.was_residual) return 0.5 * initial_stiffness;
    if (!Lambda_K) return s.k;
    const double force = this->force_at(s, s.deformation), returned = 0.5 * force * force / s.k;
    const double rest = *Lambda_K * yield_force - s.work + returned, added = s.work - s.begun - returned;
    if (!(rest > 0)) return 0;
    const double beta = std::pow(std::max(added, 0.0) / rest, c_K);
    const bool returns_more = returned * (1 + beta) > (1 - beta) * (1 - beta) * rest;
    return beta >= 1 || returns_more ? 0 : s.k * (1 - beta);
  }

  /// Parameters of one direction.
  struct Direction {
    double yield, dp, dpc, du, residual, D, maximum;
  };
  /// Force of the residual branch of the present side.
  double plateau(const State& s) const noexcept { return of(s, s.side).residual; }
  /// True if a softening line that reaches zero force at x ends the law.
  bool fails_without_residual(const ImkSide&, double /*x*/) const noexcept { return true; }
  /// Slope of the softening line before any deterioration [N/m].
  double softening(const Direction& d) const noexcept { return d.maximum / d.dpc; }
  /// Zero force: the side of the direction is entered.
  void cross(State& s, int way) const noexcept {
    const double beta_S = beta(s, Lambda_S, c_S), beta_C = beta(s, Lambda_C, c_C);
    s.side = way;
    if (beta_S >= 1 || beta_C >= 1) return fail(s);
    if (of(s, way).is_lost) {
      s.begun = s.work;
      return begin(s, ImkRule::lost, 0, 0, 0, HUGE_VAL);
    }
    const double D = direction(way).D;
    self().deteriorate(s, D * beta_S, D * beta_C);
    s.begun = s.work;
    if (s.rule != ImkRule::failed) self().reload(s);
  }

 protected:
  Direction direction(double way) const noexcept {
    if ((way < 0) == is_mirrored) {
      const double maximum = FmaxFy ? *FmaxFy * yield_force : yield_force + hardening * initial_stiffness * dp;
      return {yield_force, dp, dpc, du.value_or(HUGE_VAL), FresFy * yield_force, D_pos, maximum};
    }
    const double fy = negative_yield_force.value_or(yield_force), plastic = dp_neg.value_or(dp);
    const auto ratio = hardening_neg ? std::nullopt : FmaxFy_neg ? FmaxFy_neg : FmaxFy;
    const double maximum = ratio ? *ratio * fy : fy + hardening_neg.value_or(hardening) * initial_stiffness * plastic;
    return {
        fy,    plastic, dpc_neg.value_or(dpc), du_neg.value_or(du.value_or(HUGE_VAL)), FresFy_neg.value_or(FresFy) * fy,
        D_neg, maximum};
  }
  /// Side of a direction.
  static ImkSide& of(State& s, int way) noexcept { return s.sides[way > 0 ? 0 : 1]; }
  static const ImkSide& of(const State& s, int way) noexcept { return s.sides[way > 0 ? 0 : 1]; }
  /// Starts a piece at the deformation x and force f of its side.
  static void begin(State& s, ImkRule rule, double x, double f, double slope, double end) noexcept {
    s.rule = rule;
    s.start = s.side * x;
    s.force = s.side * f;
    s.slope = slope;
    s.end = end;
    s.is_due = s.is_due || rule == ImkRule::hardening || rule == ImkRule::softening;
  }
  static void fail(State& s) noexcept {
    s.side = 0;
    begin(s, ImkRule::failed, 0, 0, 0, 0);
  }
  double backbone(const ImkSide& a, double x) const noexcept {
    if (Self::hardens_below_residual && x < cap(a)) return a.base + a.slope * x;
    return std::max(a.residual, std::min(a.base + a.slope * x, a.top - a.soft * x));
  }
  static double cap(const ImkSide& a) noexcept {
    return a.slope + a.soft > 0 ? (a.top - a.base) / (a.slope + a.soft) : HUGE_VAL;
  }
  /// Continues on the backbone at x.
  void enter_backbone(State& s, double x) const noexcept {
    const ImkSide& a = of(s, s.side);
    const double maximum = cap(a);
    const bool is_flat = !std::isfinite(maximum) || a.base + a.slope * maximum <= a.residual;
    const double rise = a.slope > 0 ? (a.residual - a.base) / a.slope : -HUGE_VAL;
    if (!Self::hardens_below_residual && is_flat) return stay_residual(s, x);
    if (!Self::hardens_below_residual && x < rise) return begin(s, ImkRule::below, x, a.residual, 0, rise);
    if (x < maximum) return harden(s, x);
    if (a.top - a.soft * x > a.residual) return soften(s, x);
    stay_residual(s, x);
  }
  /// Loads along the line with slope s.k through (x, f) until it meets the backbone.
  void climb(State& s, double x, double f) const noexcept {
    const ImkSide& a = of(s, s.side);
    double end = a.slope + a.soft > 0 ? (a.top - f + s.k * x) / (s.k + a.soft) : x;
    if (a.slope + a.soft > 0 && s.k > a.slope) end = std::min(end, (a.base - f + s.k * x) / (s.k - a.slope));
    if (f + s.k * (end - x) < a.residual && !(Self::hardens_below_residual && end < cap(a)))
      end = x + (a.residual - f) / s.k;
    begin(s, ImkRule::reloading, x, f, s.k, end);
  }
  /// beta of the work since the last zero force, 1 if the capacity is exhausted.
  double beta(const State& s, const std::optional<double>& capacity, double exponent) const noexcept {
    if (!capacity) return 0;
    const double rest = *capacity * yield_force - s.work;
    const double added = std::max(s.work - s.begun, 0.0);
    return added < rest ? std::pow(added / rest, exponent) : 1;
  }

 private:
  const Self& self() const noexcept { return static_cast<const Self&>(*this); }

  static void require(const ParameterInfo& info, const std::string& name, double value) {
    const std::string_view key = info.name;
    if (key.starts_with("Lambda") && !(std::isfinite(value) && value > 0))
      laws::refuse(name, value, "finite and positive; without this deterioration, remove " + name);
    if ((key.starts_with("hardening") || key.starts_with("FresFy")) && !(value >= 0 && value < 1))
      laws::refuse(name, value, "in [0, 1)");
    if (key.starts_with("FmaxFy") && !(std::isfinite(value) && value >= 1))
      laws::refuse(name, value, "finite and at least 1");
    if (key.starts_with("D_") && !(value >= 0 && value <= 1)) laws::refuse(name, value, "in [0, 1]");
    if (!info.unit.empty() || key.starts_with("c_")) laws::require_positive(name, value);
  }

  double end_of_rule(const State& s, int way) const noexcept {
    switch (s.rule) {
      case ImkRule::elastic: return way * yield_deformation(way);
      case ImkRule::unloading: return way == s.side ? s.start : s.start - s.force / s.slope;
      case ImkRule::failed: return way * HUGE_VAL;
      default: return s.side * s.end;
    }
  }
  void yield(State& s, int way) const noexcept {
    for (const int side : {1, -1}) {
      const Direction d = direction(side);
      const double dy = d.yield / initial_stiffness;
      ImkSide& a = of(s, side);
      a = {
          .yield = d.yield, .slope = (d.maximum - d.yield) / d.dp, .soft = self().softening(d), .residual = d.residual};
      a.base = a.yield - a.slope * dy;
      a.top = d.maximum + a.soft * (dy + d.dp);
      a.peak = a.turn = dy;
      a.turn_force = d.yield;
    }
    s.k = initial_stiffness;
    s.side = way;
    harden(s, of(s, way).peak);
  }
  void harden(State& s, double x) const noexcept {
    const ImkSide& a = of(s, s.side);
    begin(s, ImkRule::hardening, x, a.base + a.slope * x, a.slope, cap(a));
  }
  void soften(State& s, double x) const noexcept {
    const ImkSide& a = of(s, s.side);
    const double end = a.soft > 0 ? (a.top - a.residual) / a.soft : HUGE_VAL;
    begin(s, ImkRule::softening, x, a.top - a.soft * x, -a.soft, end);
  }
  void stay_residual(State& s, double x) const noexcept {
    const ImkSide& a = of(s, s.side);
    if (a.residual == 0 && self().fails_without_residual(a, x)) return fail(s);
    s.was_residual = true;
    begin(s, ImkRule::residual, x, self().plateau(s), 0, HUGE_VAL);
  }
  /// Ultimate deformation of a side: the other one keeps its residual force if the law allows it.
  void lose(State& s, int way) const noexcept {
    if (s.rule == ImkRule::elastic) yield(s, way);
    ImkSide& other = of(s, -way);
    if (!Self::keeps_other_side || other.is_lost || other.residual == 0) return fail(s);
    of(s, way).is_lost = true;
    other.yield = other.base = other.top = other.residual;
    other.slope = other.soft = 0;
    s.was_residual = true;
    s.side = way;
    begin(s, ImkRule::lost, 0, 0, 0, HUGE_VAL);
  }
};

}  // namespace pounding::hysteresis
