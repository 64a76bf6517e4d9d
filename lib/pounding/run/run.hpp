#pragma once
/// Time history analysis of a model.

#include <petscsys.h>

#include <functional>
#include <span>
#include <string>
#include <utility>

#include <pounding/core/error.hpp>
#include <pounding/model/model.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>

namespace pounding {

/// Options of a run. Tolerance, scheme and steps are part of the model (Model::analysis); PETSc options with the prefix
/// -pounding_ override them.
struct RunOptions {
  /// The processes that run the model together. Several models may run simultaneously on communicators that share no
  /// process, and in several threads of one process on communicators of one process each, such as PETSC_COMM_SELF.
  /// PETSC_COMM_WORLD is set by PetscInitialize(), so create the options after it (petsc::Environment).
  MPI_Comm comm = PETSC_COMM_WORLD;
  std::string output = {};   ///< results file, updated during the run; empty for none
  std::string command = {};  ///< command line to store in the results file
  /// Called about ten times per second between two steps with the simulated time [s], the duration [s] and the number
  /// of impacts, in the thread of the run and without LibraryLock.
  std::function<void(double, double, int)> progress = {};
  /// Polled between steps, about fifty times per second, with the contacts at that time, none in the run without links.
  /// Returning true on one process stops the run: results up to that time are written with a checkpoint, and FailedRun
  /// is thrown. Called as `progress` is.
  std::function<bool(std::span<const ContactMemory> contacts)> stop = {};
  /// Results file of an interrupted run of this model: killed, stopped, or ended by -pounding_ts_max_steps. The run
  /// resumes from its last checkpoint and is bitwise identical to an uninterrupted run. Empty to run from the start.
  std::string resume = {};
  /// Compute numeric summary values only; skip model text, JSON, the run without links and warnings.
  bool numbers_only = false;
};

/// Results of a run in memory.
struct Outcome {
  Results results;
  Summary summary;
  bool resumable = false;  ///< true if a run that ended early can be resumed from its results file
};

/// A run that ended early.
class FailedRun : public SolverError {
 public:
  FailedRun(const std::string& reason, Outcome outcome) : SolverError(reason), outcome_(std::move(outcome)) {}
  /// Results up to the failure.
  const Outcome& outcome() const { return outcome_; }

 private:
  Outcome outcome_;
};

/// Runs the model, which it does not change: repeated runs give identical results. With `compare: no_pounding`, the
/// model is first run without its links.
///
/// Collective on `options.comm`: all processes pass the same arguments, and the first one writes the file. PETSc must
/// be initialized. If a run ended early for any reason except a failed solve, its file can be resumed.
///
/// Several threads may run models concurrently, each with its own output file. They proceed in parallel except in
/// PETSc, SLEPc, MPI and HDF5 (LibraryLock): modal solvers, contacts and springs gain, factorizations do not. If the
/// host initializes MPI, it requests MPI_THREAD_SERIALIZED. Options of PETSc apply to all runs of the process.
///
/// Throws
///   FailedRun         if the solve fails or is stopped, after the results and the reason have been written
///   InputError        if the file cannot be written, a PETSc option is invalid or unused, the run cannot be resumed
///                     (read_interrupted_run, check_same_run), or models or records differ between processes
///   std::logic_error  if the model is not complete, the options were created before PETSc was initialized, or this
///                     process already runs a model together with other processes
Outcome run(const Model& model, const RunOptions& options = {});
/// Completes the model first; throws ModelError on failure.
inline Outcome run(Model& model, const RunOptions& options = {}) {
  model.complete();
  return run(std::as_const(model), options);
}

}  // namespace pounding
