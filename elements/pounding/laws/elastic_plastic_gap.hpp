#pragma once
#include <algorithm>
#include <array>
#include <string_view>

#include <pounding/laws/checks.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F = k d up to the yield force, then Fy + a k (d - Fy/k); unloading and reloading with k from the plastic deformation
/// p = (1-a) (d_m - Fy/k).
///
/// k [N/m] stiffness, Fy [N] yield force, a in [0, 1) [-] hardening ratio, d [m] penetration from the undamaged
/// surface, d_m [m] its maximum. With damage, p is added to the gap for the rest of the run. Without damage, p is
/// recovered while the bodies separate: the next contact begins at the undamaged surface, or where the bodies reversed.
/// OpenSees ElasticPPGap (EPPGapMaterial), with E = k, Fy, eta = a, `damage` or `noDamage`, and opposite signs.
///
/// First impact with energy E > Fy^2/(2 k): restitution F_m/sqrt(2 k E) with the peak force F_m; lost is the plastic
/// work (Fy + F_m)/2 p.
struct ElasticPlasticGap {
  static constexpr std::string_view
      name = "elastic_plastic_gap",
      shape = "F = k d up to Fy, Fy + a k (d - Fy/k) for d = d_m, k (d - p) for d < d_m; p = (1-a) (d_m - Fy/k)";
  static constexpr std::string_view summary =
      "contact that yields at a force, with hardening and damage (ElasticPPGap)";
  static constexpr std::string_view source = "OpenSees ElasticPPGap (EPPGapMaterial)";
  static constexpr std::string_view symbols =
      "k [N/m] contact stiffness, Fy [N] yield force, a [-] hardening ratio, d measured from the undamaged surface, "
      "d_m [m] its maximum, p [m] plastic deformation";
  static constexpr std::string_view range = "Fy > 0, 0 <= a < 1";
  static constexpr std::string_view beware =
      "the dissipation follows from yielding, not from a restitution. With damage: true the plastic deformation is "
      "added to the gap; with damage: false it is recovered in each separation, and every impact dissipates again";
  static constexpr bool leaves_indentation = true;

  double stiffness = 0;    ///< k > 0 [N/m]
  double yield_force = 0;  ///< Fy > 0 [N]
  double hardening = 0;    ///< a in [0, 1) [-]
  double damage = -1;      ///< 1: the plastic deformation is added to the gap, 0: it is recovered

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "contact stiffness k", 1e9}, &ElasticPlasticGap::stiffness},
      Parameter{{"yield_force", "N", "yield force Fy", 2e6}, &ElasticPlasticGap::yield_force},
      Parameter{{"hardening", "", "ratio a of post-yield to initial stiffness", 0.02}, &ElasticPlasticGap::hardening},
      Parameter{{"damage",
                 "",
                 "1 (true): the gap grows with the plastic deformation; 0 (false): it does not",
                 1,
                 Need::required,
                 {},
                 true},
                &ElasticPlasticGap::damage}};

  void check() const {
    require_positive("stiffness", stiffness);
    require_positive("yield_force", yield_force);
    if (!(hardening >= 0 && hardening < 1)) refuse("hardening", hardening, "in [0, 1)");
    if (damage != 0 && damage != 1) refuse("damage", damage, "1 (true) or 0 (false)");
  }
  /// True without damage.
  bool heals() const noexcept { return damage == 0; }

  /// d_m [m]; 0 without damage.
  double crushed(const Impact& impact) const noexcept {
    return heals() ? 0 : std::max(impact.crushed, plastic(impact.crushed) + impact.largest_penetration);
  }
  /// Growth of the gap in this impact [m].
  double indentation(const Impact& impact) const noexcept { return plastic(crushed(impact)) - plastic(impact.crushed); }

  Response contact(double penetration, double, const Impact& impact) const noexcept {
    const double d = depth(penetration, impact), p = offset(impact), yields_at = yield_depth(p);
    if (d > yields_at)
      return {yield_force + hardening * stiffness * (d - yield_force / stiffness), hardening * stiffness, 0};
    return {stiffness * (d - p), stiffness, 0};
  }
  /// Area under the unloading line [J].
  double stored_energy(double penetration, const Impact& impact) const noexcept {
    const double force = no_tension(contact(penetration, 0, impact).force);
    return 0.5 * force * force / stiffness;
  }
  /// Changes sign at yield, where the slope jumps [m].
  double corner(double penetration, double, const Impact& impact) const noexcept {
    return depth(penetration, impact) - yield_depth(offset(impact));
  }
  /// Without damage: updates p, which also follows the bodies while they separate without a force.
  void keep(double penetration, double, Impact& impact) const noexcept {
    if (!heals()) return;
    if (penetration > yield_depth(impact.slip)) impact.slip = plastic(penetration);
    impact.slip = std::clamp(impact.slip, 0.0, std::max(penetration, 0.0));
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }

 private:
  // p for a maximum d_m.
  double plastic(double deepest) const noexcept {
    return (1 - hardening) * std::max(deepest - yield_force / stiffness, 0.0);
  }
  double offset(const Impact& impact) const noexcept { return heals() ? impact.slip : plastic(crushed(impact)); }
  // The d at which the unloading line of p meets the loading curve.
  double yield_depth(double p) const noexcept { return p / (1 - hardening) + yield_force / stiffness; }
  // Penetration from the undamaged surface.
  double depth(double penetration, const Impact& impact) const noexcept {
    return penetration + plastic(impact.crushed);
  }
};

}  // namespace pounding::laws
