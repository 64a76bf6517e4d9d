#pragma once
/// Instants from one to the next of which a cubic follows the motion of all structures.

#include <Eigen/Core>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// The last knot, and how far the cubic from there may reach: several steps where they are short.
class Knots {
 public:
  /// `stepper` must outlive this.
  explicit Knots(const Stepper& stepper);

  /// The last knot [s].
  double last() const { return last_; }
  /// This instant, of the last kept step, becomes the last knot.
  void set(const Instant& instant);
  /// Whether a cubic from the last knot, which lies before the beginning of the last kept step, to the end of that step
  /// follows the motion closely. To be asked once a step.
  bool reach_over_step();
  /// For a checkpoint.
  void archive(Archive& archive);

 private:
  void take_norms(const Eigen::VectorXd& x);

  const Stepper& stepper_;
  double last_ = 0;
  Eigen::VectorXd acceleration_;  // at the last knot, in the coordinates of the solver
  // By group, as square roots of strain energy: the largest displacement so far, and how far the acceleration has
  // strayed from a straight line since the last knot.
  std::vector<double> largest_, strayed_;
  std::vector<double> norms_;
  Eigen::VectorXd bend_, stiffness_times_;
};

}  // namespace pounding
