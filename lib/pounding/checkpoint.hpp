#pragma once
/// What a run that was stopped goes on from. It lies in the results file, together with the histories up to then.

#include <cstddef>
#include <string>
#include <vector>

namespace pounding {

class Input;
struct Model;
struct Results;

/// The state between two steps, and what must be the same for the same bits to follow.
struct Checkpoint {
  std::string model_file;            ///< of the input, absolute; relative paths in it start from its folder
  std::vector<std::string> options;  ///< PETSc's that the result depends on, sorted: "-pounding_ts_rtol 1e-6"
  std::string ground;                ///< fingerprint of the record's samples; empty for a closed form
  std::vector<std::byte> state;      ///< stepper, TS and recorder (Archive)
};

/// A checkpoint without a state for a run of this model with these options of PETSc's.
Checkpoint checkpoint_of(const Model& model, const std::vector<std::string>& options);

/// Fingerprint of a checkpoint and of the input beside it, by which read_stopped_run() finds damage.
std::string fingerprint(const Checkpoint& checkpoint, const std::string& model_yaml, const std::string& resolved_yaml);

/// A run that has not ended, as its results file tells it.
struct StoppedRun {
  std::string file;
  std::string model_yaml = {}, resolved_yaml = {};
  std::string histories = {};  ///< their fingerprint
  Checkpoint checkpoint = {};
};

/// Throws InputError for a file that is no results file, is damaged, was written by another version of the program, whose
/// run is done, or that holds no checkpoint.
StoppedRun read_stopped_run(const std::string& file);

/// The input that the file of a run holds, under the name of the one that it was read from.
Input input_of(const StoppedRun& run);

/// Options of the run's beginning ("-pounding_ts_rtol 1e-6") hold for the rest of it without being typed again: adds those that
/// are missing in `options`, words of a command line.
void add_earlier_options(const StoppedRun& run, std::vector<std::string>& options);

/// Throws InputError, with what differs, unless the model, the data that it reads and the options are those of the run.
void check_same_run(const StoppedRun& run, const Model& model, const std::vector<std::string>& options);

/// Fills the histories of the structures and links that `results` names. Throws InputError when they are damaged.
void read_histories(const StoppedRun& run, Results& results);

}  // namespace pounding
