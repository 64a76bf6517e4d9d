#pragma once
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string_view>

#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding::hysteresis {

/// f = k (d - slack - p), never compression; with a strength at most Fy + a k p/(1-a).
///
/// k [N/m] stiffness of the taut cable, Fy [N] yield force, a [-] ratio of post-yield to elastic stiffness, p [m]
/// yielded elongation, which is permanent slack. d > 0 is elongation. Without a strength the cable stays elastic. The
/// yield force grows with p and keeps its value when the cable becomes slack (isotropic hardening): reloading is
/// elastic up to the largest force reached. Yield follows from return mapping (Simo & Hughes 1998, Computational
/// Inelasticity, 1.4). Cable restrainers of bridges: DesRoches & Fenves 2000, Earthquake Spectra 16:607.
struct Restrainer {
  static constexpr std::string_view name = "restrainer", shape = "f = min(k (d - s - p), Fy + a k p/(1-a)), f >= 0";
  static constexpr std::string_view summary = "cable or hook: tension only, beyond a slack, with yield at its strength";
  static constexpr std::string_view source =
      "Simo & Hughes 1998, Computational Inelasticity, section 1.4; DesRoches & Fenves 2000, Earthquake Spectra 16:607";
  static constexpr std::string_view symbols =
      "k [N/m] stiffness of the taut cable, s [m] slack, Fy [N] strength, a [-] hardening ratio, p [m] yielded "
      "elongation";
  static constexpr std::string_view range = "s >= 0, 0 <= a < 1; d > 0 is elongation";
  static constexpr std::string_view beware =
      "acts in tension only, without a dashpot. At the strength it yields and does not break; the yielded elongation "
      "remains as slack for the rest of the run";
  static constexpr bool is_symmetric = false;

  double taut_stiffness = 0;         ///< k > 0 [N/m]
  double slack = 0;                  ///< s >= 0 [m]
  std::optional<double> strength{};  ///< Fy > 0 [N]; default: elastic
  double hardening = 0;              ///< a in [0, 1) [-]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "stiffness k of the taut cable or hook", 2e7}, &Restrainer::taut_stiffness},
      Parameter{{"slack", "m", "elongation s before it becomes taut", 0}, &Restrainer::slack},
      Parameter{{"strength", "N", "tension Fy at which it yields (default: elastic)", 4e5, Need::optional},
                &Restrainer::strength},
      Parameter{{"hardening", "", "ratio a of post-yield to elastic stiffness", 0.03, Need::optional},
                &Restrainer::hardening}};

  /// State [m].
  struct State {
    double deformation = 0, yielded = 0;
  };
  static constexpr std::array state{
      StateValue<Restrainer>{{"yielded", "m", "yielded elongation p, which adds to the slack"},
                             [](const State& kept) { return kept.yielded; }}};

  void check() const {
    laws::require_positive("stiffness", taut_stiffness);
    laws::require_not_negative("slack", slack);
    laws::require_positive("strength", strength);
    if (!(hardening >= 0 && hardening < 1)) laws::refuse("hardening", hardening, "in [0, 1)");
    if (hardening > 0 && !strength)
      laws::refuse("hardening", hardening, "0 without a strength, because the restrainer stays elastic");
  }
  double stiffness() const noexcept { return taut_stiffness; }
  /// Elongation at first yield; infinite without a strength.
  double yield_deformation() const noexcept { return slack + reach(0); }
  double yield_deformation(double way) const noexcept {
    return way < 0 ? std::numeric_limits<double>::infinity() : yield_deformation();
  }
  /// Force at first yield [N]; infinite without a strength.
  double yield_force() const noexcept { return strength.value_or(std::numeric_limits<double>::infinity()); }

  Answer respond(const State& kept, double d) const noexcept {
    const double stretch = d - slack - kept.yielded;
    // At the end of tension, the slope is that before it.
    if (stretch < 0 || (stretch == 0 && d > kept.deformation)) return {};
    if (stretch > reach(kept.yielded))
      return {*strength + hardening * taut_stiffness * (d - yield_deformation()), hardening * taut_stiffness};
    return {taut_stiffness * stretch, taut_stiffness};
  }
  State advance(const State& kept, double d) const noexcept { return {d, yielded_at(kept, d)}; }
  double stored(const State& kept) const noexcept {
    const double stretch = stretch_of(kept);
    return 0.5 * taut_stiffness * stretch * stretch;
  }
  /// Plastic work [J].
  double lost(const State& kept, double d) const noexcept {
    const double after = yielded_at(kept, d), more = after - kept.yielded;
    return more > 0 ? more * (*strength + 0.5 * plastic() * (after + kept.yielded)) : 0;
  }
  double work(const State& kept, double d) const noexcept {
    // Differences of squares as products, to avoid cancellation on short paths.
    const double before = stretch_of(kept), after = stretch_of(advance(kept, d));
    return 0.5 * taut_stiffness * (after + before) * (after - before) + lost(kept, d);
  }
  std::optional<double> corner(const State& kept, double d) const noexcept {
    const double taut = slack + kept.yielded, yields = taut + reach(kept.yielded);
    const bool longer = d > kept.deformation;
    if (is_strictly_between(taut, kept.deformation, d)) return taut;
    if (longer && is_strictly_between(yields, kept.deformation, d)) return yields;
    return {};
  }

 private:
  /// Increase of the yield force per yielded elongation [N/m].
  double plastic() const noexcept { return hardening * taut_stiffness / (1 - hardening); }
  /// Elastic stretch at yield [m].
  double reach(double yielded) const noexcept {
    return strength ? (*strength + plastic() * yielded) / taut_stiffness : std::numeric_limits<double>::infinity();
  }
  double stretch_of(const State& kept) const noexcept {
    return std::clamp(kept.deformation - slack - kept.yielded, 0.0, reach(kept.yielded));
  }
  double yielded_at(const State& kept, double d) const noexcept {
    return strength ? std::max(kept.yielded, (1 - hardening) * (d - yield_deformation())) : 0;
  }
};

}  // namespace pounding::hysteresis
