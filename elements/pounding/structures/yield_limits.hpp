#pragma once
/// Ductility of a yielding part.

#include <algorithm>

#include <pounding/structures/spring.hpp>

namespace pounding {

/// Minimum and maximum of a quantity.
struct ValueRange {
  double lowest = 0, highest = 0;
};

/// Deformations at first yield of a part, and its ductility.
struct YieldLimits {
  double positive = 0, negative = 0;  ///< magnitudes [m] or [rad]
  /// For a hinge: elastic rotation at the end of the whole member per moment, minus the elastic part of the deformation
  /// [rad/(N m)], and the yield moments in both directions [N m]. With these, the ductility for a given plastic
  /// rotation is the same for a spring in series, a rigid-plastic hinge, and a hinge of a subdivided member.
  double flexibility = 0;
  double positive_force = 0, negative_force = 0;

  YieldLimits() = default;
  explicit YieldLimits(const Spring& spring)
      : positive(spring.yields_towards(1)), negative(spring.yields_towards(-1)) {}

  /// True if a deformation exceeds a limit.
  bool exceeded_by(double deformation) const { return deformation > positive || -deformation > negative; }
  /// Maximum ratio of deformation to yield deformation in its direction; for a hinge, of the rotation of the member end
  /// to its yield rotation.
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
