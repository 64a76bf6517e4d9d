#pragma once
/// Writes the results file of a run, with checkpoints, during the run.

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

/// Writes results to their destination; called on the first process only.
using WriteResults = std::function<void(const Results&)>;

/// The results file of one run, including the state between two steps. All non-const functions are collective.
class RunWriter {
 public:
  /// `write` is empty for a run without a file; `since_start` measures the time since the beginning of the run. All
  /// other arguments must outlive this object.
  RunWriter(const Model& model, const RunOptions& options, WriteResults write, TS ts, const StepView& stepper,
            Recorder& recorder, ReductionReport& reduction, Outcome& outcome, const Stopwatch& since_start,
            const petsc::ReductionPlan& plan);

  /// Resumes an interrupted run: its histories and its state. Throws InputError if they do not match.
  void restart(const InterruptedRun& run);
  /// Makes the present state, between two steps, the checkpoint of the results. Keeps the earlier one if the TSAdapt
  /// type has internal state. Does nothing without an output.
  void save();
  /// Writes the current results with a status. Does nothing without an output.
  void write(const std::string& status);
  /// True if the file is due to be written: at the checkpoints requested by the model, otherwise as often as a small
  /// fraction of the run time allows.
  bool is_due() const;
  /// Completes the summary with the last status, and writes the results if there is an output.
  void end(const std::string& status);
  /// Wall time of the run, including the time before an interruption [s].
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
  const StepView& stepper_;
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
