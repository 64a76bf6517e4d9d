#pragma once
/// Runs a model through time and records what happens.

#include <functional>
#include <string>
#include <utility>

#include <pounding/core/error.hpp>
#include <pounding/model/model.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>

namespace pounding {

/// What a run writes, whom it tells, and what it goes on from.
struct RunOptions {
  std::string output = {};   ///< results file, rewritten while the run goes on; empty for none
  std::string command = {};  ///< as the user typed it, for the results file
  /// Called now and then with the simulated time [s], the duration [s] and the number of impacts so far.
  std::function<void(double, double, int)> progress = {};
  /// Asked as often; the run ends as a failed one, with what was computed in the file, when it answers true.
  std::function<bool()> stop = {};
  /// Results file of a run of this model that was killed, stopped, or cut by -pounding_ts_max_steps: the run goes on from
  /// its last checkpoint, and gives the bits of a run that was never stopped.
  std::string resume = {};
};

/// What a run that has ended leaves.
struct Outcome {
  Results results;
  Summary summary;
};

/// A run that stopped before its end, with what it had computed until then.
class FailedRun : public SolverError {
 public:
  FailedRun(const std::string& reason, Outcome outcome) : SolverError(reason), outcome_(std::move(outcome)) {}
  /// What was computed until then.
  const Outcome& outcome() const { return outcome_; }

 private:
  Outcome outcome_;
};

/// All processes of PETSC_COMM_WORLD run one model together, each with the same arguments; the first one writes.
///
/// Runs a model once: its contacts keep the history of their impacts. PETSc must be running (petsc::Environment).
/// With an output, whatever ends it early but a failed solve leaves a file that `resume` takes.
/// Throws FailedRun when the solve fails or is stopped, after the results so far were written with the reason; InputError
/// for a place that cannot be written, for PETSc options that are wrong or that nothing reads, and for a run that cannot be
/// continued (read_interrupted_run, check_same_run); std::logic_error for a
/// model that was run before or is not complete.
Outcome run(const Model& model, const RunOptions& options = {});
/// Completes the model first; throws ModelError where that fails.
inline Outcome run(Model& model, const RunOptions& options = {}) {
  model.complete();
  return run(std::as_const(model), options);
}

}  // namespace pounding
