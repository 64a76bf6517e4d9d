#pragma once
/// Ground motion in space: three components, and waves that reach supports one after the other.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Components along x, y (both horizontal) and z (up); at rest where nothing is given.
using GroundComponents = std::array<GroundMotion, 3>;

/// A wave that runs along the ground. It reaches a position later by the distance along `direction` over `velocity`.
struct TravellingWave {
  double velocity = 0;                                   ///< [m/s]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< horizontal, unit
};

/// How the ground moves under a model: along x alone, or along several axes; at all places at once, or as a wave.
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
