#pragma once
/// The last accepted step for envelopes: reported motion of all floors at both ends and the midpoint.

#include <Eigen/Core>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/results/envelope.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Motions are [row, u v a] as completed by FloorResponse.
class StepMotion {
 public:
  /// Both arguments must outlive this.
  StepMotion(const FloorResponse& response, const StepView& stepper);

  /// Reads the step that the stepper has just accepted. Call it once per step.
  void take();

  double begin_time = 0, h = 0;  ///< start and length [s]
  Eigen::MatrixXd begin;         ///< at the start
  Eigen::MatrixXd middle;        ///< accelerations at the midpoint, [row, 1]; only with has_middle
  Eigen::MatrixXd end_minus;     ///< at the end, before contacts change
  Eigen::MatrixXd end_plus;      ///< at the end, after the change; only with jumps
  /// true if only links are active in this step and has_middle: accelerations curve sharply, see acceleration()
  bool presses = false;
  bool has_middle = false;  ///< true for long steps, in which accelerations may have an interior extremum
  bool jumps = false;       ///< true if there is a discontinuity at the end

  double end_time() const { return begin_time + h; }
  /// Acceleration of a row over the step, if `presses`.
  Quartic acceleration(int row) const {
    return {begin(row, 2), middle(row, 0), end_minus(row, 2), missed_(row, 0), missed_(row, 1)};
  }
  /// For a checkpoint.
  void archive(Archive& archive) { archive(before_.h, before_.middle); }

 private:
  bool any_link_presses() const;
  void find_missed_area(const Eigen::MatrixXd& begin, const Eigen::MatrixXd& end);
  void find_missed_bend();

  const FloorResponse& response_;
  const StepView& stepper_;
  bool taken_ = false;      // true if the previous step was recorded
  Eigen::MatrixXd missed_;  // correction to the parabola of the acceleration: [row, alpha beta] of Quartic
  struct {
    double h = 0;  // [s]; 0 if accelerations are not smooth between it and this step
    Eigen::MatrixXd middle;
  } before_;
};

}  // namespace pounding
