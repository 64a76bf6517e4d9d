// Trial steps leave no trace, and the same input gives the same bits.

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include <pounding/gap_link.hpp>
#include <pounding/stepper.hpp>
#include "support/runs.hpp"

namespace pounding {
namespace {

bool same_bits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

// One run asks for many steps that it throws away, the other for none.
TEST(TrialSteps, LeaveNoTrace) {
  const auto end_state = [](bool with_trials) {
    const Model model = test::model_of(test::two_oscillators("bilinear_hertz, stiffness: 2.75e9, restitution: 0.65", 1e-4));
    const System system = assemble(model);
    Stepper stepper(system, {.tolerance = 1e-4, .first_rung = 1e-3});
    const auto [u, v] = initial_state(model);
    stepper.start(0, u, v);
    while (stepper.state().time < 1.3) {
      if (with_trials)
        for (const double h : {3e-3, 1e-4, 2.2e-2, 5e-4}) {
          EXPECT_TRUE(stepper.attempt(h));
          stepper.land();
        }
      EXPECT_TRUE(stepper.attempt(1e-3));
      const auto landed = stepper.land();
      if (landed && *landed == 0)
        stepper.cross_now();
      else
        stepper.accept();
    }
    EXPECT_EQ(model.links[0].contact->impacts().size(), 2u);
    return stepper.state();
  };
  const State quiet = end_state(false), busy = end_state(true);
  EXPECT_EQ(quiet.time, busy.time);
  EXPECT_TRUE(same_bits(quiet.u, busy.u));
  EXPECT_TRUE(same_bits(quiet.v, busy.v));
  EXPECT_TRUE(same_bits(quiet.force, busy.force));
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

TEST(Model, IsRunOnceOnly) {
  const Model model = test::model_of(test::two_oscillators("hertz, stiffness: 2.75e9", 1e-3));
  run(model);
  EXPECT_THROW(run(model), std::logic_error);
}

}  // namespace
}  // namespace pounding
