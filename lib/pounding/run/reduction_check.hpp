#pragma once
/// Told by `reduction: {check: true}`: all unknowns of reduced structures against the run, in its hardest impacts.

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
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// Follows the hardest impacts of the structures that are reduced and to be checked, and steps all their unknowns
/// through these once the run is over (differences_in_window).
///
/// forces of links:  peaks in each window; with all unknowns the force is F - dF/dd delta - dF/dv delta', with the
/// differences delta of the closings that all
///                   structures of the check make together, and the slopes of the law at ends of steps;
/// floors:           displacements relative to the ground, at ends of steps.
///
/// The largest differences over the largest values of the run are told as they are.
class ReductionCheck {
 public:
  /// All arguments must outlive this.
  ReductionCheck(const Model& model, const FloorResponse& response, const Stepper& stepper);

  /// One kept step.
  void step();
  /// Whether a structure is to be checked.
  bool is_requested() const { return !checked_.empty(); }
  /// The run is over: steps all unknowns of the next structure through the next impact. Returns whether more are left.
  /// Throws SolverError where a step fails.
  bool next();
  /// Adds what was found to the reduced structures, by the peaks of a summary whose links and structures are filled.
  void tell(const Summary& summary, std::vector<ReducedStructure>& reduced) const;
  /// For a checkpoint.
  void archive(Archive& archive) { windows_.archive(archive); }

 private:
  struct Checked {
    int structure = 0, group = 0;
    std::vector<int> rows;  // of the outputs: translations of floors
    double force = std::numeric_limits<double>::quiet_NaN(), displacement = 0;  // differences [N], [m]
  };

  std::vector<bool> contacts_that_count() const;
  void compare_forces(const ImpactWindow& window);

  const Model& model_;
  const Stepper& stepper_;
  std::vector<Checked> checked_;
  ImpactWindows windows_;
  std::size_t done_ = 0;              // structures that were stepped through a window, window by window
  Eigen::MatrixXd closings_, rates_;  // differences in the present window, of the structures until now [contact, step]
};

}  // namespace pounding
