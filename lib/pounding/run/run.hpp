#pragma once
/// Runs a model through time and records what happens.

#include <petscsys.h>

#include <functional>
#include <string>
#include <utility>

#include <pounding/core/error.hpp>
#include <pounding/model/model.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>

namespace pounding {

/// How a model is run. Tolerance, scheme and steps are no part of this: they are the model's (Model::analysis), and
/// PETSc options with the prefix -pounding_ have the last word on them.
struct RunOptions {
  /// The processes that run the model together. Several models may run at once on communicators that share no process.
  /// PETSC_COMM_WORLD is set by PETSc's start, so make the options after it (petsc::Environment).
  MPI_Comm comm = PETSC_COMM_WORLD;
  std::string output = {};   ///< results file, rewritten while the run goes on; empty for none
  std::string command = {};  ///< command line that the results file tells
  /// Called about ten times a second between two steps with the simulated time [s], the duration [s] and the number of
  /// impacts.
  std::function<void(double, double, int)> progress = {};
  /// Polled between steps, some fifty times a second. Returning true on one process stops the run: results so far are
  /// written, with a checkpoint, and FailedRun is thrown.
  std::function<bool()> stop = {};
  /// Results file of an interrupted run of this model: one that was killed, stopped, or cut by -pounding_ts_max_steps.
  /// The run continues from its last checkpoint and gives the same bits as a run without interruption. Empty for a run
  /// from the start.
  std::string resume = {};
  /// Only the numbers of the summary are asked for: results are without the texts of the model, the JSON, the run
  /// without links, and warnings.
  bool numbers_only = false;
};

/// Results of a run in memory.
struct Outcome {
  Results results;
  Summary summary;
  bool resumable = false;  ///< a run that ended early left a state to continue from in its results file
};

/// A run that ended early.
class FailedRun : public SolverError {
 public:
  FailedRun(const std::string& reason, Outcome outcome) : SolverError(reason), outcome_(std::move(outcome)) {}
  /// The results until the failure.
  const Outcome& outcome() const { return outcome_; }

 private:
  Outcome outcome_;
};

/// Runs a model once; its contacts keep the history of their impacts. With `compare: no_pounding` the model is first
/// run without its links.
///
/// Collective on `options.comm`: all processes pass the same arguments, and the first one writes the file. PETSc must
/// be running. A run that ended early for any reason but a failed solve leaves a file that `resume` takes.
///
/// Throws
///   FailedRun         when the solve fails or is stopped, after the results so far and the reason were written
///   InputError        for a file that cannot be written, for PETSc options that are wrong or that nothing reads, for a
///   run that
///                     cannot be resumed (read_interrupted_run, check_same_run), and for models or records that differ
///                     between processes
///   std::logic_error  for a model that has been run or is not complete, and for options made before PETSc's start
Outcome run(const Model& model, const RunOptions& options = {});
/// Completes the model first; throws ModelError where that fails.
inline Outcome run(Model& model, const RunOptions& options = {}) {
  model.complete();
  return run(std::as_const(model), options);
}

}  // namespace pounding
