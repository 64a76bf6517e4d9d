#pragma once
/// How far a part that yields has gone beyond its first yield.

#include <algorithm>

#include <pounding/structures/spring.hpp>

namespace pounding {

/// Smallest and largest value of a quantity.
struct ValueRange {
  double lowest = 0, highest = 0;
};

/// The deformations at which a part first yields, and its ductility from them.
struct YieldLimits {
  double positive = 0, negative = 0;  ///< sizes [m] or [rad]
  /// Of a hinge: elastic rotation of the end of the whole member less the elastic part of the deformation, per moment
  /// [rad/(N m)], and the yield moments in both directions [N m]. So the same plastic rotation is the same ductility
  /// for a spring in series, a rigid-plastic hinge and one on a part of a cut member.
  double flexibility = 0;
  double positive_force = 0, negative_force = 0;

  YieldLimits() = default;
  explicit YieldLimits(const Spring& spring)
      : positive(spring.yields_towards(1)), negative(spring.yields_towards(-1)) {}

  /// Whether a deformation lies beyond.
  bool exceeded_by(double deformation) const { return deformation > positive || -deformation > negative; }
  /// Largest deformation over the yield deformation of its direction; of a hinge, rotation of the member end over its
  /// yield rotation.
  double ductility(const ValueRange& deformation, const ValueRange& force) const {
    return std::max(rotation(deformation.highest, force.highest) / rotation(positive, positive_force),
                    -rotation(deformation.lowest, force.lowest) / rotation(negative, negative_force));
  }

 private:
  double rotation(double deformation, double force) const {
    return flexibility == 0 ? deformation : deformation + flexibility * force;
  }
};

}  // namespace pounding
