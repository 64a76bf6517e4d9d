#pragma once
#include <algorithm>
#include <array>
#include <string_view>

#include <pounding/laws/hyperbola.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F = d/(1/K + Rf d/Fu) in first loading, K_ur (d - r) in unloading and reloading; the residual depth opens the gap.
///
/// K [N/m] initial stiffness of the soil behind a wall, K_ur >= K [N/m] unloading and reloading stiffness, Rf [-]
/// failure ratio, Fu [N] ultimate passive force; the hyperbola tends to Fu/Rf. d [m] is measured from the undisturbed
/// soil, d_m is the running maximum of d, and r = d_m - F(d_m)/K_ur is the residual depth. Duncan & Mokwa 2001, J.
/// Geotech. Geoenviron. Eng. 127:248; OpenSees HyperbolicGapMaterial, with opposite signs. Wall and soil are massless
/// and without a dashpot.
struct Backfill {
  static constexpr std::string_view
      name = "backfill",
      shape = "F = d/(1/K + Rf d/Fu) for d = d_m, K_ur (d - r) for d < d_m; r = d_m - F(d_m)/K_ur";
  static constexpr std::string_view summary =
      "wall with backfill: hyperbolic loading, steeper unloading, residual depth (HyperbolicGapMaterial)";
  static constexpr std::string_view source =
      "Duncan & Mokwa 2001, J. Geotech. Geoenviron. Eng. 127:248; OpenSees HyperbolicGapMaterial";
  static constexpr std::string_view symbols =
      "K [N/m] initial stiffness of the soil, K_ur [N/m] unloading and reloading stiffness, Fu [N] ultimate passive "
      "force, Rf [-] failure ratio, d measured from the undisturbed soil, d_m [m] its running maximum, r [m] residual "
      "depth";
  static constexpr std::string_view range = "K_ur >= K, 0 < Rf <= 1";
  static constexpr std::string_view beware =
      "values are for the whole width of the wall. The residual depth is added to the gap for the rest of the run, and "
      "later impacts dissipate energy only if they reach deeper. The wall is massless, and the force does not depend "
      "on the speed";
  static constexpr bool leaves_indentation = true, presses_soil = true;

  double stiffness = 0;      ///< K > 0 [N/m]
  double unloading = 0;      ///< K_ur >= K [N/m]
  double failure_ratio = 0;  ///< Rf in (0, 1] [-]
  double strength = 0;       ///< Fu > 0 [N]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "initial stiffness of the soil K", 2.5e8}, &Backfill::stiffness},
      Parameter{{"unloading", "N/m", "unloading and reloading stiffness K_ur", 5e8}, &Backfill::unloading},
      Parameter{{"failure_ratio", "", "ratio Rf of the ultimate force to the asymptote of the hyperbola", 0.75},
                &Backfill::failure_ratio},
      Parameter{{"strength", "N", "ultimate passive force Fu", 6e6}, &Backfill::strength}};

  void check() const { soil().check(); }
  /// Loading and unloading curves.
  Hyperbola soil() const noexcept { return {stiffness, unloading, failure_ratio, strength}; }

  /// d_m [m].
  double crushed(const Impact& impact) const noexcept {
    return std::max(impact.crushed, soil().left(impact.crushed) + impact.largest_penetration);
  }
  /// Growth of r in this impact [m].
  double indentation(const Impact& impact) const noexcept {
    return soil().left(crushed(impact)) - soil().left(impact.crushed);
  }

  Response contact(double penetration, double, const Impact& impact) const noexcept {
    const double deepest = crushed(impact), d = depth(penetration, impact);
    if (!(d < deepest)) return {soil().force(d), soil().slope(d), 0};
    return {unloading * (d - soil().left(deepest)), unloading, 0};
  }
  /// Area under the unloading line [J].
  double stored_energy(double penetration, const Impact& impact) const noexcept {
    const double d = depth(penetration, impact);
    return soil().stored(std::max(d, crushed(impact)), d);
  }
  /// Changes sign at the maximum d reached, where the slope jumps [m].
  double corner(double penetration, double, const Impact& impact) const noexcept {
    return depth(penetration, impact) - crushed(impact);
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }

 private:
  // Penetration from the undisturbed soil, including the residual depth of earlier impacts.
  double depth(double penetration, const Impact& impact) const noexcept {
    return penetration + soil().left(impact.crushed);
  }
};

}  // namespace pounding::laws
