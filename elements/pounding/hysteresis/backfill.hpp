#pragma once
#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/laws/hyperbola.hpp>

namespace pounding::hysteresis {

/// f = x/(1/K + Rf x/Fu), x = d - gap, in first loading; unloading and reloading with K_ur; no tension.
///
/// K [N/m] initial stiffness of the soil behind a wall, K_ur >= K [N/m] unloading and reloading stiffness, Rf [-]
/// failure ratio, Fu [N] ultimate passive force; the hyperbola tends to Fu/Rf. d > 0 presses the wall into the soil.
/// The residual depth, which is the maximum x minus its force over K_ur, opens the gap permanently. Duncan & Mokwa
/// 2001, J. Geotech. Geoenviron. Eng. 127:248; OpenSees HyperbolicGapMaterial, with opposite signs.
struct Backfill {
  static constexpr std::string_view name = "backfill",
                                    shape = "f = x/(1/K + Rf x/Fu), K_ur (x - r) below the maximum x, f >= 0";
  static constexpr std::string_view summary =
      "soil behind a wall: hyperbolic loading, steeper unloading, no tension (HyperbolicGapMaterial)";
  static constexpr std::string_view source = "Duncan & Mokwa 2001, J. Geotech. Geoenviron. Eng. 127:248";
  static constexpr std::string_view symbols =
      "x = d - gap [m], K [N/m] initial stiffness, K_ur [N/m] unloading and reloading stiffness, Fu [N] ultimate "
      "passive force, Rf [-] failure ratio, r [m] residual depth";
  static constexpr std::string_view range = "K_ur >= K, 0 < Rf <= 1, gap >= 0; d > 0 is compression";
  static constexpr std::string_view beware =
      "acts on one side only, without a dashpot. With a small gap the wall touches the soil immediately, and the "
      "residual depth remains a gap for the rest of the run";
  static constexpr bool is_symmetric = false;

  double initial_stiffness = 0;  ///< K > 0 [N/m]
  double unloading = 0;          ///< K_ur >= K [N/m]
  double failure_ratio = 0;      ///< Rf in (0, 1] [-]
  double strength = 0;           ///< Fu > 0 [N]
  double gap = 0;                ///< >= 0 [m]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "initial stiffness K", 2.5e8}, &Backfill::initial_stiffness},
      Parameter{{"unloading", "N/m", "unloading and reloading stiffness K_ur", 5e8}, &Backfill::unloading},
      Parameter{{"failure_ratio", "", "ratio Rf of the ultimate force to the asymptote of the hyperbola", 0.75},
                &Backfill::failure_ratio},
      Parameter{{"strength", "N", "ultimate passive force Fu", 6e6}, &Backfill::strength},
      Parameter{{"gap", "m", "initial gap between wall and soil", 0, Need::optional}, &Backfill::gap}};

  /// State [m].
  struct State {
    double deformation = 0, deepest = 0;
  };
  static constexpr std::array state{
      StateValue<Backfill>{{"deepest", "m", "maximum x reached"}, [](const State& kept) { return kept.deepest; }}};

  void check() const {
    soil().check();
    laws::require_not_negative("gap", gap);
  }
  /// Loading and unloading curves.
  laws::Hyperbola soil() const noexcept { return {initial_stiffness, unloading, failure_ratio, strength}; }
  double stiffness() const noexcept { return initial_stiffness; }
  /// Deformation at which the stiffness of the soil has fallen to half its initial value.
  double yield_deformation() const noexcept { return soil().half_stiffness(); }
  /// Residual depth, which opens the gap [m].
  double pressed_in(const State& kept) const noexcept { return soil().left(kept.deepest); }

  Answer respond(const State& kept, double d) const noexcept {
    const double x = d - gap;
    if (x > kept.deepest || (x == kept.deepest && d > kept.deformation)) return {soil().force(x), soil().slope(x)};
    const double spring = x - pressed_in(kept);
    // At the end of contact, the slope is that before it.
    const bool is_pressed = spring > 0 || (spring == 0 && d < kept.deformation);
    return is_pressed ? Answer{unloading * spring, unloading} : Answer{};
  }
  State advance(const State& kept, double d) const noexcept { return {d, std::max(kept.deepest, d - gap)}; }
  double stored(const State& kept) const noexcept { return stored_at(kept, kept.deformation - gap); }
  double work(const State& kept, double d) const noexcept {
    return stored_at(advance(kept, d), d - gap) - stored(kept) + lost(kept, d);
  }
  /// Area under the hyperbola minus the energy of the unloading springs [J].
  double lost(const State& kept, double d) const noexcept {
    const double before = kept.deepest, after = std::max(before, d - gap);
    if (after == before) return 0;
    const double f0 = soil().force(before), f1 = soil().force(after);
    return std::max(0.0, soil().area(before, after) - 0.5 * (f1 - f0) * (f1 + f0) / unloading);
  }
  std::optional<double> corner(const State& kept, double d) const noexcept {
    const double touch = gap + pressed_in(kept), deepest = gap + kept.deepest;
    const bool deeper = d > kept.deformation;
    // Undisturbed soil has a single corner: both coincide.
    for (const double x : {deeper ? touch : deepest, deeper ? deepest : touch})
      if (is_strictly_between(x, kept.deformation, d) && (kept.deepest > 0 || x == gap)) return x;
    return {};
  }

 private:
  double stored_at(const State& kept, double x) const noexcept { return soil().stored(kept.deepest, x); }
};

}  // namespace pounding::hysteresis
