#pragma once
/// What a run that was stopped goes on from. It lies in the results file, together with the histories up to then.

#include <string>
#include <vector>

#include <pounding/results/checkpoint.hpp>

namespace pounding {

class Input;
struct Model;
struct Results;

/// A checkpoint without a state for a run of this model with these options of PETSc's.
Checkpoint checkpoint_of(const Model& model, const std::vector<std::string>& options);

/// A run that has not ended, as its results file tells it.
struct InterruptedRun {
  std::string file;
  std::string model_yaml = {}, resolved_yaml = {};
  std::string histories = {};  ///< their fingerprint
  Checkpoint checkpoint = {};
};

/// Throws InputError for a file that is no results file, is damaged, was written by another version of the program, whose
/// run is done, or that holds no checkpoint.
InterruptedRun read_interrupted_run(const std::string& file);

/// The input that the file of a run holds, under the name of the one that it was read from. Throws InputError for the run of a
/// model that was built by code.
Input input_of(const InterruptedRun& run);

/// Options of the run's beginning ("-pounding_ts_rtol 1e-6") hold for the rest of it without being typed again: adds those that
/// are missing in `options`, words of a command line.
void add_earlier_options(const InterruptedRun& run, std::vector<std::string>& options);

/// Throws InputError, with what differs, unless the model, the data that it reads and the options are those of the run.
void check_same_run(const InterruptedRun& run, const Model& model, const std::vector<std::string>& options);

/// Fills the histories of the structures and links that `results` names. Throws InputError when they are damaged.
void read_histories(const InterruptedRun& run, Results& results);

}  // namespace pounding
