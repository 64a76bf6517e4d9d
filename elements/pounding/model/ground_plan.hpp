#pragma once
/// Excitation of a model over time: ground motions at all supports, and forces.

#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/ground/support_motion.hpp>

namespace pounding {

class Model;

/// Distinct components of the ground motion, the one that moves each support, and the forces over time.
struct GroundPlan {
  /// Force as an additional column of the load.
  struct Force {
    int structure = 0;
    int motion = 0;    ///< index of its history in the motions, a force instead of an acceleration [N]
    double share = 0;  ///< root mean square, weighted by mass, of the accelerations by a unit force at rest [1/kg]
  };
  std::vector<GroundMotion>
      motions;  ///< ground motions, delays included, at least one, which may be zero; then the forces
  std::vector<SupportMotion> supports;  ///< one per structure, in the order of the model
  std::vector<Force> forces;            ///< structure by structure
  double last_arrival = 0;              ///< of the model's ground motion at its supports [s]

  /// Time after which all accelerations and forces are zero [s]; infinity for a permanent force.
  double duration() const;
  /// Minimum spacing of uniform samples [s]; 0 if no motion has any.
  double sample_step() const;
  /// Maximum step from time t to the next break that resolves all motions, see GroundMotion::longest_step [s].
  double longest_step(double t) const;
  /// Lower bound on the response scale for relative errors, before there is any motion, of a structure with circular
  /// frequency w > 0 [rad/s]: a hundredth of its static response to the maximum acceleration, or its response to the
  /// velocity or displacement of the ground if that is smaller, as for a short pulse. Forces count in the structure on
  /// which they act. Displacement [m] and velocity [m/s].
  double min_displacement(int structure, double w) const;
  double min_velocity(int structure, double w) const;

 private:
  // Maximum of minimum(motion), multiplied by the share for the motion of a force on the structure.
  template <class Minimum>
  double largest(int structure, const Minimum& minimum) const;
};

/// Excitation of a model. A support without its own motion has that of the model, delayed by the delay of the support
/// and the arrival time of a travelling wave.
GroundPlan ground_plan(const Model& model);

}  // namespace pounding
