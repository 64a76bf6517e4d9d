#pragma once
/// Common part of the deteriorating laws of Ibarra, Medina & Krawinkler.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <pounding/hysteresis/piecewise_linear.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding::hysteresis {

/// Backbone of one side, by magnitudes: hardening line `base + slope x`, softening line `top - soft x`. The first point
/// of reloading is the last reversal (turn, turn_force), the second one lies at the deformation `peak`.
struct ImkSide {
  double yield = 0, base = 0, slope = 0, top = 0, soft = 0;
  double peak = 0, turn = 0, turn_force = 0;
  bool is_lost = false;
};

/// Present piece: elastic before the first yield; unloading from a reversal and back; reloading in one to three lines;
/// on the backbone, below the line that hardens, hardening, softening and residual; without force on one side or both.
enum class ImkRule : int {
  elastic,
  unloading,
  to_pinch,
  to_turn,
  reloading,
  below,
  hardening,
  softening,
  residual,
  lost,
  failed
};

/// State of these laws. `end` is the deformation at which a piece of loading ends, in the direction of its side; k is
/// the unloading stiffness, `begun` the work at the last zero force, `pinch` and `pinch_force` the pinching point.
struct ImkState {
  double deformation = 0, work = 0;
  double start = 0, force = 0, slope = 0;
  ImkRule rule = ImkRule::elastic;
  int side = 0;
  bool is_on_backbone = false, was_residual = false;
  double end = 0, k = 0, begun = 0, pinch = 0, pinch_force = 0;
  std::array<ImkSide, 2> sides{};
};

/// Publications of these laws.
inline constexpr std::string_view imk_source =
    "Ibarra, Medina & Krawinkler 2005, Earthquake Eng. Struct. Dyn. 34:1489; Lignos & Krawinkler 2011, J. Struct. "
    "Eng. 137:1291";

/// Table of the parameters of law L, which may have more. Named as in OpenSees, where deformations of a hinge are
/// theta_p and theta_pc in the papers.
template <class L, class... More>
constexpr auto imk_parameters(const More&... more) {
  using P = Parameter<L>;
  const auto exponent = [](std::string_view name) {
    return ParameterInfo{name, "", "exponent of this deterioration", 1, Need::optional};
  };
  const auto capacity = [](std::string_view name, std::string_view meaning) {
    return ParameterInfo{name, "m", meaning, 1.5, Need::optional};
  };
  return std::array{
      P{{"stiffness", "N/m", "initial stiffness Ke", 1e7}, &L::initial_stiffness},
      P{yield_force_info, &L::yield_force},
      P{hardening_info("ratio b of post-yield to initial stiffness, instead of FmaxFy"), &L::hardening},
      P{{.name = "FmaxFy",
         .unit = "",
         .meaning = "ratio of maximum to yield force, at least 1, instead of hardening",
         .typical = 1.08,
         .need = Need::extra},
        &L::FmaxFy},
      P{{.name = "dp",
         .unit = "m",
         .meaning = "deformation from yield to the maximum force",
         .typical = 0.06,
         .at_hinge = "theta_p"},
        &L::dp},
      P{{.name = "dpc",
         .unit = "m",
         .meaning = "deformation from the maximum force to zero force",
         .typical = 0.12,
         .at_hinge = "theta_pc"},
        &L::dpc},
      P{{.name = "du",
         .unit = "m",
         .meaning = "ultimate deformation, at which the force is lost (default none)",
         .typical = 0.5,
         .need = Need::extra,
         .at_hinge = "theta_u"},
        &L::du},
      P{{"FresFy", "", "ratio of residual to yield force", 0.2, Need::optional}, &L::FresFy},
      P{capacity("Lambda_S", "energy capacity Lambda of strength, Et = Lambda Fy (default: no deterioration)"),
        &L::Lambda_S},
      P{capacity("Lambda_C", "energy capacity Lambda of the softening line (default: no deterioration)"), &L::Lambda_C},
      P{capacity("Lambda_K", "energy capacity Lambda of the unloading stiffness (default: no deterioration)"),
        &L::Lambda_K},
      P{exponent("c_S"), &L::c_S},
      P{exponent("c_C"), &L::c_C},
      P{exponent("c_K"), &L::c_K},
      P(more)...};
}

/// State variables of law L.
template <class L>
inline constexpr std::array imk_state{
    StateValue<L>{{"rule", "", "0 elastic, 1 unloading, 2 to 4 reloading, 5 to 8 backbone, 9 and 10 force lost"},
                  [](const ImkState& kept) { return static_cast<double>(kept.rule); }},
    StateValue<L>{{"strength", "N", "yield force in the positive direction; 0 before the first yield"},
                  [](const ImkState& kept) { return kept.sides[0].yield; }},
    StateValue<L>{{"negative_strength", "N", "its magnitude in the negative direction"},
                  [](const ImkState& kept) { return kept.sides[1].yield; }},
    StateValue<L>{{"unloading", "N/m", "unloading stiffness; 0 before the first yield"},
                  [](const ImkState& kept) { return kept.k; }}};

/// Base of such a law: backbone, rules of paths, and deterioration by beta = (E/(Et - SE))^c at exact points, with E
/// the work since the last zero force, SE the total work, Et = Lambda Fy. At zero force, beta reduces the backbone of
/// the side that is entered; at a reversal on the backbone, beta without the recoverable energy reduces the unloading
/// stiffness. The spring fails if beta reaches 1, and if a reversal would return energy faster than loading adds it.
///
/// Self provides `turns_everywhere` (true if a reversal below the backbone also reduces the stiffness) and, for a State
/// at the zero force or at the last reversal of its side,
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

  void check(Use use = Use::spring) const {
    const auto name = [use](std::size_t row) { return std::string(name_at(use, Self::parameters[row].info)); };
    const std::string yields = name(1), hardens = name(2), ultimate = name(6);
    laws::require_positive("stiffness", initial_stiffness);
    laws::require_positive(yields, yield_force);
    if (!(hardening >= 0 && hardening < 1)) laws::refuse(hardens, hardening, "in [0, 1)");
    if (FmaxFy && !(std::isfinite(*FmaxFy) && *FmaxFy >= 1)) laws::refuse("FmaxFy", *FmaxFy, "finite and at least 1");
    // A hinge at a loose joint sets a hardening of 1e-8.
    if (FmaxFy && hardening > 1e-6)
      throw std::invalid_argument("give FmaxFy or " + hardens + ", not both; FmaxFy = 1 + " + hardens + " stiffness " +
                                  name(4) + "/" + yields);
    laws::require_positive(name(4), dp);
    laws::require_positive(name(5), dpc);
    laws::require_positive(ultimate, du);
    if (du && !(*du > yield_deformation()))
      laws::refuse(ultimate, *du, "above the yield deformation, " + laws::number_text(yield_deformation()));
    if (!(FresFy >= 0 && FresFy < 1)) laws::refuse("FresFy", FresFy, "in [0, 1)");
    if (FmaxFy && *FmaxFy - 1 >= dp / yield_deformation())
      laws::refuse(
          "FmaxFy", *FmaxFy,
          "below " + laws::number_text(1 + dp / yield_deformation()) + ", so that the spring softens at yield");
    for (const auto& [row, value] : {std::pair(8, Lambda_S), {9, Lambda_C}, {10, Lambda_K}})
      require_capacity(name(row), value);
    for (const auto& [row, value] : {std::pair(11, c_S), {12, c_C}, {13, c_K}})
      laws::require_positive(name(row), value);
  }
  double stiffness() const noexcept { return initial_stiffness; }
  double yield_deformation() const noexcept { return yield_force / initial_stiffness; }

  /// True before the first yield.
  bool is_elastic(const State& s) const noexcept { return s.rule == ImkRule::elastic; }
  /// Deformation at the end of the present piece, at most the ultimate one.
  double end_of_piece(const State& s, int way) const noexcept {
    const double end = end_of_rule(s, way), ultimate = du.value_or(HUGE_VAL);
    if (s.rule == ImkRule::failed || of(s, way).is_lost || !(way * s.deformation <= ultimate)) return end;
    return way * std::min(way * end, ultimate);
  }
  /// Begins a path in the direction `way`: a reversal unloads, with a reduced stiffness on the backbone.
  void turn(State& s, int way) const noexcept {
    if (s.rule <= ImkRule::unloading || s.rule == ImkRule::failed || way == s.side) return;
    const double force = this->force_at(s, s.deformation);
    if (s.rule == ImkRule::lost) s.k = 0.5 * initial_stiffness;
    if (force == 0) return cross(s, way);
    ImkSide& a = of(s, s.side);
    a.turn = s.side * s.deformation;
    a.turn_force = s.side * force;
    a.peak = std::max(a.peak, a.turn);
    s.is_on_backbone = s.rule >= ImkRule::below;
    s.k = unloading_stiffness(s);
    if (s.k == 0) return fail(s);
    begin(s, ImkRule::unloading, a.turn, a.turn_force, s.k, 0);
  }
  /// Begins the piece beyond the present one.
  void arrive(State& s, int way) const noexcept {
    if (du && way * s.deformation >= *du && !of(s, way).is_lost) return lose(s, way);
    switch (s.rule) {
      case ImkRule::elastic: return yield(s, way);
      case ImkRule::unloading: return way == s.side ? self().resume(s) : cross(s, way);
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

 protected:
  /// Side of a direction.
  static ImkSide& of(State& s, int way) noexcept { return s.sides[way > 0 ? 0 : 1]; }
  static const ImkSide& of(const State& s, int way) noexcept { return s.sides[way > 0 ? 0 : 1]; }
  double residual_force() const noexcept { return FresFy * yield_force; }
  void require_capacity(const std::string& name, const std::optional<double>& value) const {
    if (value && !(std::isfinite(*value) && *value > 0))
      laws::refuse(name, *value, "finite and positive; without this deterioration, remove " + name);
  }
  /// Starts a piece at the deformation x and force f of its side.
  static void begin(State& s, ImkRule rule, double x, double f, double slope, double end) noexcept {
    s.rule = rule;
    s.start = s.side * x;
    s.force = s.side * f;
    s.slope = slope;
    s.end = end;
  }
  static void fail(State& s) noexcept {
    s.side = 0;
    begin(s, ImkRule::failed, 0, 0, 0, 0);
  }
  /// Maximum of the backbone before any deterioration [N].
  double maximum_force() const noexcept {
    return FmaxFy.value_or(1 + hardening * dp / yield_deformation()) * yield_force;
  }
  double backbone(const ImkSide& a, double x) const noexcept {
    return std::max(residual_force(), std::min(a.base + a.slope * x, a.top - a.soft * x));
  }
  static double cap(const ImkSide& a) noexcept {
    return a.slope + a.soft > 0 ? (a.top - a.base) / (a.slope + a.soft) : HUGE_VAL;
  }
  /// Continues on the backbone at x.
  void enter_backbone(State& s, double x) const noexcept {
    const ImkSide& a = of(s, s.side);
    const double maximum = cap(a), residual = residual_force();
    const bool is_flat = !std::isfinite(maximum) || a.base + a.slope * maximum <= residual;
    const double rise = a.slope > 0 ? (residual - a.base) / a.slope : -HUGE_VAL;
    if (is_flat) return stay_residual(s, x);
    if (x < rise) return begin(s, ImkRule::below, x, residual, 0, rise);
    if (x < maximum) return harden(s, x);
    if (a.top - a.soft * x > residual) return soften(s, x);
    stay_residual(s, x);
  }
  /// Loads along the line with slope s.k through (x, f) until it meets the backbone.
  void climb(State& s, double x, double f) const noexcept {
    const ImkSide& a = of(s, s.side);
    const double residual = residual_force();
    double end = a.slope + a.soft > 0 ? (a.top - f + s.k * x) / (s.k + a.soft) : x;
    if (a.slope + a.soft > 0 && s.k > a.slope) end = std::min(end, (a.base - f + s.k * x) / (s.k - a.slope));
    if (f + s.k * (end - x) < residual) end = x + (residual - f) / s.k;
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

  double end_of_rule(const State& s, int way) const noexcept {
    switch (s.rule) {
      case ImkRule::elastic: return way * yield_deformation();
      case ImkRule::unloading: return way == s.side ? s.start : s.start - s.force / s.slope;
      case ImkRule::failed: return way * HUGE_VAL;
      default: return s.side * s.end;
    }
  }
  void yield(State& s, int way) const noexcept {
    const double dy = yield_deformation(), maximum = maximum_force();
    ImkSide a{.yield = yield_force, .slope = (maximum - yield_force) / dp, .soft = maximum / dpc};
    a.base = a.yield - a.slope * dy;
    a.top = maximum + a.soft * (dy + dp);
    a.peak = a.turn = dy;
    a.turn_force = yield_force;
    s.sides[0] = s.sides[1] = a;
    s.k = initial_stiffness;
    s.side = way;
    harden(s, dy);
  }
  void harden(State& s, double x) const noexcept {
    const ImkSide& a = of(s, s.side);
    begin(s, ImkRule::hardening, x, a.base + a.slope * x, a.slope, cap(a));
  }
  void soften(State& s, double x) const noexcept {
    const ImkSide& a = of(s, s.side);
    const double end = a.soft > 0 ? (a.top - residual_force()) / a.soft : HUGE_VAL;
    begin(s, ImkRule::softening, x, a.top - a.soft * x, -a.soft, end);
  }
  void stay_residual(State& s, double x) const noexcept {
    if (FresFy == 0) return fail(s);
    s.was_residual = true;
    begin(s, ImkRule::residual, x, residual_force(), 0, HUGE_VAL);
  }
  /// Zero force: the side of the direction is entered.
  void cross(State& s, int way) const noexcept {
    const double beta_S = beta(s, Lambda_S, c_S), beta_C = beta(s, Lambda_C, c_C);
    s.side = way;
    if (beta_S >= 1 || beta_C >= 1) return fail(s);
    if (of(s, way).is_lost) {
      s.begun = s.work;
      return begin(s, ImkRule::lost, 0, 0, 0, HUGE_VAL);
    }
    self().deteriorate(s, beta_S, beta_C);
    s.begun = s.work;
    if (s.rule != ImkRule::failed) self().reload(s);
  }
  /// Ultimate deformation of a side: the other one keeps its residual force if the law allows it.
  void lose(State& s, int way) const noexcept {
    if (s.rule == ImkRule::elastic) yield(s, way);
    ImkSide& other = of(s, -way);
    if (!Self::keeps_other_side || other.is_lost || FresFy == 0) return fail(s);
    of(s, way).is_lost = true;
    other.yield = other.base = other.top = residual_force();
    other.slope = other.soft = 0;
    s.was_residual = true;
    s.side = way;
    begin(s, ImkRule::lost, 0, 0, 0, HUGE_VAL);
  }
};

}  // namespace pounding::hysteresis
