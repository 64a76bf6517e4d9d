#pragma once
/// Knots between which a cubic follows the motion of all structures.

#include <Eigen/Core>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// The last knot, and the reach of the cubic that starts there: several steps if these are short.
class Knots {
 public:
  /// `stepper` must outlive this.
  explicit Knots(const StepView& stepper);

  /// The last knot [s].
  double last() const { return last_; }
  /// Makes this instant of the last accepted step the last knot.
  void set(const Instant& instant);
  /// True if a cubic from the last knot, which lies before the start of the last accepted step, to the end of that step
  /// follows the motion closely. Call it exactly once per step.
  bool reach_over_step();
  /// For a checkpoint.
  void archive(Archive& archive);

 private:
  void take_norms(const Eigen::VectorXd& x);

  const StepView& stepper_;
  double last_ = 0;
  Eigen::VectorXd acceleration_;  // at the last knot, in solver coordinates
  // By group, as square roots of strain energy: largest displacement up to now, and largest deviation of the
  // acceleration from a straight line since the last knot.
  std::vector<double> largest_, strayed_;
  std::vector<double> norms_;
  Eigen::VectorXd bend_, stiffness_times_;
};

}  // namespace pounding
