#pragma once
/// The check of `reduction: {check: true}`: compares reduced structures with all their degrees of freedom in the
/// strongest impacts of a run.

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/run/impact_windows.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Records the strongest impacts of the reduced structures to check. After the run, integrates all their degrees of
/// freedom through these impacts (differences_in_window) and compares:
///
/// forces of links:  peaks in each window. With all degrees of freedom the force is F - dF/dd delta - dF/dv delta',
///                   where delta are the differences in closing of all checked structures together, with the slopes
///                   of the law at the ends of steps;
/// floors:           displacements relative to the ground, at ends of steps.
///
/// Reported are the largest differences divided by the largest values of the run.
class ReductionCheck {
 public:
  /// All arguments must outlive this object.
  ReductionCheck(const Model& model, const FloorResponse& response, const StepView& stepper);

  /// Follows one accepted step.
  void step();
  /// True if any structure is to be checked.
  bool is_requested() const { return !checked_.empty(); }
  /// After the run: integrates all degrees of freedom of the next structure through the next impact. Returns true if
  /// more remain. Throws SolverError if a step fails.
  bool next();
  /// Adds the results to the reduced structures, relative to the peaks of a summary whose links and structures are
  /// filled.
  void tell(const Summary& summary, std::vector<ReducedStructure>& reduced) const;
  /// Writes or reads the state for a checkpoint.
  void archive(Archive& archive) { windows_.archive(archive); }

 private:
  struct Checked {
    int structure = 0, group = 0;
    std::vector<int> rows;  // rows of the outputs: translations of floors
    double force = std::numeric_limits<double>::quiet_NaN(), displacement = 0;  // differences [N], [m]
  };

  std::vector<bool> contacts_that_count() const;
  void compare_forces(const ImpactWindow& window);

  const Model& model_;
  const StepView& stepper_;
  std::vector<Checked> checked_;
  ImpactWindows windows_;
  std::size_t done_ = 0;              // number of structures integrated through a window, window by window
  Eigen::MatrixXd closings_, rates_;  // differences in the current window, summed over the structures [contact, step]
};

}  // namespace pounding
