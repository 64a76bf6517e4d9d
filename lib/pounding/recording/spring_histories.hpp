#pragma once
/// Histories and extremes of the yielding parts of structures: storeys, hinges and devices.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Fills StructureHistory::springs for every structure of a model.
class SpringHistories {
 public:
  /// `histories` has one entry per structure. All arguments must outlive this.
  SpringHistories(const Model& model, const FloorResponse& response, const StepView& stepper,
                  std::vector<StructureHistory>& histories);

  /// Records the initial state.
  void begin();
  /// Records the step that the stepper has just accepted.
  void step();
  /// Records an output time inside the accepted step, before step() is called for it, or at the current state.
  void sample(double time, bool inside);
  /// Fills the yielding parts and the residual values at the current state, if the structure has yielding parts.
  void summarize(int structure, StructureSummary& summary) const;
  /// For a checkpoint, without the histories over time.
  void archive(Archive& archive);

 private:
  // Storeys that are springs: damping forces across them are sums over the floors above.
  struct StoreyDamping {
    int structure, first_row;         // of the motions of floors
    Eigen::MatrixXd by_velocity;      // [storey, floor] [N s/m]
    std::vector<double> yield_force;  // [N]
  };

  // Range of deformations that produces no new extreme while the force in addition to K u is constant.
  struct Quiet {
    double low = 0, high = 0;
  };

  std::size_t place(int structure, std::size_t part) const { return first_[structure] - first_.front() + part; }
  double assembled(int structure, std::size_t part) const { return assembled_[place(structure, part)]; }
  void step_part(int structure, std::size_t part);
  void step_resultant(SpringHistory& history, const YieldingPart& part, std::size_t i, int first);
  Quiet quiet(int structure, std::size_t part) const;
  void stay();
  void step_damping(const StoreyDamping& damping);
  template <class Visit>
  void visit_parts(Visit&& visit);

  const Model& model_;
  const FloorResponse& response_;
  const StepView& stepper_;
  std::vector<StructureHistory>& histories_;
  std::vector<std::size_t> first_;  // by structure: link of its first part
  std::vector<double> assembled_;   // by part of all structures: stiffness included in K
  std::vector<StoreyDamping> dampings_;
  std::vector<Quiet> quiet_;      // by part; valid between steps in which no spring changed its force
  Eigen::VectorXd deformations_;  // all springs, at an output time
  bool stayed_ = false;           // true if the last step was such a step
};

}  // namespace pounding
