#pragma once
/// Errors of reduced structures: estimated in every step, and checked after the run with all degrees of freedom.

#include <pounding/core/archive.hpp>
#include <pounding/model/model.hpp>
#include <pounding/recording/floor_response.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/run/reduction_check.hpp>
#include <pounding/run/reduction_errors.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// The two reports on reduced structures; both are empty if no structure is reduced.
struct ReductionReport {
  ReductionErrors errors;
  ReductionCheck check;

  /// All arguments must outlive this object.
  ReductionReport(const Model& model, const FloorResponse& response, const StepView& stepper)
      : errors(model, response, stepper), check(model, response, stepper) {}

  /// Follows one accepted step; `output_due` is true if it contains an output time.
  void step(bool output_due) {
    errors.step(output_due);
    check.step();
  }
  /// Fills the reduced structures of a summary whose links and structures are filled.
  void summarize(Summary& summary) const {
    summary.reduced = errors.errors(summary);
    check.tell(summary, summary.reduced);
  }
  /// Serialises both for a checkpoint.
  void archive(Archive& archive) {
    errors.archive(archive);
    check.archive(archive);
  }
};

}  // namespace pounding
