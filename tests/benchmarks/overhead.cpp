// Cost of an accepted step of the engine: two oscillators through TSSolve, without recording. One JSON object.
//
//   overhead [STEPS]
//
// free: apart, steps of fixed length. pounding: the problem of problem.py with hertz_damped, adaptive steps at a
// tolerance of 1e-4. Each by both integrators.

#include <petscts.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/handle.hpp>
#include <pounding/stepping/stepper.hpp>
#include <pounding/stepping/ts_pounding.hpp>

namespace {

using namespace pounding;
using petsc::check;
using Clock = std::chrono::steady_clock;

struct Oscillators {
  GapContact<laws::HertzDamped> link;
  System system;

  explicit Oscillators(double gap) : link({.stiffness = 2.75e9, .restitution = 0.65}, gap) {
    const double mass[] = {100e3, 150e3}, period[] = {0.5, 1.0}, damping = 0.05;
    system.mass.resize(2, 2);
    system.stiffness.resize(2, 2);
    system.damping.resize(2, 2);
    system.gap_jacobian.resize(2, 1);
    system.load.resize(2, 1);
    for (int i = 0; i < 2; ++i) {
      const double w = 2 * M_PI / period[i];
      system.mass.insert(i, i) = system.load(i, 0) = mass[i];
      system.stiffness.insert(i, i) = mass[i] * w * w;
      system.damping.insert(i, i) = 2 * damping * w * mass[i];
      system.gap_jacobian.insert(i, 0) = i == 0 ? 1 : -1;
      system.groups.push_back({i, 1, 1e-2 * 4 / (w * w), 1e-2 * 4 / w});
    }
    system.contacts.push_back(&link);
    system.grounds = {GroundMotion(Harmonic{0.4 * 9.81, 1 / 1.5, 1e6})};
  }
};

struct Result {
  double seconds_per_step = 0;
  long steps = 0, events = 0;
};

Result run(Scheme::Kind scheme, double gap, double end, double longest, bool fixed) {
  Oscillators oscillators(gap);
  ModalSolver base(oscillators.system);
  Stepper stepper(oscillators.system, base, {.tolerance = 1e-4, .scheme = {.kind = scheme}, .max_step = longest});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(2);
  stepper.start(0, zero, zero);
  petsc::Handle<TS> ts;
  petsc::Handle<Vec> u, v;
  check(petsc::register_ts_pounding());
  check(TSCreate(PETSC_COMM_SELF, ts.out()));
  check(TSSetType(ts, petsc::ts_type));
  check(VecCreateSeq(PETSC_COMM_SELF, 2, u.out()));
  check(VecDuplicate(u, v.out()));
  check(VecSet(u, 0));
  check(VecSet(v, 0));
  check(TS2SetSolution(ts, u, v));
  check(TSSetMaxTime(ts, end));
  check(TSSetMaxSteps(ts, PETSC_MAX_INT));
  check(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  check(TSSetTolerances(ts, 0, nullptr, 1e-4, nullptr));
  check(TSSetTimeStep(ts, fixed ? longest : longest / 64));
  check(petsc::set_stepper(ts, &stepper));
  check(petsc::set_lazy_vectors(ts, PETSC_TRUE));
  TSAdapt adapt = nullptr;
  check(TSGetAdapt(ts, &adapt));
  if (fixed) check(TSAdaptSetType(adapt, TSADAPTNONE));
  const Clock::time_point start = Clock::now();
  check(TSSolve(ts, nullptr));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  PetscInt steps = 0;
  check(TSGetStepNumber(ts, &steps));
  return {seconds / static_cast<double>(steps), steps, stepper.view().events()};
}

}  // namespace

int main(int argc, char** argv) {
  const petsc::Environment environment;
  try {
    const long wanted = argc > 1 ? std::stol(argv[1]) : 200000;
    constexpr double step = 1e-3, far = 1e3;
    nlohmann::json costs;
    for (const Scheme::Kind scheme : {Scheme::Kind::generalized_alpha, Scheme::Kind::esdirk4}) {
      // The minimum of some runs: other load only adds time.
      Result free, pounding;
      for (int i = 0; i < 5; ++i) {
        const Result a = run(scheme, far, step * static_cast<double>(wanted), step, true),
                     b = run(scheme, 0.02, 10.0, 0.05, false);
        if (i == 0 || a.seconds_per_step < free.seconds_per_step) free = a;
        if (i == 0 || b.seconds_per_step < pounding.seconds_per_step) pounding = b;
      }
      costs[std::string(Scheme{.kind = scheme}.name())] = {{"seconds_per_step_free", free.seconds_per_step},
                                                           {"seconds_per_step_pounding", pounding.seconds_per_step},
                                                           {"steps", free.steps},
                                                           {"steps_pounding", pounding.steps},
                                                           {"events", pounding.events}};
    }
    std::cout << costs.dump(2) << std::endl;
  } catch (const std::exception& error) {
    std::cerr << "overhead: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
