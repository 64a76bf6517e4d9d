#pragma once
/// The end of a run whose storeys drift too far: analysis.collapse_drift.

#include <string>
#include <vector>

#include <pounding/model/model.hpp>
#include <pounding/recording/floor_envelopes.hpp>
#include <pounding/results/results.hpp>

namespace pounding {

/// Compares the drifts of all storeys whose heights are known with the one at which a structure counts as collapsed.
class Collapse {
 public:
  /// All must outlive this.
  Collapse(const Model& model, const FloorEnvelopes& floors, const std::vector<StructureHistory>& histories);

  /// Whether the model says when a structure has collapsed.
  bool is_requested() const { return limit_ > 0; }
  /// Whether a storey has drifted that far, at any time until now.
  bool has_come() const;
  /// The place and the time: "collapse at t = 3.21 s: storey 2 of left has drifted 10.2 % of its height, ...", with the
  /// parts that yielded.
  std::string text(double time) const;

 private:
  // The storey that has drifted most of its height.
  struct Worst {
    int structure = -1, storey = 0;
    double drift = 0;  // over the height [-]
  };
  Worst worst() const;

  const Model& model_;
  const FloorEnvelopes& floors_;
  const std::vector<StructureHistory>& histories_;
  double limit_;
  std::vector<std::vector<double>> heights_;  // of the storeys of each structure [m]
};

}  // namespace pounding
