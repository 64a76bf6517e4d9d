#pragma once
/// Histories of structures at the output times.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/recording/frame_quantities.hpp>
#include <pounding/results/results.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// An output time, inside the last accepted step or at its end.
struct OutputInstant {
  double time = 0;      ///< [s]
  bool inside = false;  ///< before the end of the step; at the end, the state after contact changes is sampled
  const Eigen::MatrixXd& floors;  ///< completed by FloorResponse
  const Eigen::VectorXd& ground;  ///< accelerations of all ground motions [m/s^2]
};

/// Fills the histories of all structures of a model: floors, storeys, nodes and members.
class StructureHistories {
 public:
  /// Creates one history per structure in `histories`. All arguments must outlive this.
  StructureHistories(const Model& model, const GroundPlan& plan, const FloorResponse& response, const StepView& stepper,
                     std::vector<StructureHistory>& histories);

  /// Appends one sample to every history.
  void sample(const OutputInstant& at);

 private:
  void sample_floors(int structure, const OutputInstant& at);
  void sample_frames(const OutputInstant& at);
  void take_motion(const OutputInstant& at);
  void append(int structure, const FrameQuantities& of, const Eigen::VectorXd& beside, const OutputInstant& at);
  Eigen::VectorXd forces_beside(int structure, const Eigen::VectorXd& u, const Eigen::VectorXd& in_members) const;
  Eigen::VectorXd yielding_forces(int structure) const;
  double device_force(int structure, std::size_t part, const OutputInstant& at) const;
  void add_fixed_end_forces(int structure, std::size_t from, const OutputInstant& at);
  void add_enforced(int structure, const OutputInstant& at);

  const Model& model_;
  const GroundPlan& plan_;
  const FloorResponse& response_;
  const StepView& stepper_;
  std::vector<StructureHistory>& histories_;
  std::vector<int> first_unknown_;              // by structure
  std::vector<std::size_t> first_spring_;       // by structure: its lowest yielding storey in the link steps
  std::vector<std::vector<int>> reported_;      // by structure: reported_forces()
  std::vector<std::optional<FrameRows>> rows_;  // by structure
  bool has_rows_ = false;                       // true if any structure has them
  bool needs_unknowns_ = false;                 // true if reported nodes, members or shears need every unknown
  Eigen::MatrixXd coordinates_;                 // at an output time
  Eigen::VectorXd u_, v_, a_;                   // all unknowns at an output time
  Eigen::VectorXd springs_;                     // forces of all springs at that time
};

}  // namespace pounding
