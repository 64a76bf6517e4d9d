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

/// f = a k d + (1-a) k clamp(d - s, -Fy'/k, Fy/k): a spring a k in parallel with an elastic-perfectly plastic spring
/// with slip s.
///
/// k [N/m] initial stiffness, Fy [N] yield force, Fy' [N] magnitude of the yield force in the negative direction, a [-]
/// ratio of post-yield to initial stiffness, s [m] slip. Kinematic hardening: the elastic range is always Fy + Fy'. The
/// slip follows from return mapping of one-dimensional plasticity, which is exact on a path without reversal (Simo &
/// Hughes 1998, Computational Inelasticity, 1.4).
struct Bilinear {
  static constexpr std::string_view name = "bilinear", shape = "f = a k d + (1-a) k clamp(d - s, -Fy'/k, Fy/k)";
  static constexpr std::string_view summary = "bilinear with kinematic hardening (Steel01)";
  static constexpr std::string_view source = "Simo & Hughes 1998, Computational Inelasticity, section 1.4";
  static constexpr std::string_view symbols =
      "k [N/m] initial stiffness, Fy [N] yield force, Fy' [N] its magnitude in the negative direction, a [-] hardening "
      "ratio, s [m] slip";
  static constexpr std::string_view range = "0 <= a < 1";
  static constexpr std::string_view beware =
      "two corners per reversal with yielding. Strength and stiffness do not degrade, so loops are fuller than those "
      "of concrete";

  double initial_stiffness = 0;                  ///< k > 0 [N/m]
  double yield_force = 0;                        ///< Fy > 0 [N]
  double hardening = 0;                          ///< a in [0, 1) [-]
  std::optional<double> negative_yield_force{};  ///< Fy' > 0; default: Fy [N]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "initial stiffness k", 1e7}, &Bilinear::initial_stiffness},
      Parameter{yield_force_info, &Bilinear::yield_force},
      Parameter{hardening_info("ratio a of post-yield to initial stiffness"), &Bilinear::hardening},
      Parameter{{"negative_yield_force", "N", "magnitude Fy' of the yield force in the negative direction (default Fy)",
                 1e5, Need::extra},
                &Bilinear::negative_yield_force}};

  /// State [m].
  struct State {
    double deformation = 0, slip = 0;
  };
  static constexpr std::array state{StateValue<Bilinear>{{"slip", "m", "plastic part of the deformation s"},
                                                         [](const State& kept) { return kept.slip; }}};

  void check() const {
    laws::require_positive("stiffness", initial_stiffness);
    laws::require_positive("yield_force", yield_force);
    laws::require_positive("negative_yield_force", negative_yield_force);
    if (!(hardening >= 0 && hardening < 1)) laws::refuse("hardening", hardening, "in [0, 1)");
  }
  double stiffness() const noexcept { return initial_stiffness; }
  /// Minimum of both directions.
  double yield_deformation() const noexcept { return std::min(reach(1), reach(-1)); }
  double yield_deformation(double way) const noexcept { return reach(way); }

  Answer respond(const State& kept, double d) const noexcept {
    const double stretch = d - kept.slip, limit = reach(stretch);
    if (std::abs(stretch) <= limit)
      return {hardening * initial_stiffness * d + yielding() * stretch, initial_stiffness};
    return {hardening * initial_stiffness * d + yielding() * std::copysign(limit, stretch),
            hardening * initial_stiffness};
  }
  Answer excess(const State& kept, double d) const noexcept {
    const double stretch = d - kept.slip, limit = reach(stretch);
    if (std::abs(stretch) <= limit) return {-yielding() * kept.slip, 0};
    return {yielding() * (std::copysign(limit, stretch) - d), -yielding()};
  }
  State advance(const State& kept, double d) const noexcept { return {d, slip_at(kept, d)}; }
  double stored(const State& kept) const noexcept {
    const double stretch = kept.deformation - kept.slip;
    return 0.5 * initial_stiffness *
           (hardening * kept.deformation * kept.deformation + (1 - hardening) * stretch * stretch);
  }
  double stored_excess(const State& kept) const noexcept {
    return yielding() * kept.slip * (0.5 * kept.slip - kept.deformation);
  }
  /// Plastic work on the slip [J].
  double lost(const State& kept, double d) const noexcept {
    const double slip = slip_at(kept, d);
    return yielding() * reach(slip - kept.slip) * std::abs(slip - kept.slip);
  }
  double work(const State& kept, double d) const noexcept {
    // Differences of squares as products, to avoid cancellation on short paths.
    const double before = kept.deformation - kept.slip, after = d - slip_at(kept, d);
    return 0.5 * hardening * initial_stiffness * (d + kept.deformation) * (d - kept.deformation) +
           0.5 * yielding() * (after + before) * (after - before) + lost(kept, d);
  }
  /// Slightly smaller than the elastic range, as a margin for round-off.
  Range elastic(const State& kept) const noexcept {
    constexpr double inner = 1 - 1e-9;
    return {kept.slip - inner * reach(-1), kept.slip + inner * reach(1)};
  }
  std::optional<double> corner(const State& kept, double d) const noexcept {
    const double way = d - kept.deformation, yields_at = kept.slip + std::copysign(reach(way), way);
    return is_strictly_between(yields_at, kept.deformation, d) ? std::optional(yields_at) : std::nullopt;
  }

 private:
  /// Elastic deformation at yield in a direction [m].
  double reach(double way) const noexcept {
    return (way < 0 ? negative_yield_force.value_or(yield_force) : yield_force) / initial_stiffness;
  }
  /// (1-a) k, stiffness of the elastic-perfectly plastic spring [N/m].
  double yielding() const noexcept { return (1 - hardening) * initial_stiffness; }
  double slip_at(const State& kept, double d) const noexcept {
    return std::clamp(kept.slip, d - reach(1), d + reach(-1));
  }
};

}  // namespace pounding::hysteresis
