#include <pounding/run/run_writer.hpp>

#include <utility>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/run/reduction_plan.hpp>
#include <pounding/stepping/ts_pounding.hpp>

namespace pounding {
namespace {

// Fraction of the run time that writing the file may take.
constexpr double output_share = 0.05;
constexpr double seconds_between_writes = 1;

}  // namespace

RunWriter::RunWriter(const Model& model, const RunOptions& options, WriteResults write, TS ts, const StepView& stepper,
                     Recorder& recorder, ReductionReport& reduction, Outcome& outcome, const Stopwatch& since_start,
                     const petsc::ReductionPlan& plan)
    : ranks_(options.comm),
      model_(model),
      options_(options),
      write_results_(std::move(write)),
      ts_(ts),
      stepper_(stepper),
      recorder_(recorder),
      reduction_(reduction),
      outcome_(outcome),
      origin_(checkpoint_of(model, petsc::Environment::given_options())),
      since_start_(since_start),
      plan_(plan) {}

// The state between two steps except the histories. Of the statistics, only the run times are stored here; the stepper
// and the TS store the others.
void RunWriter::archive(Archive& archive) {
  outcome_.results.solver.wall_seconds = seconds();
  archive(outcome_.results.solver);
  petsc::check(petsc::archive(ts_, archive));
  recorder_.archive(archive);
  reduction_.archive(archive);
  archive(outcome_.summary.without_pounding, outcome_.summary.without_links_status, outcome_.summary.separations);
}

void RunWriter::save() {
  if (!write_results_) return;
  Archive state;
  try {
    archive(state);
  } catch (const SolverError&) {
    return;
  }
  outcome_.results.checkpoint = origin_;
  Archive all;
  std::vector<std::vector<std::byte>> parts = ranks_.gather(state.bytes());
  all(parts);
  outcome_.results.checkpoint->state = all.bytes();
}

// The part of a saved state that belongs to this process.
std::vector<std::byte> RunWriter::own_part(const std::vector<std::byte>& saved) const {
  Archive all(saved);
  std::vector<std::vector<std::byte>> parts;
  all(parts);
  if (static_cast<int>(parts.size()) != ranks_.size())
    throw InputError(fmt::format("it was started with {} process{}; type {}pounding run --resume {}", parts.size(),
                                 parts.size() == 1 ? "" : "es",
                                 parts.size() == 1 ? "" : fmt::format("mpirun -n {} ", parts.size()), options_.resume));
  return parts[ranks_.rank()];
}

void RunWriter::restart(const InterruptedRun& run) {
  read_histories(run, outcome_.results);
  try {
    Archive state(own_part(run.checkpoint.state));
    archive(state);
    state.expect_end();
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: the run cannot be resumed: {}", run.file, error.what()));
  }
  earlier_seconds_ = outcome_.results.solver.wall_seconds;
  outcome_.results.checkpoint = run.checkpoint;
  outcome_.results.add_no_pounding = run.add_no_pounding;
}

void RunWriter::conclude(const std::string& status) {
  Results& results = outcome_.results;
  Summary& summary = outcome_.summary;
  results.status = summary.status = status;
  recorder_.summarize(summary);
  reduction_.summarize(summary);
  summary.integrator = results.integrator;
  summary.solver = results.solver;
  results.reduced = summary.reduced;
  if (options_.numbers_only) return;
  results.options = summary.options = petsc::Environment::all_options();
  summary.warnings = warnings_;
  for (std::string& text : implausible(model_, summary)) summary.warnings.push_back(std::move(text));
  for (std::string& text : beyond_capacity(model_, summary)) summary.warnings.push_back(std::move(text));
  for (std::string& text : unseated(model_, summary)) summary.warnings.push_back(std::move(text));
  for (std::string& text : endless_bounces(model_, summary)) summary.warnings.push_back(std::move(text));
  for (std::string& text : reduction_warnings(plan_, summary.reduced)) summary.warnings.push_back(std::move(text));
  if (std::string text = warning(summary, stepper_.options().tolerance); !text.empty())
    summary.warnings.push_back(std::move(text));
  results.summary_json = to_json(summary);
}

void RunWriter::write(const std::string& status) {
  if (write_results_) end(status);
}

void RunWriter::end(const std::string& status) {
  const Stopwatch cost;
  conclude(status);
  if (!write_results_) return;
  recorder_.with_present_state([&] { ranks_.on_root([&] { write_results_(outcome_.results); }); });
  since_write_.restart();
  written_time_ = stepper_.time();
  write_cost_ = cost.seconds();
  outcome_.results.solver.wall_output += write_cost_;
}

bool RunWriter::is_due() const {
  const CheckpointSettings& requested = model_.checkpoint;
  const double since = since_write_.seconds();
  if (since <= write_cost_ / output_share) return false;
  if (!requested.requested()) return since > seconds_between_writes;
  return (requested.every > 0 && since >= requested.every) ||
         (requested.every_simulated > 0 && stepper_.time() - written_time_ >= requested.every_simulated);
}

}  // namespace pounding
