#pragma once
/// Monitors the run between its steps: records them, reports progress, stops on request and has the results file
/// written.

#include <petscts.h>

#include <string>

#include <pounding/petsc/ranks.hpp>
#include <pounding/recording/recorder.hpp>
#include <pounding/run/reduction_report.hpp>
#include <pounding/run/run.hpp>
#include <pounding/run/run_writer.hpp>
#include <pounding/run/stopwatch.hpp>

namespace pounding {

/// Drives one TS to its end.
class RunMonitor {
 public:
  /// `duration` of the run [s]; `since_start` measures the time since the beginning. All other arguments must outlive
  /// this object.
  RunMonitor(const RunOptions& options, double duration, const Stopwatch& since_start, TS ts, const StepView& stepper,
             Recorder& recorder, ReductionReport& reduction, RunWriter& writer);

  /// Runs TSSolve. Returns the reason if the run ended before its duration; empty otherwise.
  std::string solve();
  /// After the run, checks the reduction in the strongest impacts if requested. Returns the reason if the check ended
  /// early; empty otherwise.
  std::string check_reduction();
  /// True if a run that ended early can be resumed: it was stopped or reached a limit on steps.
  bool is_resumable() const { return resumable_; }
  /// Description of the collapse that ended the run, which is not a failure; empty if there is none.
  const std::string& collapse() const { return collapse_; }

 private:
  static PetscErrorCode after_step(TS ts);
  void look();
  void end_at_collapse();
  std::string early_end();
  int steps_until_next_look() const;

  petsc::Ranks ranks_;
  const RunOptions& options_;
  double duration_;
  TS ts_;
  const StepView& stepper_;
  Recorder& recorder_;
  ReductionReport& reduction_;
  RunWriter& writer_;
  Stopwatch since_report_, since_look_;
  int steps_between_looks_ = 1, steps_to_look_ = 1;
  bool resumable_ = false;
  std::string collapse_;
};

}  // namespace pounding
