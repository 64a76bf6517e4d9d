#pragma once
/// Peak forces of rigid contacts at rest, inside accepted steps.

#include <vector>

#include <pounding/stepping/equations.hpp>

namespace pounding {

/// Evaluates the forces of rigid contacts at rest at any instant of an accepted step. The step length depends on the
/// error of the motion. A body at rest on a wall does not move, so its steps are long, and the force between their ends
/// and middle would not be sampled.
class HeldForces {
 public:
  /// `equations` must outlive this object.
  explicit HeldForces(Equations& equations) : equations_(equations) {}

  /// Passes the maximum force inside the step to each contact at rest (Contact::record_force). Call it before the
  /// histories of contacts and springs are updated to the end of the step.
  void record_peaks(const Instant& begin, const Trial& kept);

 private:
  // Forces of all links at fraction s of the step.
  struct Sample {
    double s;
    Eigen::VectorXd force;
  };

  Sample at(double s, const Instant& begin, const Trial& kept);
  void find_peak(int contact, const Instant& begin, const Trial& kept, std::vector<Sample> samples);

  Equations& equations_;
  // Working storage.
  std::vector<LinkMotion> motions_;
  Eigen::VectorXd ground_, acceleration_;
  Eigen::MatrixXd by_ground_;
};

}  // namespace pounding
