#pragma once
/// Ground motion in space: three components, and waves that reach supports at different times.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Components along x, y (both horizontal) and z (up); at rest by default.
using GroundComponents = std::array<GroundMotion, 3>;

/// A wave travelling along the ground. Its delay at a position is the distance along `direction` divided by `velocity`.
struct TravellingWave {
  double velocity = 0;                                   ///< [m/s]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< horizontal unit vector
};

/// Ground motion of a model: along x only or along several axes; uniform or as a wave.
struct GroundSection {
  GroundSection() = default;
  /// Along x.
  GroundSection(GroundMotion motion) : components{std::move(motion), GroundMotion(), GroundMotion()} {}
  GroundSection(const Harmonic& motion) : GroundSection(GroundMotion(motion)) {}
  GroundSection(const HarmonicSum& motion) : GroundSection(GroundMotion(motion)) {}
  GroundSection(const Pulse& motion) : GroundSection(GroundMotion(motion)) {}
  GroundSection(GroundComponents motions) : components(std::move(motions)) {}

  GroundComponents components;
  std::optional<TravellingWave> wave;
};

}  // namespace pounding
