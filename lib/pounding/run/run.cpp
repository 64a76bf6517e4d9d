#include <pounding/run/run.hpp>

#include <ctime>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/chrono.h>

#include <pounding/core/archive.hpp>
#include <pounding/core/version.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/petsc/ranks.hpp>
#include <pounding/recording/recorder.hpp>
#include <pounding/reduction/reduced_solver.hpp>
#include <pounding/reports/assumptions.hpp>
#include <pounding/results/replaced_file.hpp>
#include <pounding/run/reduction_plan.hpp>
#include <pounding/run/reduction_report.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/run/run_monitor.hpp>
#include <pounding/run/run_writer.hpp>
#include <pounding/run/separation.hpp>
#include <pounding/run/stopwatch.hpp>
#include <pounding/run/ts_setup.hpp>
#include <pounding/stepping/stepper.hpp>
#include <pounding/stepping/ts_pounding.hpp>

namespace pounding {
namespace {

// Next depth if the error estimates are too large: two more blocks in both chains, and larger increments at greater
// depth, since light damping needs many blocks.
int still_deeper(int deeper) { return deeper + 2 + deeper / 2; }

void fill_statistics(TS ts, const StepView& stepper, SolverStatistics& solver) {
  const LibraryLock lock;
  PetscInt steps = 0, rejected = 0;
  petsc::check(TSGetStepNumber(ts, &steps));
  petsc::check(TSGetStepRejections(ts, &rejected));
  solver.steps = steps;
  solver.rejected = rejected;
  solver.events = stepper.events();
  solver.iterations = stepper.iterations();
}

// A model and its settings, for the runs with and without links.
struct Task {
  const Model& model;
  const RunOptions& options;
  EffectiveSettings settings;
  WriteResults write;  // empty if no file is written
  Results heading;     // without histories and end state
  std::string model_json = options.numbers_only ? "" : assumptions_json(model);

  // An outcome before its run.
  Outcome outcome() const {
    Outcome made{heading, {}};
    made.summary.model_json = model_json;
    made.summary.tolerance = settings.stepper.tolerance;
    made.summary.duration = settings.duration;
    return made;
  }
};

Results heading(const Model& model, const RunOptions& options, const EffectiveSettings& settings) {
  Results results;
  results.version = POUNDING_VERSION;
  results.created = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  results.title = model.title;
  results.command = options.command;
  results.model_yaml = model.source_text;
  if (!options.numbers_only) results.resolved_yaml = resolved_yaml(model);
  results.integrator = settings.stepper.scheme.name();
  return results;
}

// `without`: outcome of the run without links; null if there is none. Automatic reductions get `deeper` more blocks
// than the tolerance requires. Returns nullopt if they need even more: then no end was written.
std::optional<Outcome> try_run(const Task& task, bool with_links, const std::shared_ptr<const Outcome>& without,
                               int deeper, const Stopwatch& since_start, const InterruptedRun* earlier) {
  const Model& model = task.model;
  const RunOptions& options = task.options;
  const EffectiveSettings& settings = task.settings;
  Outcome outcome = task.outcome();
  Results& results = outcome.results;
  if (without) {
    outcome.summary.without_pounding = without->summary.structures;
    outcome.summary.without_links_status = without->results.status;
    outcome.summary.separations = separations(model, without->results.approach);
    if (!options.numbers_only) results.add_no_pounding = group_without_links({without, &without->results});
  }

  const System system = assemble(model, with_links);
  const auto [u, v] = initial_state(model, with_links);
  const std::vector<Reduction> requested = requested_reductions(model);
  const std::string cache_folder = mode_cache_folder();
  const TsSetup setup = set_up_ts(settings, u, v, options.comm);
  petsc::ReductionPlan plan = reduction_plan(model, requested, u, v, settings.stepper.tolerance);
  plan.deeper = results.deeper = deeper;
  plan.cache_folder = cache_folder;
  if (plan.requested && settings.solver != petsc::SolverKind::automatic)
    throw InputError("a reduction has no effect with -pounding_ts_pounding_base; omit one of the two");
  const std::unique_ptr<StructureSolver> solver = petsc::make_solver(system, settings.solver, plan, options.comm);
  Stepper stepper(system, *solver, settings.stepper);
  petsc::check(petsc::set_stepper(setup.ts, &stepper));
  petsc::check(petsc::set_lazy_vectors(setup.ts, PETSC_TRUE));
  stepper.start(0, u, v);
  stepper.prepare(stepper.view().step_towards(settings.first_step, settings.duration));
  refuse_unread_options(true);

  Recorder recorder(model, stepper.view(), results);
  ReductionReport reduction(model, recorder.response(), stepper.view());
  RunWriter writer(model, options, task.write, setup.ts, stepper.view(), recorder, reduction, outcome, since_start,
                   plan);
  if (earlier)
    writer.restart(*earlier);
  else
    recorder.begin();
  results.solver.wall_setup += since_start.seconds();
  writer.save();
  writer.write("running");

  RunMonitor monitor(options, settings.duration, since_start, setup.ts, stepper.view(), recorder, reduction, writer);
  std::string failure = monitor.solve();
  if (failure.empty() && reduction.check.is_requested()) {  // may take long, and can be stopped
    writer.save();
    writer.write("running");
  }
  recorder.end();
  reduction.errors.end();
  fill_statistics(setup.ts, stepper.view(), results.solver);
  results.solver.wall_seconds = writer.seconds();
  results.solver.wall_solve = results.solver.wall_seconds - results.solver.wall_setup - results.solver.wall_output;
  if (failure.empty()) {
    recorder.summarize(outcome.summary);
    reduction.summarize(outcome.summary);
    if (must_be_deeper(plan, outcome.summary.reduced)) return std::nullopt;
    failure = monitor.check_reduction();
  }
  if (!monitor.is_resumable()) results.checkpoint.reset();
  outcome.resumable = results.checkpoint.has_value();
  const std::string done = monitor.collapse().empty() ? "done" : "done: " + monitor.collapse();
  writer.end(failure.empty() ? done : "failed: " + failure);
  if (!failure.empty()) throw FailedRun(failure, std::move(outcome));
  return outcome;
}

Outcome run_once(const Task& task, bool with_links, const std::shared_ptr<const Outcome>& without,
                 const InterruptedRun* earlier = nullptr) {
  const Stopwatch since_start;
  for (int deeper = earlier ? earlier->deeper : 0;; deeper = still_deeper(deeper), earlier = nullptr)
    if (std::optional<Outcome> outcome = try_run(task, with_links, without, deeper, since_start, earlier))
      return std::move(*outcome);
}

// Outcome to write while the run without links has these results.
Outcome first_part(const Task& task, const std::shared_ptr<const Results>& without_links) {
  Outcome outcome = task.outcome();
  Results& results = outcome.results;
  results.add_no_pounding = group_without_links(without_links);
  const std::string failed = "failed: ";
  if (!without_links->status.starts_with(failed)) return outcome;
  results.status = outcome.summary.status =
      failed + "(the run without links) " + without_links->status.substr(failed.size());
  outcome.summary.integrator = results.integrator;
  results.summary_json = to_json(outcome.summary);
  outcome.resumable = without_links->checkpoint.has_value();
  return outcome;
}

// The run without links of `compare: no_pounding`. Its results are included in the output of the subsequent run.
std::shared_ptr<const Outcome> run_without_links(const Task& task, const InterruptedRun* earlier = nullptr) {
  Task part = task;
  part.heading.command.clear();
  // Its end has no state to resume from: until the run with links has one, the file keeps the previous one.
  if (task.write)
    part.write = [&](const Results& results) {
      if (results.status.starts_with("done")) return;
      task.write(first_part(task, {std::shared_ptr<void>{}, &results}).results);  // not owned
    };
  try {
    return std::make_shared<const Outcome>(run_once(part, false, {}, earlier));
  } catch (const FailedRun& failed) {
    throw FailedRun(fmt::format("the run without links: {}", failed.what()),
                    first_part(task, std::make_shared<const Results>(failed.outcome().results)));
  }
}

// With different models the processes would deadlock.
void require_same_model(const petsc::Ranks& ranks, const Model& model) {
  if (!ranks.same(model.source_text + checkpoint_of(model, {}).ground))
    throw InputError(
        fmt::format("{}: the processes read different models or records; type files that all processes can read",
                    model.source_file.empty() ? "the model" : model.source_file));
}

}  // namespace

Outcome run(const Model& model, const RunOptions& options) {
  if (options.comm == MPI_COMM_NULL)
    throw std::logic_error("RunOptions::comm is null; create the options after PETSc is initialized");
  if (!model.is_complete()) throw std::logic_error("this model is not complete; call its complete() first");
  const petsc::Ranks ranks(options.comm);
  const petsc::CollectiveRun collective(ranks);
  require_same_model(ranks, model);
  ReplacedFile file(options.output);
  const EffectiveSettings settings = effective_settings(model);
  Task task{model, options, settings, {}, heading(model, options, settings)};
  if (!options.output.empty()) {
    ranks.on_root([&] { file.require_free(); });
    task.write = [&](const Results& results) { file.replace(results_image(results)); };
  }
  if (options.resume.empty()) {
    std::shared_ptr<const Outcome> without_links;
    if (model.compare_no_pounding) without_links = run_without_links(task);
    return run_once(task, true, without_links);
  }
  const InterruptedRun earlier = read_interrupted_run(options.resume);
  check_same_run(earlier, model, petsc::Environment::given_options());
  if (!earlier.without_links) return run_once(task, true, {}, &earlier);
  return run_once(task, true, run_without_links(task, &earlier));
}

}  // namespace pounding
