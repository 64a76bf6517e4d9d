// The type `pounding` as a regular TS: events of a host program, rollback, interpolation, restart, options.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/handle.hpp>
#include <pounding/stepping/ts_pounding.hpp>
#include "support/runs.hpp"

namespace pounding {
namespace ts_pounding_test {

using petsc::check;

// A model driven through PETSc's own interface.
struct Driven {
  Model model;
  System system;
  ModalSolver base;
  Stepper stepper;
  petsc::Handle<TS> ts;
  petsc::Handle<Vec> u, v;

  explicit Driven(const std::string& law, double tolerance = 1e-6)
      : model(test::model_of(test::two_oscillators(law, tolerance))),
        system(assemble(model)),
        base(system),
        stepper(system, base, {.tolerance = tolerance, .max_step = 0.02}) {
    check(petsc::register_ts_pounding());
    check(TSCreate(PETSC_COMM_SELF, ts.out()));
    check(TSSetType(ts, petsc::ts_type));
    check(VecCreateSeq(PETSC_COMM_SELF, system.size(), u.out()));
    check(VecDuplicate(u, v.out()));
    check(VecSet(u, 0));
    check(VecSet(v, 0));
    check(TS2SetSolution(ts, u, v));
    check(TSSetMaxTime(ts, 3.0));
    check(TSSetMaxSteps(ts, PETSC_MAX_INT));
    check(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
    check(TSSetTolerances(ts, 0, nullptr, tolerance, nullptr));
    check(TSSetTimeStep(ts, 1e-3));
    check(petsc::set_stepper(ts, &stepper));
  }
  std::span<const ImpactRow> impacts() const { return stepper.view().memory().contacts[0].impacts(); }
};

double value(Vec x, PetscInt i) {
  PetscScalar out = 0;
  check(VecGetValues(x, 1, &i, &out));
  return PetscRealPart(out);
}

constexpr const char* law = "jankowski, stiffness: 2.75e9, restitution: 0.65";

// An event of a host: the left oscillator passes -10 mm. PETSc rolls steps back and repeats shorter ones to locate it.
struct Passing {
  std::vector<double> times, values;
};
PetscErrorCode height(TS, PetscReal, Vec u, PetscScalar* f, void*) {
  f[0] = value(u, 0) + 0.01;
  return 0;
}
PetscErrorCode passed(TS, PetscInt, PetscInt*, PetscReal t, Vec u, PetscBool, void* context) {
  auto* passing = static_cast<Passing*>(context);
  passing->times.push_back(t);
  passing->values.push_back(value(u, 0));
  return 0;
}

TEST(TsPounding, LetsPetscLocateAnEventOfItsHost) {
  Driven plain(law), watched(law);
  Passing passing;
  PetscInt direction = 0;
  PetscBool terminate = PETSC_FALSE;
  check(TSSetEventHandler(watched.ts, 1, &direction, &terminate, height, passed, &passing));
  check(TSSetEventTolerances(watched.ts, 1e-10, nullptr));
  check(TSSolve(plain.ts, nullptr));
  check(TSSolve(watched.ts, nullptr));
  ASSERT_GT(passing.times.size(), 4u);
  for (const double at : passing.values) EXPECT_NEAR(at, -0.01, 1e-9);
  // Rolled-back steps have no effect on the contact.
  ASSERT_EQ(watched.impacts().size(), plain.impacts().size());
  for (std::size_t i = 0; i < plain.impacts().size(); ++i) {
    EXPECT_NEAR(watched.impacts()[i].t_start, plain.impacts()[i].t_start, 1e-6);
    EXPECT_NEAR(watched.impacts()[i].peak_force, plain.impacts()[i].peak_force, 1e-5 * plain.impacts()[0].peak_force);
  }
}

// Every step is taken, rolled back and taken again, with bitwise identical results.
TEST(TsPounding, RollsBackContactsAndAll) {
  Driven plain(law, 1e-4), back(law, 1e-4);
  check(petsc::set_rollback(back.ts, PETSC_TRUE));
  for (Driven* run : {&plain, &back}) {
    check(TSSetUp(run->ts));
    PetscReal time = 0, wanted = 0;
    while (time < 2.0) {
      check(TSGetTimeStep(run->ts, &wanted));
      check(TSStep(run->ts));
      if (run == &back) {
        check(TSRollBack(run->ts));
        check(TSSetTimeStep(run->ts, wanted));
        check(TSStep(run->ts));
      }
      check(TSGetTime(run->ts, &time));
    }
  }
  ASSERT_GT(plain.impacts().size(), 2u);
  ASSERT_EQ(back.impacts().size(), plain.impacts().size());
  EXPECT_EQ(back.stepper.view().time(), plain.stepper.view().time());
  EXPECT_EQ(back.stepper.view().state().u, plain.stepper.view().state().u);
  EXPECT_EQ(back.stepper.view().state().v, plain.stepper.view().state().v);
  EXPECT_EQ(back.stepper.view().energies().input, plain.stepper.view().energies().input);
  for (std::size_t i = 0; i + 1 < plain.impacts().size(); ++i)
    EXPECT_EQ(back.impacts()[i].impulse, plain.impacts()[i].impulse);
}

TEST(TsPounding, SaysWhatARollbackNeeds) {
  Driven run(law, 1e-3);
  check(TSSetUp(run.ts));
  check(TSStep(run.ts));
  try {
    check(TSRollBack(run.ts));
    FAIL() << "no accepted step to roll back to";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("set_rollback()"), std::string::npos) << error.what();
  }
}

TEST(TsPounding, InterpolatesInsideTheLastStep) {
  Driven run(law, 1e-8);
  petsc::Handle<Vec> middle;
  check(VecDuplicate(run.u, middle.out()));
  check(TSSetUp(run.ts));
  for (int i = 0; i < 200; ++i) check(TSStep(run.ts));
  const double begin = run.stepper.view().begin().time, end = run.stepper.view().time();
  check(TSInterpolate(run.ts, 0.5 * (begin + end), middle));
  const State &x = run.stepper.view().begin(), &y = run.stepper.view().state();
  const double cubic = 0.5 * (x.u[1] + y.u[1]) + (end - begin) / 8 * (x.v[1] - y.v[1]);
  EXPECT_NEAR(value(middle, 1), cubic, 1e-15);
  EXPECT_NE(value(middle, 1), y.u[1]);
}

// A host doubles a velocity between two steps and reports it: the added energy is input.
TEST(TsPounding, GoesOnFromAMotionThatItsHostChanged) {
  Driven run(law, 1e-6);
  check(TSSetUp(run.ts));
  for (int i = 0; i < 20; ++i) check(TSStep(run.ts));
  const Energies before = run.stepper.view().energies();
  check(VecScale(run.v, 2));
  check(TSRestartStep(run.ts));
  for (int i = 0; i < 20; ++i) check(TSStep(run.ts));
  const Energies after = run.stepper.view().energies();
  EXPECT_GT(after.input, before.input + 2.9 * before.kinetic);
  const double sum = after.kinetic + after.strain + after.damping + after.impact;
  EXPECT_NEAR(after.input, sum, 1e-5 * after.input);
}

TEST(TsPounding, WritesItsVectorsLazilyOnlyWhenAsked) {
  Driven eager(law, 1e-3), lazy(law, 1e-3);
  check(petsc::set_lazy_vectors(lazy.ts, PETSC_TRUE));
  for (Driven* run : {&eager, &lazy}) {
    check(TSSetUp(run->ts));
    for (int i = 0; i < 50; ++i) check(TSStep(run->ts));
  }
  EXPECT_EQ(value(eager.u, 0), eager.stepper.view().state().u[0]);
  EXPECT_EQ(value(lazy.u, 0), 0);
  check(TSSolve(lazy.ts, nullptr));
  EXPECT_EQ(value(lazy.u, 0), lazy.stepper.view().state().u[0]) << "the end is recorded";
}

}  // namespace ts_pounding_test
}  // namespace pounding
