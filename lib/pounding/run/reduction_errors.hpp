#pragma once
/// Estimates of what the reduction of structures costs, while a run goes on.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/recording/linear_quantities.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// Compares the structures with their shadow, which has one block of the links and five of the ground less and feels
/// the same forces of links, of contacts, their friction, devices and what yields, and grounds
/// (StructureSolver::counted):
///
/// forces of links:  peaks of every impact; the shadow's force is F - dF/dd delta - dF/dv delta' with the difference
/// delta of the closings and the slopes of the
///                   law at ends of steps. What the run misses is taken as that times the root of the error of the
///                   links' flexibility in its modes over that in the shadow's (flexibility_errors);
/// floors:           displacements and accelerations relative to the ground, at the end of every step;
/// members:          forces and moments at their ends, at those of some output times at which the strain energy of the
/// difference, or of the run, has its
///                   largest peaks.
///
/// The largest differences over the largest values of the run, times three, are the reported errors. The run itself is
/// better than its shadow by the blocks that this lacks.
class ReductionErrors {
 public:
  /// All arguments must outlive this.
  ReductionErrors(const Model& model, const FloorResponse& response, const Stepper& stepper);

  /// One kept step; `output_due`: there is an output time in it.
  void step(bool output_due);
  /// The reduced structures with their errors, by the peaks of a summary whose links and structures are filled.
  std::vector<ReducedStructure> errors(const Summary& summary) const;
  /// The run is over. To be called before the last errors().
  void end();
  /// For a checkpoint.
  void archive(Archive& archive);

 private:
  static constexpr int together = LinearQuantities::batch;
  // The largest peaks in time of a measure of motions that are kept.
  struct Peaks {
    std::array<double, together> measures{};  // 0 where none is kept
    double last = 0, before = 0;              // at the last two times

    // Takes the measure at the next time. If it had a peak at the last one, larger than one of those that are kept,
    // returns the place of that.
    std::optional<int> take(double next);
  };
  // Largest differences from the shadow, and largest values where no summary has them.
  struct Floors {
    int structure = 0;                       // of the model
    std::optional<LinearQuantities> forces;  // of its members, without those at rest
    StructureSolver::Segment coordinates{};
    Peaks own, difference;  // by strain energy
    Eigen::Index first_part = 0,
                 parts = 0;  // of the springs of the system: what yields in the structure, or acts inside it
    std::vector<int> units;  // of each of them: 0 for forces, 1 for moments
    std::vector<int> rows;   // of the outputs: translations of floors
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
  const Stepper& stepper_;
  std::vector<Floors> floors_;                // of the structures that have a shadow
  std::vector<double> nearer_;                // by link, errors of the run over those of the shadow
  std::vector<double> forces_;                // by link, of the peaks of its impacts that are over [N]
  std::vector<double> peaks_, shadow_peaks_;  // by link, of the impact that lasts [N]; 0 where none does
  long outputs_ = 0;
  Eigen::MatrixXd waiting_;         // coordinates at output times that are to be measured, together
  Eigen::MatrixXd waiting_forces_;  // of springs at these times [spring, time]
  int waits_ = 0;                   // so many of them
  Eigen::MatrixXd last_;  // at the last time measured: coordinates of the run, and of its difference from the shadow
  Eigen::VectorXd last_forces_;  // of springs there
  Eigen::MatrixXd kept_;  // the same at the peaks of each structure, those of the run before those of the difference
  Eigen::MatrixXd kept_forces_;  // of springs at the peaks of the run
  // Room to work in.
  Eigen::MatrixXd closings_, motion_, differences_, stiffness_times_, unknowns_;
  LinearQuantities::Instants<LinearQuantities::batch> motions_, evaluated_;
};

/// Whether the estimated errors exceed what was asked for: a bound of its own, else 0.3 of the tolerance.
bool exceeds(const ReducedStructure& errors, const Reduction& requested, double tolerance);
/// Whether what the check of all unknowns found exceeds the same.
bool check_exceeds(const ReducedStructure& found, const Reduction& requested, double tolerance);

}  // namespace pounding
