#pragma once
/// Peaks of floors and storeys over the kept steps.

#include <Eigen/Core>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/run/floor_response.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// Largest absolute value of a quantity over the steps of a run.
class Peak {
 public:
  /// One value.
  void update(double value);
  /// Values and slopes at the ends of a step of length h; an extremum inside is found on the cubic through them.
  void update(double h, double begin, double slope_begin, double end, double slope_end);
  /// Values at the beginning, the middle and the end of a step; an extremum inside is found on the parabola through them.
  void update(double begin, double middle, double end);
  /// The largest absolute value so far; 0 before the first.
  double value() const { return value_; }

 private:
  double value_ = 0;
};

/// Peaks of all floors. In space displacement, drift and acceleration are lengths of horizontal vectors.
class FloorPeaks {
 public:
  /// `response` and `stepper` must outlive this.
  FloorPeaks(const Model& model, const FloorResponse& response, const Stepper& stepper);

  /// The initial motion, completed by the response.
  void begin(const Eigen::MatrixXd& motion);
  /// The step that the stepper has just kept.
  void step();
  /// Peaks of one structure; drifts are left out where it has no storeys.
  StructureSummary summary(const Structure& structure, int index) const;
  /// For a checkpoint.
  void archive(Archive& archive) { archive(peaks_); }

 private:
  struct Peaks {
    Peak displacement, drift, acceleration;
  };
  void update_along_x(Peaks& peaks, double h, int row, bool lowest);
  void update_in_plan(Peaks& peaks, double h, int row, int below);

  const FloorResponse& response_;
  const Stepper& stepper_;
  bool looks_inside_;  // accelerations may have their extremum inside a step, which is long
  std::vector<std::vector<Peaks>> peaks_;
  // Motions of the last step: at its beginning, the accelerations in its middle, at its end before and after contacts changed.
  Eigen::MatrixXd begin_, middle_, end_minus_, end_plus_;
  bool has_middle_ = false, jumps_ = false;
};

}  // namespace pounding
