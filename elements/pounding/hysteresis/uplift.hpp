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

/// f = min(k d, N): a support in compression only, relative to its state under a constant load.
///
/// k [N/m] stiffness, N [N] compression at rest, d [m] upward displacement from rest. The total force on the supported
/// body is N - f >= 0; it lifts off at d = N/k. Nonlinear elastic: the energy above N/k is that of the lifted load.
struct Uplift {
  static constexpr std::string_view name = "uplift", shape = "f = min(k d, N)";
  static constexpr std::string_view summary =
      "support in compression only: lifts off when the compression at rest is exhausted";
  static constexpr std::string_view source = "equilibrium: the support transmits N - f >= 0";
  static constexpr std::string_view symbols = "k [N/m] stiffness, N [N] compression at rest; d > 0 is upward";
  static constexpr std::string_view range = "N > 0";
  static constexpr std::string_view beware =
      "without a dashpot, so a lifted body bounces on landing; Rayleigh damping of the structure still acts on the "
      "stiffness of the lifted support";
  static constexpr bool is_symmetric = false;

  double initial_stiffness = 0;  ///< k > 0 [N/m]
  double preload = 0;            ///< N > 0 [N]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "stiffness k", 2e8}, &Uplift::initial_stiffness},
      Parameter{{"preload", "N", "compression N at rest", 8e5}, &Uplift::preload}};

  /// State [m].
  struct State {
    double deformation = 0;
  };
  static constexpr std::array<StateValue<Uplift>, 0> state{};

  void check() const {
    laws::require_positive("stiffness", initial_stiffness);
    laws::require_positive("preload", preload);
  }
  double stiffness() const noexcept { return initial_stiffness; }
  /// Upward displacement at lift-off.
  double yield_deformation() const noexcept { return preload / initial_stiffness; }
  double yield_deformation(double way) const noexcept {
    return way < 0 ? std::numeric_limits<double>::infinity() : yield_deformation();
  }

  Answer respond(const State& kept, double d) const noexcept {
    const double lifts = yield_deformation();
    // At lift-off and at landing, the slope is that before it.
    if (d > lifts || (d == lifts && d < kept.deformation)) return {preload, 0};
    return {initial_stiffness * d, initial_stiffness};
  }
  State advance(const State&, double d) const noexcept { return {d}; }
  double stored(const State& kept) const noexcept {
    const double pressed = std::min(kept.deformation, yield_deformation());
    return 0.5 * initial_stiffness * pressed * pressed + preload * (kept.deformation - pressed);
  }
  double lost(const State&, double) const noexcept { return 0; }
  double work(const State& kept, double d) const noexcept {
    const double lifts = yield_deformation(), before = std::min(kept.deformation, lifts), after = std::min(d, lifts);
    return 0.5 * initial_stiffness * (after + before) * (after - before) +
           preload * (std::max(d, lifts) - std::max(kept.deformation, lifts));
  }
  std::optional<double> corner(const State& kept, double d) const noexcept {
    const double lifts = yield_deformation();
    return is_strictly_between(lifts, kept.deformation, d) ? std::optional(lifts) : std::nullopt;
  }
};

}  // namespace pounding::hysteresis
