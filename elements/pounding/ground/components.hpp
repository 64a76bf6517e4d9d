#pragma once
/// Motion of the ground in space.

#include <Eigen/Core>
#include <array>
#include <optional>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Along x, y (both horizontal) and z (up); still where nothing is given.
using GroundComponents = std::array<GroundMotion, 3>;

/// A wave that runs along the ground: a place is reached later by its distance along `direction` over `velocity`.
struct TravellingWave {
  double velocity = 0;  ///< [m/s]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< horizontal, unit
};

/// What a `ground_motion:` section says.
struct GroundSection {
  GroundComponents components;
  std::optional<TravellingWave> wave;
};

}  // namespace pounding
