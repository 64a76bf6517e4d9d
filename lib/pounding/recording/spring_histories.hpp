#pragma once
/// Histories and extremes of the parts of structures that yield: storeys, hinges and devices.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// Fills StructureHistory::springs of every structure of a model.
class SpringHistories {
 public:
  /// One entry a structure stands in `histories` already. All arguments must outlive this.
  SpringHistories(const Model& model, const FloorResponse& response, const Stepper& stepper,
                  std::vector<StructureHistory>& histories);

  /// The initial state.
  void begin();
  /// The step that the stepper has just kept.
  void step();
  /// An output time before step() is told of that step: inside it, or else the present state.
  void sample(double time, bool inside);
  /// Fills the parts that yield, and what remains at the present state, of a structure that has any.
  void summarize(int structure, StructureSummary& summary) const;
  /// For a checkpoint, without the histories over time.
  void archive(Archive& archive);

 private:
  // Storeys that are springs: the forces of damping across them are sums over the floors above.
  struct StoreyDamping {
    int structure, first_row;         // of the motions of floors
    Eigen::MatrixXd by_velocity;      // [storey, floor] [N s/m]
    std::vector<double> yield_force;  // [N]
  };

  // Deformations between which a part, while its force on top stays, brings nothing new.
  struct Quiet {
    double low = 0, high = 0;
  };

  std::size_t place(int structure, std::size_t part) const { return first_[structure] - first_.front() + part; }
  double assembled(int structure, std::size_t part) const { return assembled_[place(structure, part)]; }
  void step_part(int structure, std::size_t part);
  Quiet quiet(int structure, std::size_t part) const;
  void stay();
  void step_damping(const StoreyDamping& damping);
  template <class Visit>
  void visit_parts(Visit&& visit);

  const Model& model_;
  const FloorResponse& response_;
  const Stepper& stepper_;
  std::vector<StructureHistory>& histories_;
  std::vector<std::size_t> first_;  // by structure: link of its first part
  std::vector<double> assembled_;   // by part of all structures: stiffness that K has of it
  std::vector<StoreyDamping> dampings_;
  std::vector<Quiet> quiet_;      // by part as well; valid between steps in which no spring changed its force
  Eigen::VectorXd deformations_;  // of all springs, at an output
  bool stayed_ = false;           // whether the last step was one of these
};

}  // namespace pounding
