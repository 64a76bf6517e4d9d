// The step driver without PETSc's TS, against the TS; and its behaviour if steps are rejected.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/handle.hpp>
#include <pounding/stepping/step_controller.hpp>
#include <pounding/stepping/ts_pounding.hpp>
#include "support/direct.hpp"
#include "support/messages.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace step_controller_test {

using petsc::check;

constexpr double longest = 0.02, duration = 3.0;

struct Oscillators {
  Model model;
  System system;
  ModalSolver solver;
  Stepper stepper;

  explicit Oscillators(const Scheme& scheme, double tolerance = 1e-5)
      : model(test::model_of(test::two_oscillators("jankowski, stiffness: 2.75e9, restitution: 0.65", tolerance))),
        system(assemble(model)),
        solver(system),
        stepper(system, solver, {.tolerance = tolerance, .scheme = scheme, .max_step = longest}) {}
  void start() { stepper.start(0, Eigen::VectorXd::Zero(system.size()), Eigen::VectorXd::Zero(system.size())); }
  std::span<const ImpactRow> impacts() const { return stepper.view().memory().contacts[0].impacts(); }
};

// With this type of TSAdapt; null for the default.
void solve_with_ts(Oscillators& run, double first, TSAdaptType type) {
  petsc::Handle<TS> ts;
  petsc::Handle<Vec> u, v;
  TSAdapt adapt = nullptr;
  check(petsc::register_ts_pounding());
  check(TSCreate(PETSC_COMM_SELF, ts.out()));
  check(TSSetType(ts, petsc::ts_type));
  check(VecCreateSeq(PETSC_COMM_SELF, run.system.size(), u.out()));
  check(VecDuplicate(u, v.out()));
  check(VecSet(u, 0));
  check(VecSet(v, 0));
  check(TS2SetSolution(ts, u, v));
  check(TSSetMaxTime(ts, duration));
  check(TSSetMaxSteps(ts, PETSC_MAX_INT));
  check(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_MATCHSTEP));
  check(TSGetAdapt(ts, &adapt));
  if (type) check(TSAdaptSetType(adapt, type));
  check(TSAdaptSetStepLimits(adapt, 1e-18, longest));
  check(TSSetTimeStep(ts, first));
  check(petsc::set_stepper(ts, &run.stepper));
  check(TSSolve(ts, nullptr));
}

void expect_same_bits(const Oscillators& a, const Oscillators& b) {
  EXPECT_EQ(a.stepper.view().time(), b.stepper.view().time());
  EXPECT_EQ(a.stepper.view().state().u, b.stepper.view().state().u);
  EXPECT_EQ(a.stepper.view().state().v, b.stepper.view().state().v);
  EXPECT_EQ(a.stepper.view().state().a, b.stepper.view().state().a);
  EXPECT_EQ(a.stepper.view().iterations(), b.stepper.view().iterations());
  EXPECT_EQ(a.stepper.view().energies().input, b.stepper.view().energies().input);
  ASSERT_GT(a.impacts().size(), 2u);
  ASSERT_EQ(a.impacts().size(), b.impacts().size());
  for (std::size_t i = 0; i < a.impacts().size(); ++i) EXPECT_EQ(a.impacts()[i].impulse, b.impacts()[i].impulse);
}

class DriverWithScheme : public testing::TestWithParam<test::NamedScheme> {};

TEST_P(DriverWithScheme, MakesTheStepsThatPetscMakesWithBasicAdaptivity) {
  Oscillators with_basic(GetParam().scheme), with_ts(GetParam().scheme), alone(GetParam().scheme);
  solve_with_ts(with_basic, longest / 64, TSADAPTBASIC);
  solve_with_ts(with_ts, longest / 64, nullptr);
  alone.start();
  StepController controller(alone.stepper);
  ErrorControl policy(longest, duration);
  double h = longest / 64;
  while (alone.stepper.view().time() < duration) h = controller.advance(h, duration, policy);
  EXPECT_EQ(alone.stepper.view().time(), duration);
  EXPECT_GT(policy.rejected(), 0);
  EXPECT_GT(controller.trials(), policy.rejected());
  expect_same_bits(with_ts, alone);
  expect_same_bits(with_basic, alone);
}

TEST_P(DriverWithScheme, MakesTheStepsThatPetscMakesWithoutAdaptivity) {
  Oscillators with_ts(GetParam().scheme), alone(GetParam().scheme);
  solve_with_ts(with_ts, 1e-3, TSADAPTNONE);
  alone.start();
  test::march_evenly(alone.stepper, duration, 1e-3);
  expect_same_bits(with_ts, alone);
}

// The memory of the controller is saved with the state of the stepper.
TEST_P(DriverWithScheme, GoesOnFromASavedStateWithTheSameBits) {
  Oscillators whole(GetParam().scheme), halves(GetParam().scheme), rest(GetParam().scheme);
  const auto march = [](StepController& controller, double h, double end) {
    ErrorControl policy(longest);
    while (controller.stepper().view().time() < end) h = controller.advance(h, duration, policy);
    return h;
  };
  whole.start();
  StepController uncut(whole.stepper);
  march(uncut, longest / 64, duration);
  halves.start();
  StepController first(halves.stepper), second(rest.stepper);
  double h = march(first, longest / 64, 1.3);
  Archive saved;
  first.archive(saved);
  Archive read(saved.bytes());
  second.archive(read);
  read.expect_end();
  march(second, h, duration);
  expect_same_bits(whole, rest);
}

INSTANTIATE_TEST_SUITE_P(Schemes, DriverWithScheme, testing::ValuesIn(test::schemes),
                         [](const auto& param) { return param.param.name; });

TEST(Driver, DoesNotPassTheEnd) {
  Oscillators run({});
  run.start();
  StepController controller(run.stepper);
  FixedSteps policy;
  controller.advance(7e-3, 0.01, policy);
  EXPECT_EQ(run.stepper.view().time(), 7e-3);
  controller.advance(7e-3, 0.01, policy);
  EXPECT_EQ(run.stepper.view().time(), 0.01);
}

TEST(Driver, RemembersTheStepsOfContactsApart) {
  Oscillators run({});
  run.start();
  StepController controller(run.stepper);
  ErrorControl policy(longest);
  double h = longest / 64, before = 0;
  while (!run.stepper.view().in_contact()) before = h, h = controller.advance(h, duration, policy);
  EXPECT_LT(h, 0.2 * before) << "a first contact starts with short steps";
  double pressed = h;
  while (run.stepper.view().in_contact()) pressed = h, h = controller.advance(h, duration, policy);
  EXPECT_GT(h, 2 * pressed) << "steps return to their length before the contact";
}

// Rejects every step.
struct Impatient : StepSizePolicy {
  int rejected = 0;
  Verdict judge(const StepView&, double step) override { return {false, 0.9 * step}; }
  std::string on_reject() override { return ++rejected == 3 ? "three are sufficient" : ""; }
};

// A trial across the end of an impact has a large error because the force has a kink there. Steps that shrink before it
// would approach it only slowly.
TEST(Driver, DoesNotCreepToTheEndsOfImpacts) {
  Oscillators run({.kind = Scheme::Kind::esdirk4}, 1e-4);
  run.start();
  StepController controller(run.stepper);
  ErrorControl policy(longest);
  double h = longest / 64;
  while (run.stepper.view().time() < duration) h = controller.advance(h, duration, policy);
  ASSERT_EQ(run.impacts().size(), 5u);
  EXPECT_LT(policy.rejected(), 10 * 5);
}

TEST(Driver, StopsWithTheReasonOfThePolicy) {
  Oscillators run({});
  run.start();
  StepController controller(run.stepper);
  Impatient policy;
  try {
    controller.advance(8e-3, duration, policy);
    FAIL();
  } catch (const SolverError& error) {
    EXPECT_TRUE(test::mentions(std::string(error.what()), {"0 s", "0.00195 s"}));
  }
  EXPECT_EQ(controller.trials(), 3);
  EXPECT_EQ(run.stepper.view().time(), 0) << "no step was accepted";
}

struct Never : StepSizePolicy {
  Verdict judge(const StepView&, double step) override { return {false, step / 2}; }
};

TEST(Driver, StopsWhereNoStepIsShortEnough) {
  Oscillators run({});
  run.start();
  StepController controller(run.stepper);
  Never policy;
  try {
    controller.advance(1e-3, duration, policy);
    FAIL();
  } catch (const SolverError& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"1e-05"}));
  }
}

// Two heavy bodies press a light one between them through a dashpot that amplifies the round-off of their forces. A
// stage whose Newton iteration has reached that round-off is converged; repeating such stages would take 8,420 trials.
TEST(RestingRow, IsSolvedThoughADashpotMagnifiesRoundOff) {
  const Outcome found = test::run_text(R"(
ground_motion: {pulse: {shape: half_sine, amplitude: -0.49089660325450835, start: 0.0, duration: 1.0}}
structures:
  b0: {body: {mass: 1139.1844930340253}}
  b1: {body: {mass: 803488.4098112632}}
  b2: {body: {mass: 1330.77104107262}}
  b3: {body: {mass: 460587.80197487207}}
  b4: {wall: {}}
links:
  - {between: [b0, b1], gap: 0, law: elastoplastic, stiffness: 17016918.92900026, restitution: 0.1, formula: exact}
  - {between: [b1, b2], gap: 0, law: komodromos, stiffness: 578766897.9454374, restitution: 0.1, formula: anagnostopoulos}
  - {between: [b2, b3], gap: 0, law: modified_kelvin, stiffness: 81962101688.33119, restitution: 0.2}
  - {between: [b3, b4], gap: 0, law: adams_impact, stiffness: 5174979.668135877, depth: 0.00018562492983085222, restitution: 0.3}
analysis: {duration: 2.0, tolerance: 0.0001}
)");
  EXPECT_LT(found.results.solver.steps + found.results.solver.rejected, 6000);
}

}  // namespace step_controller_test
}  // namespace pounding
