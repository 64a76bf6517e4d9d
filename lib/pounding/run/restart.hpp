#pragma once
/// Reads interrupted runs. The checkpoint is in the results file, together with the histories up to it.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <pounding/results/file_image.hpp>

namespace pounding {

class Input;
class Model;
struct Results;

/// A checkpoint without a state, for a run of this model with these PETSc options.
Checkpoint checkpoint_of(const Model& model, const std::vector<std::string>& options);

/// An unfinished run, as read from its results file.
struct InterruptedRun {
  std::string file;                ///< its results file
  std::string model_yaml = {};     ///< the input as given
  std::string resolved_yaml = {};  ///< the input with all defaults filled in
  /// True if the first part of `compare: no_pounding`, the run without links, was interrupted; the checkpoint and the
  /// histories belong to that part.
  bool without_links = false;
  std::function<void(std::int64_t file)> add_no_pounding = {};  ///< Results::add_no_pounding
  Checkpoint checkpoint = {};
  int deeper = 0;  ///< Results::deeper
};

/// Reads an interrupted run except for its histories. Throws InputError if the file is not a results file, is damaged,
/// was written by another version or has no checkpoint, or if the run is done.
InterruptedRun read_interrupted_run(const std::string& file);

/// The input in the results file; messages name the file from which it was originally read. Throws InputError if the
/// model was built by a program.
Input input_of(const InterruptedRun& run);

/// Adds the PETSc options of the interrupted run ("-pounding_ts_rtol 1e-6") to `options`, the arguments of a command
/// line, unless they are already present.
void add_earlier_options(const InterruptedRun& run, std::vector<std::string>& options);

/// Throws InputError, naming the difference, if the model, its ground motion or the options differ from those of the
/// run.
void check_same_run(const InterruptedRun& run, const Model& model, const std::vector<std::string>& options);

/// Fills the histories of all structures and links in `results` from the file. Throws InputError if they are damaged.
void read_histories(const InterruptedRun& run, Results& results);

}  // namespace pounding
