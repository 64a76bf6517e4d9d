#pragma once
/// The last kept step as envelopes see it: the reported motion of all floors at its ends and in its middle.

#include <Eigen/Core>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/results/envelope.hpp>
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
  bool presses =
      false;  ///< links alone press in this step, which has a middle: accelerations bend sharply, see acceleration()
  bool has_middle = false;  ///< accelerations may have their extremum inside this step, which is long
  bool jumps = false;       ///< something changed at its end

  double end_time() const { return begin_time + h; }
  /// Acceleration of a row over the step, with `presses`.
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
  const Stepper& stepper_;
  bool taken_ = false;      // the step before
  Eigen::MatrixXd missed_;  // by the parabola of the acceleration: [row, alpha beta] of Quartic
  struct {
    double h = 0;  // [s]; zero where accelerations are not smooth between it and this one
    Eigen::MatrixXd middle;
  } before_;
};

}  // namespace pounding
