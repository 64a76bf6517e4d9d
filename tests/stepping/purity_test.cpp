// Trial steps have no side effects, and equal input gives bitwise identical results.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/step_controller.hpp>
#include "support/runs.hpp"

namespace pounding {
namespace purity_test {

bool same_bits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

// One run computes many steps that it discards, the other none.
TEST(TrialSteps, LeaveNoTrace) {
  const auto end_state = [](bool with_trials) {
    const Model model =
        test::model_of(test::two_oscillators("bilinear_hertz, stiffness: 2.75e9, restitution: 0.65", 1e-4));
    const System system = assemble(model);
    ModalSolver base(system);
    Stepper stepper(system, base, {.tolerance = 1e-4, .max_step = 1e-3});
    const auto [u, v] = initial_state(model);
    stepper.start(0, u, v);
    StepController controller(stepper);
    FixedSteps policy;
    while (stepper.view().time() < 1.3) {
      if (with_trials)
        for (const double h : {3e-3, 1e-4, 2.2e-2, 5e-4}) {
          EXPECT_TRUE(stepper.try_step(h));
          stepper.locate_event();
        }
      controller.advance(1e-3, 2, policy);
    }
    EXPECT_EQ(stepper.view().memory().contacts[0].impacts().size(), 2u);
    return stepper.view().state();
  };
  const State quiet = end_state(false), busy = end_state(true);
  EXPECT_EQ(quiet.time, busy.time);
  EXPECT_TRUE(same_bits(quiet.u, busy.u));
  EXPECT_TRUE(same_bits(quiet.v, busy.v));
  EXPECT_TRUE(same_bits(quiet.force, busy.force));
}

// Displacements and velocities alone equal those of the states, before and after these are computed. An impulse changes
// the velocity instantaneously: the state before it differs from the present one.
TEST(KeptSteps, ShowDisplacementsAndVelocitiesAlone) {
  const Model model = test::model_of(
      "structures:\n  a: {oscillator: {mass: 100 t, period: 0.5, damping: 0}}\n  w: {wall: {}}\n"
      "links: [{between: [a, w], gap: 0, law: stereomechanical, restitution: 0.6}]\n"
      "analysis: {duration: 1}\n");
  const System system = assemble(model);
  ModalSolver base(system);
  Stepper stepper(system, base, {.tolerance = 1e-4, .max_step = 1e-2});
  stepper.start(0, Eigen::VectorXd::Constant(1, -0.05), Eigen::VectorXd::Zero(1));
  StepController controller(stepper);
  FixedSteps policy;
  int blows = 0;
  while (stepper.view().time() < 0.9) {
    controller.advance(1e-2, 1, policy);
    const auto check = [&] {
      Eigen::VectorXd u, v;
      stepper.view().begin(u, v);
      EXPECT_TRUE(same_bits(u, stepper.view().begin().u) && same_bits(v, stepper.view().begin().v))
          << "at " << stepper.view().time() << " s";
      stepper.view().end_minus(u, v);
      EXPECT_TRUE(same_bits(u, stepper.view().end_minus().u) && same_bits(v, stepper.view().end_minus().v))
          << "at " << stepper.view().time() << " s";
    };
    check();
    check();
    blows += stepper.view().end_minus().v[0] * stepper.view().state().v[0] < 0;
  }
  EXPECT_GE(blows, 2);
}

// A search for a touch inside a trial must leave the trial unchanged if there is none, including its exact end: a time
// one rounding error before a corner of the ground motion would require a step of that length.
TEST(TrialSteps, KeepTheirExactEndWhenBodiesPassClose) {
  const Model model = test::model_of(
      "structures:\n  a: {oscillator: {mass: 100 t, period: 0.5, damping: 0}}\n  w: {wall: {}}\n"
      "links: [{between: [a, w], gap: 20.001 mm, law: hertz, stiffness: 2.75e9}]\n"
      "analysis: {duration: 1}\n");
  const System system = assemble(model);
  ModalSolver base(system);
  Stepper stepper(system, base, {.tolerance = 1e-4, .max_step = 0.1});
  const double w = 2 * M_PI / 0.5, begin = 0.12, h = 0.01, end = std::nextafter(begin + h, 1.0);
  stepper.start(begin, Eigen::VectorXd::Constant(1, 0.02 * std::sin(w * begin)),
                Eigen::VectorXd::Constant(1, 0.02 * w * std::cos(w * begin)));
  ASSERT_TRUE(stepper.try_step(h, end));
  EXPECT_FALSE(stepper.locate_event().has_value());
  stepper.accept();
  EXPECT_EQ(stepper.view().state().time, end);
}

TEST(SameInput, GivesTheSameBitsTwice) {
  const std::string yaml = test::two_oscillators("jankowski, stiffness: 2.75e9, restitution: 0.65", 1e-5);
  const Outcome first = test::run_text(yaml), second = test::run_text(yaml);
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(same_bits(first.results.structures[i].displacement, second.results.structures[i].displacement));
    EXPECT_TRUE(same_bits(first.results.structures[i].acceleration, second.results.structures[i].acceleration));
  }
  EXPECT_TRUE(same_bits(first.results.links[0].force, second.results.links[0].force));
  EXPECT_TRUE(same_bits(first.results.energy.error, second.results.energy.error));
  EXPECT_EQ(first.summary.solver.steps, second.summary.solver.steps);
}

}  // namespace purity_test
}  // namespace pounding
