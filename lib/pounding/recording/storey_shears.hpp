#pragma once
/// Extremes of the shears of storeys that are springs.

#include <Eigen/Core>
#include <vector>

#include <pounding/model/model.hpp>
#include <pounding/recording/step_motion.hpp>
#include <pounding/results/results.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Fills the storey shear envelopes of structures along one line in every step, from the drifts.
class StoreyShears {
 public:
  /// Fills `results`. All arguments must outlive this.
  StoreyShears(const Model& model, const StepView& stepper, Results& results);

  /// Records the initial state; `floors` is its motion as completed by FloorResponse.
  void begin(const Eigen::MatrixXd& floors);
  /// Records an accepted step.
  void step(const StepMotion& step);
  /// Completes the envelopes: shears of elastic storeys follow from their drift envelopes.
  void show();

 private:
  void step_storey(int structure, std::size_t storey, const StepMotion& step);
  template <class Visit>
  void visit_storeys(bool elastic, Visit&& visit) const;

  const Model& model_;
  const StepView& stepper_;
  Results& results_;
  std::vector<std::size_t> first_spring_;  // by structure: its lowest yielding storey in the link steps
  std::vector<int> first_row_;             // by structure: its lowest floor in the motions
  bool has_inelastic_ = false;             // storeys that yield or have devices
};

}  // namespace pounding
