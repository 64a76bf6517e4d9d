#pragma once
/// Histories and extremes of bars and dampers between structures.

#include <cstddef>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Fills the history of each device of a model.
class DeviceHistories {
 public:
  /// Creates one history per device in `histories`. All arguments must outlive this.
  DeviceHistories(const Model& model, const StepView& stepper, std::vector<DeviceHistory>& histories);

  /// Records the initial state.
  void begin();
  /// Records the step that the stepper has just accepted.
  void step();
  /// Records an output time, inside that step or at the current state.
  void sample(double time, bool inside);
  /// One entry per device, for the run up to now.
  std::vector<DeviceSummary> summary() const;
  /// For a checkpoint: the extremes.
  void archive(Archive& archive);

 private:
  const LinkStep& step_of(std::size_t device) const { return stepper_.link_step(static_cast<int>(first_ + device)); }
  double force_now(std::size_t device) const { return stepper_.link_forces()[static_cast<int>(first_ + device)]; }

  const StepView& stepper_;
  std::vector<DeviceHistory>& histories_;
  std::size_t first_;  // link of the first device
};

}  // namespace pounding
