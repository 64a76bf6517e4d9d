#include <pounding/run/ts_setup.hpp>

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/model/cost.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/vectors.hpp>
#include <pounding/stepping/ts_pounding.hpp>

namespace pounding {
namespace {

using petsc::check;

// The first step that is wanted, as a part of the longest there.
constexpr double first_share = 1.0 / 64;

double first_step(const Model& model) {
  return first_share * std::min(longest_step(model), ground_plan(model).longest_step(0));
}

// PETSc reads these for every TS; here they would change nothing.
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
    check(PetscOptionsHasName(nullptr, "pounding_", (std::string("-") + option.name).c_str(), &given));
    if (given) throw InputError(fmt::format("-pounding_{} would change nothing: {}", option.name, option.reason));
  }
}

// A distributed vector with these entries.
petsc::Handle<Vec> make_vector(const Eigen::VectorXd& all, MPI_Comm comm) {
  petsc::Handle<Vec> made;
  check(VecCreateMPI(comm, PETSC_DECIDE, static_cast<PetscInt>(all.size()), made.out()));
  check(petsc::scatter(all, made));
  return made;
}

void set_defaults(TS ts, const Model& model) {
  const AnalysisSettings& analysis = model.analysis;
  check(TSSetOptionsPrefix(ts, "pounding_"));
  check(TSSetType(ts, petsc::ts_type));
  check(petsc::set_solver_options(ts, {analysis.scheme, petsc::SolverKind::automatic}));
  check(TSSetMaxTime(ts, analysis.duration));
  check(TSSetMaxSteps(ts, static_cast<PetscInt>(analysis.most_steps)));
  check(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  check(TSSetTolerances(ts, 0, nullptr, analysis.tolerance, nullptr));
  TSAdapt adapt = nullptr;
  check(TSGetAdapt(ts, &adapt));
  check(TSAdaptSetStepLimits(adapt, 1e-18, longest_step(model)));
  check(TSSetTimeStep(ts, first_step(model)));
}

// PETSc quotes the value that it cannot read, and not always the option.
std::string options_named_in(const std::string& message) {
  std::string named;
  for (const std::string& option : petsc::Environment::given_options()) {
    const std::size_t blank = option.find(' ');
    const std::string value = blank == std::string::npos ? option : option.substr(blank + 1);
    if (message.find(value) != std::string::npos) named += excerpt(option) + ": ";
  }
  return named;
}

void read_command_line(TS ts) {
  try {
    check(TSSetFromOptions(ts));
  } catch (const SolverError& error) {
    throw InputError(fmt::format("a -pounding_ option is wrong: {}{}", options_named_in(error.what()), error.what()));
  }
  refuse_idle_options();
  refuse_unread_options(false);
  PetscBool ours = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(ts), petsc::ts_type, &ours));
  if (!ours) throw InputError("-pounding_ts_type: only the type \"pounding\" lands on impacts; leave the option out");
}

void take_settings(TsSetup& setup, const Model& model) {
  PetscReal tolerance = 0, first_step = 0;
  petsc::SolverOptions chosen;
  check(TSGetTolerances(setup.ts, nullptr, nullptr, &tolerance, nullptr));
  check(TSGetTimeStep(setup.ts, &first_step));
  check(petsc::get_solver_options(setup.ts, &chosen));
  if (!(tolerance >= min_tolerance && tolerance <= max_tolerance))
    throw InputError(fmt::format("-pounding_ts_rtol {:g}: the tolerance lies in [{:g}, {:g}]", tolerance, min_tolerance,
                                 max_tolerance));
  setup.stepper.tolerance = tolerance;
  setup.stepper.scheme = chosen.scheme;
  setup.stepper.max_step = longest_step(model);
  setup.solver = chosen.solver;
  setup.first_step = first_step;
}

}  // namespace

void refuse_unread_options(bool factors_too) {
  for (const std::string& option : petsc::Environment::unread_options()) {
    // Options that draw or print at the end of the run are read there.
    if (option.find("view") != std::string::npos) continue;
    if (!factors_too && (option.starts_with("-pounding_lev_") || option.starts_with("-pounding_red_factor_"))) continue;
    throw InputError(fmt::format("nothing reads the option {}; pounding run --help names some that exist", option));
  }
}

TsSetup set_up_ts(const Model& model, const Eigen::VectorXd& u, const Eigen::VectorXd& v, MPI_Comm comm) {
  TsSetup setup;
  check(petsc::register_ts_pounding());
  check(TSCreate(comm, setup.ts.out()));
  set_defaults(setup.ts, model);
  setup.u = make_vector(u, comm);
  setup.v = make_vector(v, comm);
  check(TS2SetSolution(setup.ts, setup.u, setup.v));
  read_command_line(setup.ts);
  take_settings(setup, model);
  return setup;
}

}  // namespace pounding
