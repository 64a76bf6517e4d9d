#include <pounding/run/run_monitor.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/petsc/version.hpp>

namespace pounding {
namespace {

// The clock is read every few steps only. A launcher (mpirun) kills one second after its request to stop, so the
// interval must be much shorter.
constexpr double seconds_between_looks = 0.02;
constexpr int max_steps_between_looks = 256;
constexpr double seconds_between_reports = 0.1;

}  // namespace

RunMonitor::RunMonitor(const RunOptions& options, double duration, const Stopwatch& since_start, TS ts,
                       const StepView& stepper, Recorder& recorder, ReductionReport& reduction, RunWriter& writer)
    : ranks_(options.comm),
      options_(options),
      duration_(duration),
      ts_(ts),
      stepper_(stepper),
      recorder_(recorder),
      reduction_(reduction),
      writer_(writer),
      since_report_(since_start) {}

std::string RunMonitor::solve() {
  const LibraryLock lock;
  petsc::check(TSSetApplicationContext(ts_, this));
  petsc::check(TSSetPostStep(ts_, after_step));
  try {
    petsc::check(TSSolve(ts_, nullptr));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return early_end();
}

std::string RunMonitor::check_reduction() {
  try {
    for (bool more = reduction_.check.is_requested(); more;) {
      ranks_.on_each([&] { more = reduction_.check.next(); });
      if (!more || !ranks_.any(options_.stop && options_.stop(stepper_.memory().contacts))) continue;
      resumable_ = true;
      return "stopped by the user during the check of the reduction";
    }
  } catch (const SolverError& error) {
    return fmt::format("the check of the reduction failed: {}", error.what());
  }
  return "";
}

PetscErrorCode RunMonitor::after_step(TS ts) {
  RunMonitor* monitor = nullptr;
  PetscFunctionBegin;
  PetscCall(TSGetApplicationContext(ts, &monitor));
  try {
    const LibraryLock::Released released;
    monitor->reduction_.step(monitor->recorder_.step());
    monitor->end_at_collapse();
    if (--monitor->steps_to_look_ == 0) monitor->look();
  } catch (...) {
    PetscFunctionReturn(petsc::fail());
  }
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

void RunMonitor::end_at_collapse() {
  const Collapse& collapse = recorder_.collapse();
  if (!collapse.is_requested() || !ranks_.any(collapse.has_come())) return;
  collapse_ = collapse.text(stepper_.time());
  const LibraryLock lock;
  petsc::check(TSSetConvergedReason(ts_, TS_CONVERGED_USER));
}

void RunMonitor::look() {
  if (ranks_.any(options_.stop && options_.stop(stepper_.memory().contacts))) {
    writer_.save();
    resumable_ = true;
    throw SolverError(fmt::format("stopped by the user at t = {:.6g} s", stepper_.time()));
  }
  if (options_.progress && since_report_.seconds() > seconds_between_reports) {
    since_report_.restart();
    options_.progress(stepper_.time(), duration_, recorder_.impacts());
  }
  if (ranks_.from_root(writer_.is_due())) {
    writer_.save();
    writer_.write("running");
  }
  steps_to_look_ = steps_between_looks_ = ranks_.from_root(steps_until_next_look());
  since_look_.restart();
}

int RunMonitor::steps_until_next_look() const {
  const double steps = steps_between_looks_ * seconds_between_looks / std::max(since_look_.seconds(), 1e-9);
  return static_cast<int>(std::clamp(steps, 1.0, 1.0 * max_steps_between_looks));
}

// A limit on steps (analysis.max_steps, -pounding_ts_max_steps) ends a TS without an error.
std::string RunMonitor::early_end() {
  if (!collapse_.empty() || stepper_.time() >= duration_ * (1 - 1e-12)) return "";
  TSConvergedReason reason = TS_CONVERGED_ITERATING;
  PetscInt steps = 0;
  petsc::check(TSGetConvergedReason(ts_, &reason));
  petsc::check(TSGetStepNumber(ts_, &steps));
  resumable_ = reason == TS_CONVERGED_ITS;
  if (resumable_) writer_.save();
  return fmt::format("the time stepping ended at t = {:.6g} s of {:.6g} s ({})", stepper_.time(), duration_,
                     resumable_
                         ? fmt::format("{}: the limit of {} steps was reached", TSConvergedReasons[reason], steps)
                         : std::string(TSConvergedReasons[reason]));
}

}  // namespace pounding
