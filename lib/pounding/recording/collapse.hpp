#pragma once
/// Termination of a run by excessive storey drift: analysis.collapse_drift.

#include <string>
#include <vector>

#include <pounding/model/model.hpp>
#include <pounding/recording/floor_envelopes.hpp>
#include <pounding/results/results.hpp>

namespace pounding {

/// Compares the drift of every storey of known height with the limit at which a structure counts as collapsed.
class Collapse {
 public:
  /// All arguments must outlive this.
  Collapse(const Model& model, const FloorEnvelopes& floors, const std::vector<StructureHistory>& histories);

  /// True if the model sets a collapse drift.
  bool is_requested() const { return limit_ > 0; }
  /// True if any storey has exceeded the limit.
  bool has_come() const;
  /// Location and time: "collapse at t = 3.21 s: storey 2 of left has drifted 10.2 % of its height, ...", with the
  /// yielded parts.
  std::string text(double time) const;

 private:
  // Storey with the largest drift ratio.
  struct Worst {
    int structure = -1, storey = 0;
    double drift = 0;  // drift ratio [-]
  };
  Worst worst() const;

  const Model& model_;
  const FloorEnvelopes& floors_;
  const std::vector<StructureHistory>& histories_;
  double limit_;
  std::vector<std::vector<double>> heights_;  // of the storeys of each structure [m]
};

}  // namespace pounding
