#pragma once
/// How far a part that yields has gone beyond its first yield.

#include <algorithm>

#include <pounding/structures/spring.hpp>

namespace pounding {

/// The deformations at which a part first yields, and its ductility from them.
struct YieldLimits {
  double positive = 0, negative = 0;  ///< sizes [m] or [rad]
  /// Of a part of a cut member that yields at its end: the ductility beyond 1 of the whole member over that of this part, which is shorter and yields
  /// at a smaller rotation.
  double of_whole = 1;

  YieldLimits() = default;
  explicit YieldLimits(const Spring& spring) : positive(spring.yields_towards(1)), negative(spring.yields_towards(-1)) {}

  /// Whether a deformation lies beyond.
  bool exceeded_by(double deformation) const { return deformation > positive || -deformation > negative; }
  /// The largest size over the yield deformation of its direction, between a lowest and a highest deformation.
  double ductility(double lowest, double highest) const {
    const double largest = std::max(highest / positive, -lowest / negative);
    return largest > 1 ? 1 + of_whole * (largest - 1) : largest;
  }
};

}  // namespace pounding
