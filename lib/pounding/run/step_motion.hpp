#pragma once
/// The last kept step as envelopes see it: the reported motion of all floors at its ends and in its middle.

#include <Eigen/Core>

#include <pounding/run/floor_response.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// Motions are [row, u v a] as FloorResponse completes them.
class StepMotion {
 public:
  /// Both must outlive this.
  StepMotion(const FloorResponse& response, const Stepper& stepper);

  /// Takes the step that the stepper has just kept. To be asked for every step.
  void take();

  double begin_time = 0, h = 0;  ///< beginning and length [s]
  Eigen::MatrixXd begin;         ///< at the beginning
  Eigen::MatrixXd middle;        ///< accelerations in the middle, [row, 1]; only with has_middle
  Eigen::MatrixXd end_minus;     ///< at the end, before contacts changed
  Eigen::MatrixXd end_plus;      ///< after; only with jumps
  bool has_middle = false;       ///< accelerations may have their extremum inside this step, which is long
  bool jumps = false;            ///< something changed at its end

  double end_time() const { return begin_time + h; }

 private:
  const FloorResponse& response_;
  const Stepper& stepper_;
  bool taken_ = false;  // the step before
};

}  // namespace pounding
