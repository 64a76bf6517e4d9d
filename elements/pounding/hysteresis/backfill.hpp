#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding::hysteresis {

/// f = x/(1/K + Rf x/Fu), x = d - gap, where the soil is pressed further than ever; back and in again by K_ur; never a pull.
///
/// K [N/m] initial stiffness of the soil behind a wall, K_ur >= K [N/m] its stiffness on unloading and reloading, Rf [-] failure ratio,
/// Fu [N] ultimate passive force, so that the hyperbola ends at Fu/Rf. d > 0 presses the wall into the soil. What was pressed in, the
/// deepest x less its force over K_ur, stays: it opens the gap. Duncan & Mokwa 2001, J. Geotech. Geoenviron. Eng. 127:248; OpenSees
/// HyperbolicGapMaterial, which has the signs turned round.
struct Backfill {
  static constexpr std::string_view name = "backfill", shape = "f = x/(1/K + Rf x/Fu), K_ur (x - r) below the deepest x, f >= 0";
  static constexpr std::string_view summary = "soil behind a wall: a hyperbola, steeper unloading, no tension (HyperbolicGapMaterial)";
  static constexpr std::string_view source = "Duncan & Mokwa 2001, J. Geotech. Geoenviron. Eng. 127:248";
  static constexpr std::string_view symbols =
      "x = d - gap [m], K [N/m] initial stiffness, K_ur [N/m] stiffness of unloading and reloading, Fu [N] ultimate passive force, Rf [-] "
      "failure ratio, r [m] what stays pressed in";
  static constexpr std::string_view range = "K_ur >= K, 0 < Rf <= 1, gap >= 0; d > 0 presses";
  static constexpr std::string_view beware =
      "it acts on one side only and has no dashpot; for small gaps the soil is met at once and what is pressed in stays a gap for the rest of "
      "the run";
  static constexpr bool is_symmetric = false;

  double initial_stiffness = 0;  ///< K > 0 [N/m]
  double unloading = 0;          ///< K_ur >= K [N/m]
  double failure_ratio = 0;      ///< Rf in (0, 1] [-]
  double strength = 0;           ///< Fu > 0 [N]
  double gap = 0;                ///< >= 0 [m]

  static constexpr std::array parameters{
      Parameter<Backfill>{{"stiffness", "N/m", "initial stiffness K", 2.5e8}, &Backfill::initial_stiffness},
      Parameter<Backfill>{{"unloading", "N/m", "stiffness of unloading and reloading K_ur", 5e8}, &Backfill::unloading},
      Parameter<Backfill>{{"failure_ratio", "", "ultimate force over the asymptote of the hyperbola Rf", 0.75}, &Backfill::failure_ratio},
      Parameter<Backfill>{{"strength", "N", "ultimate passive force Fu", 6e6}, &Backfill::strength},
      Parameter<Backfill>{{"gap", "m", "gap before the wall meets the soil", 0, Need::optional}, &Backfill::gap}};

  /// Its memory [m].
  struct State {
    double deformation = 0, deepest = 0;
  };
  static constexpr std::array state{
      StateValue<Backfill>{{"deepest", "m", "deepest x so far"}, [](const State& kept) { return kept.deepest; }}};

  void check() const {
    laws::require_positive("stiffness", initial_stiffness);
    if (!(std::isfinite(unloading) && unloading >= initial_stiffness))
      laws::refuse("unloading", unloading, "finite and at least stiffness, " + laws::number_text(initial_stiffness) + ": flatter unloading would create energy");
    if (!(failure_ratio > 0 && failure_ratio <= 1)) laws::refuse("failure_ratio", failure_ratio, "in (0, 1]");
    laws::require_positive("strength", strength);
    laws::require_not_negative("gap", gap);
  }
  double stiffness() const noexcept { return initial_stiffness; }
  /// At which the soil has half the stiffness of the start.
  double yield_deformation() const noexcept { return (std::sqrt(2.0) - 1) * strength / (failure_ratio * initial_stiffness); }
  /// Depth that stays pressed in: it opens the gap [m].
  double pressed_in(const State& kept) const noexcept { return kept.deepest - curve(kept.deepest) / unloading; }

  Answer respond(const State& kept, double d) const noexcept {
    const double x = d - gap;
    if (x > kept.deepest || (x == kept.deepest && d > kept.deformation)) return {curve(x), curve_slope(x)};
    const double spring = x - pressed_in(kept);
    // At the end of contact the slope is that before it.
    const bool is_pressed = spring > 0 || (spring == 0 && d < kept.deformation);
    return is_pressed ? Answer{unloading * spring, unloading} : Answer{};
  }
  State advance(const State& kept, double d) const noexcept { return {d, std::max(kept.deepest, d - gap)}; }
  double stored(const State& kept) const noexcept { return stored_at(kept, kept.deformation - gap); }
  double work(const State& kept, double d) const noexcept {
    return stored_at(advance(kept, d), d - gap) - stored(kept) + lost(kept, d);
  }
  /// Area below the hyperbola less that of the springs of unloading [J].
  double lost(const State& kept, double d) const noexcept {
    const double before = kept.deepest, after = std::max(before, d - gap);
    if (after == before) return 0;
    const double spring = 0.5 * (curve(after) - curve(before)) * (curve(after) + curve(before)) / unloading;
    return std::max(0.0, curve_area(before, after) - spring);
  }
  std::optional<double> corner(const State& kept, double d) const noexcept {
    const double touch = gap + pressed_in(kept), deepest = gap + kept.deepest;
    const bool deeper = d > kept.deformation;
    for (const double x : {deeper ? touch : deepest, deeper ? deepest : touch})
      if (is_strictly_between(x, kept.deformation, d) && slope_jumps(x, kept, deeper)) return x;
    return {};
  }

 private:
  double curve(double x) const noexcept { return x > 0 ? x / (1 / initial_stiffness + failure_ratio * x / strength) : 0; }
  double curve_slope(double x) const noexcept {
    const double part = 1 + initial_stiffness * failure_ratio / strength * x;
    return initial_stiffness / (part * part);
  }
  /// The integral of the hyperbola. In c = K Rf/Fu: K [x/c - log(1 + c x)/c^2], as its series where that would lose digits.
  double curve_area(double from, double to) const noexcept {
    const double c = initial_stiffness * failure_ratio / strength, part = c * (to - from) / (1 + c * from);
    const double way = to - from;
    if (part > 1e-3) return initial_stiffness / c * (way - std::log1p(part) / c);
    // way - log1p(part)/c = way (c from)/(1 + c from) + (part^2/2 - part^3/3 + ...)/c.
    const double rest = part * part * (0.5 - part * (1.0 / 3 - part * (0.25 - part * (0.2 - part / 6))));
    return initial_stiffness / c * (way * c * from / (1 + c * from) + rest / c);
  }
  double stored_at(const State& kept, double x) const noexcept {
    const double spring = std::max(0.0, x - pressed_in(kept));
    return 0.5 * unloading * spring * spring;
  }
  // A soil that was never pressed has one corner where both are.
  bool slope_jumps(double x, const State& kept, bool) const noexcept { return kept.deepest > 0 || x == gap; }
};

}  // namespace pounding::hysteresis
