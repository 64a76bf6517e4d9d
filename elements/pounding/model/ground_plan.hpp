#pragma once
/// Excitation of a model over time: the ground under all supports, and forces.

#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/ground/support_motion.hpp>

namespace pounding {

class Model;

/// Which motions the ground makes, each component once, which of them moves which support, and the forces over time
/// behind them.
struct GroundPlan {
  /// A force as one more column of the load.
  struct Force {
    int structure = 0;
    int motion = 0;    ///< its history among the motions, a force for an acceleration [N]
    double share = 0;  ///< root mean square of the accelerations by a unit force at rest, weighed by the masses [1/kg]
  };
  std::vector<GroundMotion>
      motions;  ///< of the ground, delays included, at least one, which may stay at rest; then of the forces
  std::vector<SupportMotion> supports;  ///< one a structure, in the model's order
  std::vector<Force> forces;            ///< structure by structure
  double last_arrival = 0;              ///< of the model's own ground motion at its supports [s]

  /// Time after which all accelerations and forces are zero [s]; infinity for a force that stays.
  double duration() const;
  /// Shortest spacing of uniform samples [s]; 0 where no motion has any.
  double sample_step() const;
  /// Longest step from time t to the next break that resolves all motions, see GroundMotion::longest_step [s].
  double longest_step(double t) const;
  /// A response that errors can be compared with before there is a motion, of a structure whose circular frequency is w
  /// > 0 [rad/s]: a hundredth of its static response to the largest acceleration; the response to the velocity or
  /// displacement of the ground where that is smaller, as it is to a short pulse. Forces count in the structure on
  /// which they act. Displacement [m] and velocity [m/s].
  double min_displacement(int structure, double w) const;
  double min_velocity(int structure, double w) const;

 private:
  // The largest of least(motion), times the share where the motion is that of a force on the structure.
  template <class Minimum>
  double largest(int structure, const Minimum& minimum) const;
};

/// The ground under a model. A support without a motion of its own has the model's, later by the delay of the support
/// and by the arrival of a travelling wave.
GroundPlan ground_plan(const Model& model);

}  // namespace pounding
