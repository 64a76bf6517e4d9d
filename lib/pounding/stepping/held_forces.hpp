#pragma once
/// Peak forces of rigid contacts that rest, inside kept steps.

#include <vector>

#include <pounding/stepping/equations.hpp>

namespace pounding {

/// Forces of rigid contacts that rest, at any instant of a kept step. The length of a step depends on the error of the
/// motion. A body at rest on a wall does not move, so its steps are long and the force between their ends and their
/// middle is not sampled.
class HeldForces {
 public:
  /// `equations` must outlive it.
  explicit HeldForces(const Equations& equations) : equations_(equations) {}

  /// Passes the largest force inside the step to each contact that rests (Contact::record_force). Call it before the
  /// histories of contacts and springs move to the end of the step.
  void record_peaks(const Instant& begin, const Trial& kept);

 private:
  // Forces of all links at a fraction s of the step.
  struct Sample {
    double s;
    Eigen::VectorXd force;
  };

  Sample at(double s, const Instant& begin, const Trial& kept);
  void find_peak(int contact, const Instant& begin, const Trial& kept, std::vector<Sample> samples);

  const Equations& equations_;
  // Working storage.
  std::vector<LinkMotion> motions_;
  Eigen::VectorXd ground_, acceleration_;
  Eigen::MatrixXd by_ground_;
};

}  // namespace pounding
