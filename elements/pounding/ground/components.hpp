#pragma once
/// Ground motion in space: three components, and waves that reach supports one after the other.

#include <Eigen/Core>
#include <array>
#include <optional>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Components along x, y (both horizontal) and z (up); at rest where nothing is given.
using GroundComponents = std::array<GroundMotion, 3>;

/// A wave that runs along the ground. It reaches a position later by the distance along `direction` over `velocity`.
struct TravellingWave {
  double velocity = 0;  ///< [m/s]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< horizontal, unit
};

/// Content of a `ground_motion:` section of the input.
struct GroundSection {
  GroundComponents components;
  std::optional<TravellingWave> wave;
};

}  // namespace pounding
