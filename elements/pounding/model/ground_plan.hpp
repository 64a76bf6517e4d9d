#pragma once
/// The motions of the ground under all supports of a model.

#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/ground/support_motion.hpp>

namespace pounding {

class Model;

/// Which motions the ground makes, each component once, and which of them moves which support.
struct GroundPlan {
  std::vector<GroundMotion> motions;    ///< delays included; at least one, which may stay at rest
  std::vector<SupportMotion> supports;  ///< one a structure, in the model's order

  /// Time after which all accelerations are zero [s].
  double duration() const;
  /// Shortest spacing of uniform samples [s]; 0 where no motion has any.
  double sample_step() const;
  /// Longest step from time t to the next break that resolves all motions, see GroundMotion::longest_step [s].
  double longest_step(double t) const;
  /// A response that errors can be compared with before there is a motion, of an oscillator of circular frequency w > 0 [rad/s]: a
  /// hundredth of its static response to the largest acceleration; the response to the velocity or displacement of the ground where
  /// that is smaller, as it is to a short pulse. Displacement [m] and velocity [m/s].
  double least_displacement(double w) const;
  double least_velocity(double w) const;
};

/// The ground under a model. A support without a motion of its own has the model's, later by the delay of the support and by the
/// arrival of a travelling wave.
GroundPlan ground_plan(const Model& model);

}  // namespace pounding
