#pragma once
/// The strongest impacts of a run: the state before each, and the link forces during it.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// A few milliseconds of a run in which contacts press.
struct ImpactWindow {
  /// Force of a link in one step [N], and the slopes of its law at the end of the step; the slopes are zero for links
  /// other than contacts.
  struct Force {
    int link = 0;
    double begin = 0, middle = 0, end = 0;
    double by_penetration = 0, by_rate = 0;  ///< [N/m], [N s/m]
  };
  /// One accepted step, with the links whose force is nonzero in it.
  struct Step {
    double begin = 0, end = 0;  ///< [s]
    std::vector<Force> forces;

    /// Writes or reads all members.
    void archive(Archive& archive);
  };

  double force = 0;      ///< maximum force of the observed contacts [N]
  Eigen::VectorXd u, v;  ///< coordinates of the structures at the beginning of the first step, and their rates
  std::vector<Step> steps;

  double begin() const { return steps.front().begin; }
  double end() const { return steps.back().end; }
  /// Writes or reads all members.
  void archive(Archive& archive);
};

/// Collects the windows with the largest forces during a run. A window begins with the step that leads to a touch. It
/// ends 2 ms after the last contact force, or after 0.1 s; in that case the next window begins immediately.
class ImpactWindows {
 public:
  /// Maximum number of windows.
  static constexpr std::size_t maximum = 3;

  /// `counts`: by contact, true if its impacts are observed. `stepper` must outlive this object.
  ImpactWindows(const StepView& stepper, std::vector<bool> counts) : stepper_(stepper), counts_(std::move(counts)) {}

  /// Follows one accepted step.
  void step();
  /// Ends the run, possibly within an impact.
  void end();
  /// The windows with the largest forces, in descending order.
  const std::vector<ImpactWindow>& hardest() const { return hardest_; }
  /// Writes or reads the state for a checkpoint.
  void archive(Archive& archive);

 private:
  bool presses() const;
  void record();

  const StepView& stepper_;
  std::vector<bool> counts_;
  std::vector<ImpactWindow> hardest_;
  ImpactWindow present_;  // without steps if no contact presses
  double last_pressed_ = 0;
};

}  // namespace pounding
