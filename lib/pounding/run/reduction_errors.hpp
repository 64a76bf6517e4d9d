#pragma once
/// Error estimates of reduced structures during a run.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/recording/linear_quantities.hpp>
#include <pounding/reduction/shadowed_solver.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Compares the structures with their shadow, which has one link block and five ground blocks less. The shadow is
/// subject to the same forces: contacts, friction, devices, yielding parts and ground motion
/// (ShadowedSolver). The estimates are:
///
/// forces of links:  peaks of every impact. The force of the shadow is F - dF/dd delta - dF/dv delta', with the
///                   difference in closing delta and the slopes of the law at the ends of steps. The estimated error of
///                   the run is this difference times the square root of the ratio of flexibility errors of the links
///                   in the modes of the run and of the shadow (flexibility_errors);
/// floors:           displacements and accelerations relative to the ground, at the end of every step;
/// members:          forces and moments at their ends, at the output times at which the strain energy of the
///                   difference, or of the run, has its largest peaks.
///
/// Reported are three times the largest differences divided by the largest values of the run. The run itself has more
/// blocks than its shadow and is more accurate.
class ReductionErrors {
 public:
  /// All arguments must outlive this object.
  ReductionErrors(const Model& model, const FloorResponse& response, const StepView& stepper);

  /// Follows one accepted step; `output_due`: it contains an output time.
  void step(bool output_due);
  /// The reduced structures with their errors, relative to the peaks of a summary whose links and structures are
  /// filled.
  std::vector<ReducedStructure> errors(const Summary& summary) const;
  /// Ends the run. Call it before the last errors().
  void end();
  /// Writes or reads the state for a checkpoint.
  void archive(Archive& archive);

 private:
  static constexpr int together = LinearQuantities::batch;
  // Largest peaks in time of the measure by which motions are stored.
  struct Peaks {
    std::array<double, together> measures{};  // 0 for unused entries
    double last = 0, before = 0;              // at the last two times

    // Adds the measure at the next time. If the previous time was a peak that exceeds a stored one, replaces it and
    // returns its index.
    std::optional<int> take(double next);
  };
  // Largest differences from the shadow, and largest values that no summary contains.
  struct Floors {
    int structure = 0;                       // of the model
    std::optional<LinearQuantities> forces;  // of its members, without the forces at rest
    StructureSolver::Segment coordinates{};
    Peaks own, difference;  // by strain energy
    Eigen::Index first_part = 0,
                 parts = 0;  // range in the springs of the system: parts that yield or act inside the structure
    std::vector<int> units;  // of each member force: 0 for forces, 1 for moments
    std::vector<int> rows;   // rows of the outputs: translations of floors
    double displacement = 0, acceleration = 0;
    std::array<double, 2> members{}, largest_members{};  // forces, moments
  };

  void compare_forces(const Instant& end);
  double peak_difference(std::size_t link) const;
  double nearer(int link) const;
  void measure_waiting();
  void keep_last(Floors& floors, double own, double difference);
  void compare_members();
  void add_yielding(const Floors& floors);

  const Model& model_;
  const StepView& stepper_;
  const ShadowedSolver* shadowed_;            // null without a shadow
  std::vector<Floors> floors_;                // of the structures with a shadow
  std::vector<double> nearer_;                // by link, ratio of the errors of the run and of the shadow
  std::vector<double> forces_;                // by link, from finished impacts [N]
  std::vector<double> peaks_, shadow_peaks_;  // by link, of the current impact [N]; 0 if there is none
  long outputs_ = 0;
  Eigen::MatrixXd waiting_;         // coordinates at output times, measured together as a batch
  Eigen::MatrixXd waiting_forces_;  // of springs at these times [spring, time]
  int waits_ = 0;                   // number of times in the batch
  Eigen::MatrixXd last_;  // at the last measured time: coordinates of the run, and of its difference from the shadow
  Eigen::VectorXd last_forces_;  // of springs there
  Eigen::MatrixXd kept_;  // coordinates at the peaks of each structure: those of the run, then those of the difference
  Eigen::MatrixXd kept_forces_;  // of springs at the peaks of the run
  // Workspace.
  Eigen::MatrixXd closings_, motion_, stiffness_times_;
  LinearQuantities::Instants<LinearQuantities::batch> motions_, evaluated_;
};

/// True if the estimated errors exceed the requested error, by default 0.3 of the tolerance.
bool exceeds(const ReducedStructure& errors, const Reduction& requested, double tolerance);
/// True if the differences found by the check exceed the same bound.
bool check_exceeds(const ReducedStructure& found, const Reduction& requested, double tolerance);

}  // namespace pounding
