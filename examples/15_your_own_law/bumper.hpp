#pragma once
/// A contact law that the library has not: a rubber bumper that hardens.

#include <stdexcept>
#include <string_view>

#include <pounding/laws.hpp>

/// F = (k d + b d^3) (1 + mu d')
///
/// d [m] penetration, d' [m/s] its rate. The spring may have any shape: with the factor 1 + mu d' a free impact that
/// begins at the speed v ends at the speed w of ln((1 + mu v)/(1 - mu w)) = mu (v + w), so the restitution follows from
/// mu v alone.
struct Bumper {
  static constexpr std::string_view name = "bumper";

  double stiffness = 0;  ///< k > 0 [N/m]
  double hardening = 0;  ///< b >= 0 [N/m^3]
  double loss = 0;       ///< mu >= 0 [s/m]

  /// Throws std::invalid_argument for a parameter that cannot be.
  void check() const {
    if (!(stiffness > 0)) throw std::invalid_argument("bumper: stiffness must be positive");
    if (!(hardening >= 0 && loss >= 0)) throw std::invalid_argument("bumper: hardening and loss must not be negative");
  }

  /// The force and its two slopes, also where the force is negative: the link cuts what would pull.
  pounding::laws::Response contact(double d, double rate, const pounding::laws::Impact&) const noexcept {
    const double spring = d * (stiffness + hardening * d * d), slope = stiffness + 3 * hardening * d * d;
    const double factor = 1 + loss * rate;
    return {.force = spring * factor, .by_penetration = slope * factor, .by_rate = spring * loss};
  }
};
