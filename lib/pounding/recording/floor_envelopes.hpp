#pragma once
/// Extremes of floors and storeys over the accepted steps.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/recording/step_motion.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>

namespace pounding {

/// Extremes of floor displacements, edge displacements of rigid floors, accelerations and drifts in the envelopes of
/// all structures, and the largest lengths of their horizontal vectors for the summary.
class FloorEnvelopes {
 public:
  /// Fills the envelopes in `histories`, which must outlive this, as must `response`.
  FloorEnvelopes(const Model& model, const FloorResponse& response, std::vector<StructureHistory>& histories);

  /// Records the initial motion, completed by the response, at a time [s].
  void begin(const Eigen::MatrixXd& motion, double time);
  /// Records an accepted step.
  void step(const StepMotion& step);
  /// Peaks of one structure; no drifts if it has no storeys.
  StructureSummary summary(const Structure& structure, int index) const;
  /// Largest drift of a storey up to now [m]; in space, of the horizontal vector.
  double peak_drift(int structure, int storey) const {
    return (response_.directions(structure) > 1 ? lengths_[structure].drift : histories_[structure].envelope.drift)
        .peak(storey);
  }
  /// For a checkpoint, without the envelopes.
  void archive(Archive& archive) { archive(lengths_); }

 private:
  // Lengths of horizontal vectors, one per floor; empty for a structure that moves along x only. `corner` holds
  // displacements of all corners of a rigid floor.
  struct Lengths {
    Extremes displacement, drift, acceleration, corner;
    void archive(Archive& archive) { archive(displacement, drift, acceleration, corner); }
  };
  void step_along(int structure, const StepMotion& step);
  void step_in_plan(int structure, const StepMotion& step);
  void step_of_edges(int structure, const StepMotion& step);

  const FloorResponse& response_;
  std::vector<StructureHistory>& histories_;
  std::vector<Lengths> lengths_;
  std::vector<std::vector<std::optional<std::array<double, 4>>>> plans_;  // [structure][floor], see Floor::plan
  std::vector<bool> turns_;                                               // [structure] true if it has such floors
};

}  // namespace pounding
