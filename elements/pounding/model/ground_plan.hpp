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

  /// Largest absolute acceleration of all motions [m/s^2].
  double peak() const;
  /// Time after which all accelerations are zero [s].
  double duration() const;
  /// Shortest spacing of uniform samples [s]; 0 where no motion has any.
  double sample_step() const;
  /// Shortest period of the closed forms [s]; infinity where there is none.
  double shortest_period() const;
};

/// The ground under a model. A support without a motion of its own has the model's, later by the delay of the support and by the
/// arrival of a travelling wave.
GroundPlan ground_plan(const Model& model);

}  // namespace pounding
