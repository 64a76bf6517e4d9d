#include <pounding/run/ts_setup.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/model/cost.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/petsc/vectors.hpp>
#include <pounding/stepping/ts_pounding.hpp>

namespace pounding {
namespace {

using petsc::check;

// First step as a fraction of the maximum step at time 0.
constexpr double first_share = 1.0 / 64;

double first_step(const Model& model) {
  return first_share * std::min(longest_step(model), ground_plan(model).longest_step(0));
}

// PETSc reads these options for every TS; here they have no effect.
void refuse_idle_options() {
  struct Idle {
    const char *name, *reason;
  };
  constexpr Idle idle[] = {
      {"ts_atol", "errors are relative to the motion; set -pounding_ts_rtol"},
      {"ts_max_snes_failures", "no SNES is used"},
      {"ts_exact_final_time", "the run always ends exactly at its duration"},
      {"ts_time_span", "type analysis: {output_step: ...}"},
      {"ts_init_time", "every run starts at zero"},
      {"ts_adapt_wnormtype", "errors are mass-weighted root mean squares"},
  };
  for (const Idle& option : idle) {
    PetscBool given = PETSC_FALSE;
    check(PetscOptionsHasName(nullptr, "pounding_", (std::string("-") + option.name).c_str(), &given));
    if (given) throw InputError(fmt::format("-pounding_{} has no effect: {}", option.name, option.reason));
  }
  const std::vector<std::string> given = petsc::Environment::given_options();
  const auto starts_with = [](const char* start) {
    return [start](const std::string& option) { return option.starts_with(start); };
  };
  if (std::ranges::any_of(given, starts_with("-pounding_ts_adapt_type "))) return;
  if (const auto idle_adapt = std::ranges::find_if(given, starts_with("-pounding_ts_adapt_"));
      idle_adapt != given.end())
    throw InputError(fmt::format("{} has no effect without -pounding_ts_adapt_type basic", *idle_adapt));
}

// A distributed vector with these entries.
petsc::Handle<Vec> make_vector(const Eigen::VectorXd& all, MPI_Comm comm) {
  petsc::Handle<Vec> made;
  check(VecCreateMPI(comm, PETSC_DECIDE, static_cast<PetscInt>(all.size()), made.out()));
  check(petsc::scatter(all, made));
  return made;
}

// PETSc quotes the value that it cannot read, but not always the option.
std::string options_named_in(const std::string& message) {
  std::string named;
  for (const std::string& option : petsc::Environment::given_options()) {
    const std::size_t blank = option.find(' ');
    const std::string value = blank == std::string::npos ? option : option.substr(blank + 1);
    if (message.find(value) != std::string::npos) named += excerpt(option) + ": ";
  }
  return named;
}

// Calls `read`; rethrows an error of PETSc as an InputError with the options that may have caused it.
template <class Read>
void read_options(const Read& read) {
  try {
    read();
  } catch (const SolverError& error) {
    throw InputError(fmt::format("a -pounding_ option is wrong: {}{}", options_named_in(error.what()), error.what()));
  }
}

void read_real(const char* name, double& value) {
  check(PetscOptionsGetReal(nullptr, "pounding_", name, &value, nullptr));
}

// Reads an option whose value is one of `names`; `value` is an enumerator with the index of its name.
template <class Enum, std::size_t n>
void read_name(const char* name, const std::array<const char*, n>& names, Enum& value) {
  PetscInt index = static_cast<PetscInt>(value);
  check(PetscOptionsGetEList(nullptr, "pounding_", name, names.data(), static_cast<PetscInt>(n), &index, nullptr));
  value = static_cast<Enum>(index);
}

void read_scheme(Scheme& scheme) {
  PetscBool radius_given = PETSC_FALSE;
  read_name("-ts_pounding_scheme", std::array{Scheme::names[0].data(), Scheme::names[1].data()}, scheme.kind);
  check(PetscOptionsGetReal(nullptr, "pounding_", "-ts_pounding_radius", &scheme.spectral_radius, &radius_given));
  if (radius_given && scheme.kind != Scheme::Kind::generalized_alpha)
    throw InputError("-pounding_ts_pounding_radius needs -pounding_ts_pounding_scheme generalized_alpha");
  if (!(scheme.spectral_radius >= 0 && scheme.spectral_radius <= 1))
    throw InputError(
        fmt::format("-pounding_ts_pounding_radius {:g}: the spectral radius lies in [0, 1]", scheme.spectral_radius));
}

}  // namespace

EffectiveSettings effective_settings(const Model& model) {
  const AnalysisSettings& analysis = model.analysis;
  EffectiveSettings settings{{analysis.tolerance, analysis.scheme, longest_step(model)},
                             petsc::SolverKind::automatic,
                             analysis.duration,
                             first_step(model),
                             analysis.max_steps};
  const LibraryLock lock;
  double& tolerance = settings.stepper.tolerance;
  read_options([&] {
    PetscInt max_steps = static_cast<PetscInt>(settings.max_steps);
    read_real("-ts_rtol", tolerance);
    read_real("-ts_dt", settings.first_step);
    check(PetscOptionsGetInt(nullptr, "pounding_", "-ts_max_steps", &max_steps, nullptr));
    settings.max_steps = max_steps;
    read_scheme(settings.stepper.scheme);
    read_name("-ts_pounding_base", std::array{"automatic", "modal", "sparse"}, settings.solver);
  });
  if (!(tolerance >= min_tolerance && tolerance <= max_tolerance))
    throw InputError(fmt::format("-pounding_ts_rtol {:g}: the tolerance lies in [{:g}, {:g}]", tolerance, min_tolerance,
                                 max_tolerance));
  return settings;
}

void refuse_unread_options(bool factors_too) {
  for (const std::string& option : petsc::Environment::unread_options()) {
    // Options that draw or print at the end of the run are read at that time.
    if (option.find("view") != std::string::npos) continue;
    if (!factors_too && (option.starts_with("-pounding_lev_") || option.starts_with("-pounding_red_factor_"))) continue;
    throw InputError(fmt::format("unknown or unused option {}; see `pounding run --help`", option));
  }
}

TsSetup set_up_ts(const EffectiveSettings& settings, const Eigen::VectorXd& u, const Eigen::VectorXd& v,
                  MPI_Comm comm) {
  const LibraryLock lock;
  TsSetup setup{{}, make_vector(u, comm), make_vector(v, comm)};
  check(petsc::register_ts_pounding());
  check(TSCreate(comm, setup.ts.out()));
  const TS ts = setup.ts;
  check(TSSetOptionsPrefix(ts, "pounding_"));
  check(TSSetType(ts, petsc::ts_type));
  check(TSSetMaxTime(ts, settings.duration));
  check(TSSetMaxSteps(ts, static_cast<PetscInt>(settings.max_steps)));
  check(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  check(TSSetTolerances(ts, 0, nullptr, settings.stepper.tolerance, nullptr));
  TSAdapt adapt = nullptr;
  check(TSGetAdapt(ts, &adapt));
  check(TSAdaptSetStepLimits(adapt, 1e-18, settings.stepper.max_step));
  check(TSSetTimeStep(ts, settings.first_step));
  check(TS2SetSolution(ts, setup.u, setup.v));
  read_options([&] { check(TSSetFromOptions(ts)); });
  refuse_idle_options();
  refuse_unread_options(false);
  PetscBool ours = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(ts), petsc::ts_type, &ours));
  if (!ours) throw InputError("-pounding_ts_type: only the type \"pounding\" locates impacts; omit the option");
  return setup;
}

}  // namespace pounding
