#pragma once
#include <algorithm>
#include <cmath>

#include <pounding/laws/checks.hpp>

namespace pounding::laws {

/// Soil behind a wall that is pressed in by x [m].
///
/// First loading: F = x/(1/K + Rf x/Fu), a hyperbola that tends to Fu/Rf. Unloading and reloading: K_ur (x - r), with
/// the residual depth r of the maximum x. Duncan & Mokwa 2001, J. Geotech. Geoenviron. Eng. 127:248. Stateless: shared
/// by the contact law and the hysteretic law.
struct Hyperbola {
  double stiffness = 0;      ///< K > 0 [N/m]
  double unloading = 0;      ///< K_ur >= K [N/m]
  double failure_ratio = 0;  ///< Rf in (0, 1] [-]
  double strength = 0;       ///< Fu > 0 [N]

  /// Throws std::invalid_argument for a value out of range, as the laws do.
  void check() const {
    require_positive("stiffness", stiffness);
    if (!(std::isfinite(unloading) && unloading >= stiffness))
      refuse("unloading", unloading,
             "finite and at least stiffness, " + number_text(stiffness) + ": a lower value would generate energy");
    if (!(failure_ratio > 0 && failure_ratio <= 1)) refuse("failure_ratio", failure_ratio, "in (0, 1]");
    require_positive("strength", strength);
  }
  /// Force of first loading [N]; zero for x <= 0.
  double force(double x) const noexcept { return x > 0 ? x / (1 / stiffness + failure_ratio * x / strength) : 0; }
  /// Slope of first loading [N/m], extended to x <= 0.
  double slope(double x) const noexcept {
    const double part = 1 + stiffness * failure_ratio / strength * x;
    return stiffness / (part * part);
  }
  /// Residual depth after a maximum of x [m].
  double left(double deepest) const noexcept { return deepest - force(deepest) / unloading; }
  /// Depth at which the stiffness has fallen to half its initial value [m].
  double half_stiffness() const noexcept { return (std::sqrt(2.0) - 1) * strength / (failure_ratio * stiffness); }
  /// Work of first loading between two depths [J]. With c = K Rf/Fu: K [x/c - log(1 + c x)/c^2], or its series if that
  /// would lose digits to cancellation.
  double area(double from, double to) const noexcept {
    const double c = stiffness * failure_ratio / strength, way = to - from, part = c * way / (1 + c * from);
    if (part > 1e-3) return stiffness / c * (way - std::log1p(part) / c);
    // way - log1p(part)/c = way (c from)/(1 + c from) + (part^2/2 - part^3/3 + ...)/c.
    const double rest = part * part * (0.5 - part * (1.0 / 3 - part * (0.25 - part * (0.2 - part / 6))));
    return stiffness / c * (way * c * from / (1 + c * from) + rest / c);
  }
  /// Energy recovered by unloading from x <= deepest [J].
  double stored(double deepest, double x) const noexcept {
    const double spring = std::max(0.0, x - left(deepest));
    return 0.5 * unloading * spring * spring;
  }
};

}  // namespace pounding::laws
