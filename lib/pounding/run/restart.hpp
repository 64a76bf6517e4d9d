#pragma once
/// Reading of interrupted runs. Their checkpoint lies in the results file, together with the histories up to it.

#include <string>
#include <vector>

#include <pounding/results/file_image.hpp>

namespace pounding {

class Input;
class Model;
struct Results;

/// A checkpoint, still without a state, for a run of this model with these PETSc options.
Checkpoint checkpoint_of(const Model& model, const std::vector<std::string>& options);

/// A run that has not come to its end, as read from its results file.
struct InterruptedRun {
  std::string file;                ///< its results file
  std::string model_yaml = {};     ///< the input as given
  std::string resolved_yaml = {};  ///< the input with all defaults filled in
  /// Whether `compare: no_pounding` was interrupted in its first part, the run without links: the checkpoint and the
  /// histories are its.
  bool without_links = false;
  FileImage no_pounding = {};  ///< image of its run without links; empty for none
  Checkpoint checkpoint = {};
  int deeper = 0;  ///< Results::deeper
};

/// Reads all of an interrupted run but its histories. Throws InputError for a file that is no results file, is damaged,
/// was written by another version of the program, holds no checkpoint, or whose run is done.
InterruptedRun read_interrupted_run(const std::string& file);

/// The input in the results file; messages name the file from which it was first read. Throws InputError for the run of
/// a model that was built by code.
Input input_of(const InterruptedRun& run);

/// Adds the PETSc options with which the run began ("-pounding_ts_rtol 1e-6") to `options`, the words of a command
/// line, unless they are there: nobody needs to type them again.
void add_earlier_options(const InterruptedRun& run, std::vector<std::string>& options);

/// Throws InputError, naming the difference, unless the model, its ground motion and the options are those of the run.
void check_same_run(const InterruptedRun& run, const Model& model, const std::vector<std::string>& options);

/// Fills the histories of all structures and links in `results` from the file. Throws InputError when they are damaged.
void read_histories(const InterruptedRun& run, Results& results);

}  // namespace pounding
