#include <pounding/run/run.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include <fmt/chrono.h>

#include <pounding/input/resolved.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/linear/make_solver.hpp>
#include <pounding/petsc/ranks.hpp>
#include <pounding/stepping/ts_pounding.hpp>
#include <pounding/petsc/version.hpp>
#include <pounding/run/recorder.hpp>
#include <pounding/stepping/stepper.hpp>
#include <pounding/core/version.hpp>

namespace pounding {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Steps may be this part of the fastest first period; the error control shortens them further.
constexpr double longest_part_of_period = 0.1;
constexpr double longest_part_of_duration = 1.0 / 16;
// A launcher (mpirun) kills a second after it asks to stop: looks at the clock are nearer to each other.
constexpr double seconds_between_looks = 0.02;
constexpr int max_steps_between_looks = 256;
constexpr double seconds_between_reports = 0.1;
// Writing the file may take this part of a run.
constexpr double output_share = 0.05;
constexpr double seconds_between_writes = 1;

double longest_step(const Model& model) {
  double longest = longest_part_of_duration * model.analysis.duration;
  if (model.analysis.max_step > 0) longest = std::min(longest, model.analysis.max_step);
  const GroundPlan ground = ground_plan(model);
  const double sample = ground.sample_step();
  if (sample > 0) return std::min(sample, model.analysis.max_step > 0 ? longest : model.analysis.duration);
  longest = std::min(longest, longest_part_of_period * ground.shortest_period());
  for (const Structure& s : model.structures) {
    if (s.is_rigid() || s.is_free) continue;
    longest = std::min(longest, longest_part_of_period * 2 * M_PI / s.frequencies[0]);
  }
  return longest;
}

// What the post-step of the TS works on.
struct Watch {
  petsc::Ranks ranks;
  TS ts;
  Stepper& stepper;
  Recorder& recorder;
  const Model& model;
  const RunOptions& options;
  Results& results;
  Summary& summary;
  Checkpoint origin;  // without a state
  Clock::time_point start;
  Clock::time_point last_report = start, last_write = start, last_look = Clock::now();
  double earlier_seconds = 0;  // before the run went on
  double write_cost = 0, written_time = 0;
  int steps_between_looks = 1, steps_to_look = 1;
  bool stopped = false;  // between two steps, with the state saved
  std::exception_ptr failure = nullptr;

  // Everything that moves between two steps but the histories, from the solver's statistics the run times only.
  void archive(Archive& archive) {
    results.solver.wall_seconds = earlier_seconds + seconds_since(start);
    archive(results.solver);
    petsc::check(petsc::archive(ts, archive));
    recorder.archive(archive);
    archive(summary.without_pounding);
  }

  // Keeps the present state, between two steps, for the file; there is none to keep when TSAdapt hides a part of it.
  void save() {
    if (options.output.empty()) return;
    Archive state;
    try {
      archive(state);
    } catch (const SolverError&) {
      return;
    }
    results.checkpoint = origin;
    Archive all;
    std::vector<std::vector<std::byte>> parts = ranks.gather(state.bytes());
    all(parts);
    results.checkpoint->state = all.bytes();
  }

  // What this process saved.
  std::vector<std::byte> own_part(const std::vector<std::byte>& saved) const {
    Archive all(saved);
    std::vector<std::vector<std::byte>> parts;
    all(parts);
    if (static_cast<int>(parts.size()) != ranks.size())
      throw InputError(fmt::format("it was made by {} process{}; type {}pounding run --resume {}", parts.size(),
                                   parts.size() == 1 ? "" : "es",
                                   parts.size() == 1 ? "" : fmt::format("mpirun -n {} ", parts.size()), options.resume));
    return parts[ranks.rank()];
  }

  void restart(const InterruptedRun& run) {
    read_histories(run, results);
    try {
      Archive state(own_part(run.checkpoint.state));
      archive(state);
      state.expect_end();
    } catch (const std::exception& error) {
      throw InputError(fmt::format("{}: the run cannot go on: {}", run.file, error.what()));
    }
    earlier_seconds = results.solver.wall_seconds;
    results.checkpoint = run.checkpoint;
  }

  // The summary of what there is so far.
  void conclude(const std::string& status) {
    results.status = summary.status = status;
    recorder.summarize(summary);
    summary.solver = results.solver;
    results.summary_json = to_json(summary);
  }

  void write(const std::string& status) {
    if (options.output.empty()) return;
    const Clock::time_point begin = Clock::now();
    conclude(status);
    recorder.with_present_state([&] { ranks.on_root([&] { write_results(results, options.output); }); });
    last_write = Clock::now();
    written_time = stepper.time();
    const double cost = std::chrono::duration<double>(last_write - begin).count();
    write_cost = cost;
    results.solver.wall_output += cost;
  }

  void write_running() {
    save();
    write("running");
  }

  bool write_is_due() const {
    const CheckpointSettings& wanted = model.checkpoint;
    const double since = seconds_since(last_write);
    if (since <= write_cost / output_share) return false;
    if (!wanted.asked()) return since > seconds_between_writes;
    return (wanted.every > 0 && since >= wanted.every) ||
           (wanted.every_simulated > 0 && stepper.time() - written_time >= wanted.every_simulated);
  }

  void look() {
    if (ranks.any(options.stop && options.stop())) {
      save();
      stopped = true;
      throw SolverError(fmt::format("stopped by the user at t = {:.6g} s", stepper.time()));
    }
    if (options.progress && seconds_since(last_report) > seconds_between_reports) {
      last_report = Clock::now();
      options.progress(stepper.time(), model.analysis.duration, recorder.impacts());
    }
    if (ranks.from_root(write_is_due())) write_running();
    steps_to_look = steps_between_looks = ranks.from_root(steps_until_next_look());
    last_look = Clock::now();
  }

  int steps_until_next_look() const {
    const double steps = steps_between_looks * seconds_between_looks / std::max(seconds_since(last_look), 1e-9);
    return static_cast<int>(std::clamp(steps, 1.0, 1.0 * max_steps_between_looks));
  }
};

PetscErrorCode after_step(TS ts) {
  Watch* watch = nullptr;
  PetscFunctionBegin;
  PetscCall(TSGetApplicationContext(ts, &watch));
  try {
    watch->recorder.step();
    if (--watch->steps_to_look == 0) watch->look();
  } catch (...) {
    watch->failure = std::current_exception();
  }
  if (watch->failure) PetscFunctionReturn(petsc::fail("recording failed"));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

std::string text_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& error) {
    return error.what();
  }
}

struct Solve {
  petsc::Handle<TS> ts;
  petsc::Handle<Vec> u, v;
};

// Options that draw or print at the end are read there, those of factors when the first is made; every other one has been
// read by now.
void refuse_unread_options(bool factors_too) {
  for (const std::string& option : petsc::Environment::unread_options()) {
    if (option.find("view") != std::string::npos) continue;
    if (!factors_too && option.rfind("-pounding_lev_", 0) == 0) continue;
    throw InputError(fmt::format("nothing reads the option {}; pounding run --help names some that exist", option));
  }
}

// PETSc reads these for any TS; here they would change nothing.
void refuse_idle_options() {
  struct Idle {
    const char *name, *reason;
  };
  constexpr Idle idle[] = {
      {"ts_atol", "errors are relative to the motion; set -pounding_ts_rtol"},
      {"ts_max_snes_failures", "no SNES takes part"},
      {"ts_exact_final_time", "the run ends at its duration exactly"},
      {"ts_time_span", "type analysis: {output_step: ...}"},
      {"ts_init_time", "a run starts at zero"},
      {"ts_adapt_wnormtype", "errors are root mean squares weighed by the masses"},
  };
  for (const Idle& option : idle) {
    PetscBool given = PETSC_FALSE;
    petsc::check(PetscOptionsHasName(nullptr, "pounding_", (std::string("-") + option.name).c_str(), &given));
    if (given) throw InputError(fmt::format("-pounding_{} would change nothing: {}", option.name, option.reason));
  }
}

void fill(Vec to, const Eigen::VectorXd& all) {
  PetscInt first = 0, end = 0;
  PetscScalar* values = nullptr;
  petsc::check(VecGetOwnershipRange(to, &first, &end));
  petsc::check(VecGetArray(to, &values));
  std::copy_n(all.data() + first, end - first, values);
  petsc::check(VecRestoreArray(to, &values));
}

// A TS with the run's settings as defaults; the command line (-pounding_ts_...) has the last word.
Solve make_ts(const Model& model, int size) {
  using petsc::check;
  Solve solve;
  check(petsc::register_ts_pounding());
  check(TSCreate(PETSC_COMM_WORLD, solve.ts.out()));
  const TS ts = solve.ts;
  check(TSSetOptionsPrefix(ts, "pounding_"));
  check(TSSetType(ts, petsc::ts_type));
  check(petsc::set_solver_options(ts, {model.analysis.scheme, petsc::SolverKind::automatic}));
  check(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, size, solve.u.out()));
  check(VecDuplicate(solve.u, solve.v.out()));
  const auto [u, v] = initial_state(model);
  fill(solve.u, u);
  fill(solve.v, v);
  check(TS2SetSolution(ts, solve.u, solve.v));
  check(TSSetMaxTime(ts, model.analysis.duration));
  check(TSSetMaxSteps(ts, PETSC_MAX_INT));
  check(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  check(TSSetTolerances(ts, 0, nullptr, model.analysis.tolerance, nullptr));
  const double longest = longest_step(model);
  TSAdapt adapt = nullptr;
  check(TSGetAdapt(ts, &adapt));
  check(TSAdaptSetStepLimits(adapt, 1e-18, longest));
  check(TSSetTimeStep(ts, longest / 64));
  try {
    check(TSSetFromOptions(ts));
  } catch (const SolverError& error) {
    throw InputError(fmt::format("a -pounding_ option is wrong: {}", error.what()));
  }
  refuse_idle_options();
  refuse_unread_options(false);
  PetscBool ours = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(ts), petsc::ts_type, &ours));
  if (!ours)
    throw InputError("-pounding_ts_type: only the type \"pounding\" lands on impacts; leave the option out");
  return solve;
}

StepperOptions stepper_options(TS ts, const Model& model) {
  StepperOptions options;
  PetscReal tolerance = 0;
  petsc::SolverOptions choice;
  petsc::check(TSGetTolerances(ts, nullptr, nullptr, &tolerance, nullptr));
  petsc::check(petsc::get_solver_options(ts, &choice));
  if (!(tolerance >= min_tolerance && tolerance <= max_tolerance))
    throw InputError(fmt::format("-pounding_ts_rtol {:g}: the tolerance lies in [{:g}, {:g}]", tolerance, min_tolerance,
                                 max_tolerance));
  options.tolerance = tolerance;
  options.scheme = choice.scheme;
  options.max_step = longest_step(model);
  return options;
}

// A limit on steps ends a TS without an error.
std::string early_end(TS ts, const Stepper& stepper, const Model& model) {
  if (stepper.time() >= model.analysis.duration * (1 - 1e-12)) return "";
  TSConvergedReason reason = TS_CONVERGED_ITERATING;
  petsc::check(TSGetConvergedReason(ts, &reason));
  return fmt::format("the time stepping ended at t = {:.6g} s of {:.6g} s ({})", stepper.time(), model.analysis.duration,
                     TSConvergedReasons[reason]);
}

bool cut_by_most_steps(TS ts) {
  TSConvergedReason reason = TS_CONVERGED_ITERATING;
  petsc::check(TSGetConvergedReason(ts, &reason));
  return reason == TS_CONVERGED_ITS;
}

void fill_statistics(TS ts, const Stepper& stepper, SolverStatistics& solver) {
  PetscInt steps = 0, rejected = 0;
  petsc::check(TSGetStepNumber(ts, &steps));
  petsc::check(TSGetStepRejections(ts, &rejected));
  solver.steps = steps;
  solver.rejected = rejected;
  solver.events = stepper.events();
  solver.iterations = stepper.iterations();
}

Results heading(const Model& model, const RunOptions& options) {
  Results results;
  results.version = POUNDING_VERSION;
  results.created = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  results.title = model.title;
  results.command = options.command;
  results.model_yaml = model.source_text;
  results.resolved_yaml = resolved_yaml(model);
  return results;
}

Outcome run_once(const Model& model, const RunOptions& options, bool with_links,
                 std::vector<StructureSummary> without_pounding, const InterruptedRun* earlier = nullptr) {
  const Clock::time_point start = Clock::now();
  Outcome outcome;
  Results& results = outcome.results;
  results = heading(model, options);
  outcome.summary.without_pounding = std::move(without_pounding);

  const System system = assemble(model, with_links);
  Solve solve = make_ts(model, system.size());
  petsc::SolverOptions choice;
  petsc::check(petsc::get_solver_options(solve.ts, &choice));
  const std::unique_ptr<StructureSolver> base = petsc::make_solver(system, choice.solver, PETSC_COMM_WORLD);
  Stepper stepper(system, *base, stepper_options(solve.ts, model));
  petsc::check(petsc::set_stepper(solve.ts, &stepper));
  petsc::check(petsc::set_lazy_vectors(solve.ts, PETSC_TRUE));
  const auto [u, v] = initial_state(model);
  stepper.start(0, u, v);
  PetscReal first = 0;
  petsc::check(TSGetTimeStep(solve.ts, &first));
  stepper.try_step(stepper.step_towards(first, model.analysis.duration));  // makes the first factor, which reads its options
  refuse_unread_options(true);
  Recorder recorder(model, stepper, results);
  Watch watch{petsc::Ranks(PETSC_COMM_WORLD), solve.ts, stepper, recorder, model, options, results, outcome.summary,
              checkpoint_of(model, petsc::Environment::given_options()), start};
  if (earlier)
    watch.restart(*earlier);
  else
    recorder.begin();
  petsc::check(TSSetApplicationContext(solve.ts, &watch));
  petsc::check(TSSetPostStep(solve.ts, after_step));
  results.solver.wall_setup += seconds_since(start);
  watch.write_running();

  std::string failure;
  try {
    petsc::check(TSSolve(solve.ts, nullptr));
  } catch (const SolverError& error) {
    failure = watch.failure ? text_of(watch.failure) : error.what();
  }
  bool resumable = watch.stopped;
  if (failure.empty()) {
    failure = early_end(solve.ts, stepper, model);
    resumable = !failure.empty() && cut_by_most_steps(solve.ts);
    if (resumable) watch.save();
  }
  if (!resumable) results.checkpoint.reset();
  recorder.end();
  fill_statistics(solve.ts, stepper, results.solver);
  results.solver.wall_seconds = watch.earlier_seconds + seconds_since(start);
  results.solver.wall_solve = results.solver.wall_seconds - results.solver.wall_setup - results.solver.wall_output;
  watch.conclude(failure.empty() ? "done" : "failed: " + failure);
  watch.write(results.status);
  if (!failure.empty()) throw FailedRun(failure, std::move(outcome));
  return outcome;
}

}  // namespace

Outcome run(const Model& model, const RunOptions& options) {
  if (!model.is_complete()) throw std::logic_error("this model is not complete; call its complete() first");
  for (const Link& link : model.links)
    if (!link.contact->impacts().empty() || link.contact->phase() != ContactPhase::open)
      throw std::logic_error("this model has been run; read it again");
  if (!options.resume.empty()) {
    const InterruptedRun earlier = read_interrupted_run(options.resume);
    check_same_run(earlier, model, petsc::Environment::given_options());
    return run_once(model, options, true, {}, &earlier);
  }
  std::vector<StructureSummary> without;
  if (model.compare_no_pounding) {
    // What is wrong with the options or the place is found before the first of the two runs.
    make_ts(model, assemble(model, false).size());
    const petsc::Ranks ranks(PETSC_COMM_WORLD);
    if (!options.output.empty()) ranks.on_root([&] { write_results(heading(model, options), options.output); });
    RunOptions quiet;
    quiet.progress = options.progress;
    quiet.stop = options.stop;
    try {
      without = run_once(model, quiet, false, {}).summary.structures;
    } catch (const FailedRun& failed) {
      Outcome outcome{heading(model, options), {}};
      outcome.results.status = outcome.summary.status = fmt::format("failed: (the run without links) {}", failed.what());
      outcome.results.summary_json = to_json(outcome.summary);
      if (!options.output.empty()) ranks.on_root([&] { write_results(outcome.results, options.output); });
      throw FailedRun(fmt::format("the run without links: {}", failed.what()), std::move(outcome));
    }
  }
  return run_once(model, options, true, std::move(without));
}

}  // namespace pounding
