#pragma once
/// Writes the results file of a run, with checkpoints, while the run goes on.

#include <petscts.h>

#include <functional>
#include <string>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/petsc/ranks.hpp>
#include <pounding/recording/recorder.hpp>
#include <pounding/reduction/reduce.hpp>
#include <pounding/run/implausible.hpp>
#include <pounding/run/reduction_report.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/run/run.hpp>
#include <pounding/run/stopwatch.hpp>

namespace pounding {

/// Writes results where they belong; called on the first process alone.
using WriteResults = std::function<void(const Results&)>;

/// The results file of one run, and the state between two steps that goes into it. All functions but those that are
/// const are collective.
class RunWriter {
 public:
  /// `write` is empty for a run that leaves no file; `since_start` runs since the beginning of the run. All other
  /// arguments must outlive this.
  RunWriter(const Model& model, const RunOptions& options, WriteResults write, TS ts, const Stepper& stepper,
            Recorder& recorder, ReductionReport& reduction, Outcome& outcome, const Stopwatch& since_start,
            const petsc::ReductionPlan& plan);

  /// Takes up an interrupted run: its histories and its state. Throws InputError when they do not fit.
  void restart(const InterruptedRun& run);
  /// Makes the present state, between two steps, the checkpoint of the results. Leaves the earlier one where TSAdapt
  /// hides a part of the state, and does nothing without an output.
  void save();
  /// Writes the results so far with a status. Does nothing without an output.
  void write(const std::string& status);
  /// Whether the file is due to be written: by the checkpoints that the model asks for, else often enough for writing
  /// to take a small part of the run.
  bool is_due() const;
  /// Completes the summary with the last status, and writes the results where there is an output.
  void end(const std::string& status);
  /// Wall time of the run, parts before an interruption included [s].
  double seconds() const { return earlier_seconds_ + since_start_.seconds(); }

 private:
  void archive(Archive& archive);
  void conclude(const std::string& status);
  std::vector<std::byte> own_part(const std::vector<std::byte>& saved) const;

  petsc::Ranks ranks_;
  const Model& model_;
  const RunOptions& options_;
  WriteResults write_results_;
  TS ts_;
  const Stepper& stepper_;
  Recorder& recorder_;
  ReductionReport& reduction_;
  Outcome& outcome_;
  const std::vector<std::string> warnings_ =
      options_.numbers_only ? std::vector<std::string>{} : implausible(model_, stepper_.options().tolerance);
  Checkpoint origin_;  // without a state
  Stopwatch since_start_, since_write_ = since_start_;
  const petsc::ReductionPlan& plan_;
  double earlier_seconds_ = 0;  // before the interruption
  double write_cost_ = 0;       // of the last write [s]
  double written_time_ = 0;     // simulated time of the last write [s]
};

}  // namespace pounding
