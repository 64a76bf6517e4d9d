// The energy balance: input = kinetic + strain + damping + impact, for every law, within the tolerance of the run.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <pounding/stepping/energy_budget.hpp>
#include "support/book.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace energy_test {

using test::every_law;

class Energy : public testing::TestWithParam<const char*> {};

TEST_P(Energy, ClosesBelowTheToleranceOfTheRun) {
  test::Book book("Energies", "input = kinetic + strain + damping + impact, two oscillators by every law",
                  "the tolerance of the run");
  const double coarse = test::run_text(test::two_oscillators(GetParam(), 1e-4)).summary.energy.error;
  const Outcome fine = test::run_text(test::two_oscillators(GetParam(), 1e-6));
  book.below(test::law_of(GetParam()) + ": imbalance of the energies over the input [-]", fine.summary.energy.error,
             1e-6);
  EXPECT_LT(fine.summary.energy.error, 0.1 * coarse) << "the imbalance decreases with the tolerance";
  EXPECT_GE(fine.results.impacts.size(), 3u);
  EXPECT_GT(fine.summary.energy.input, 1e5);
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, Energy, testing::ValuesIn(every_law), test::law_name);

TEST(Energy, LostInTheLinkIsTheSumOverItsImpacts) {
  const Outcome run = test::run_text(test::two_oscillators(every_law[7], 1e-6));
  double sum = 0;
  for (const ImpactRow& row : run.results.impacts) sum += row.energy_lost;
  EXPECT_NEAR(sum, run.summary.links[0].energy_lost, 1e-12 * sum);
  EXPECT_NEAR(sum, run.summary.energy.impact, 1e-9 * sum);
}

TEST(Energy, OfTheInitialVelocityIsPartOfTheInput) {
  const Outcome run =
      test::run_text("structures: {a: {body: {mass: 2 t}, initial_velocity: 3 m/s}}\nanalysis: {duration: 1}\n");
  EXPECT_DOUBLE_EQ(run.summary.energy.input, 9000.0);
  EXPECT_DOUBLE_EQ(run.summary.energy.kinetic, 9000.0);
}

// A body, or an oscillator, pressed by the ground motion on an elastic contact with a wall 1 nm away: hundreds of
// bounces, each of which gains or loses a tenth of the tolerance, always with the same sign.
constexpr const char* bouncing[] = {
    "ground_motion: {pulse: {shape: rectangle, amplitude: -3.7245309099735495, duration: 2.5}}\n"
    "structures: {a: {body: {mass: 17133.6901071129}}, w: {wall: {}}}\n"
    "links: [{between: [a, w], gap: 1e-9, law: linear_spring, stiffness: 6185090576.35574}]\n",
    "ground_motion: {pulse: {shape: rectangle, amplitude: -2.698162409163812, duration: 2.5}}\n"
    "structures: {a: {oscillator: {mass: 11189.385580383287, period: 1.12088046252491, damping: 0}}, w: {wall: {}}}\n"
    "links: [{between: [a, w], gap: 1e-9, law: hertz, stiffness: 521727946929.73486}]\n"};

TEST(Energy, ClosesOverHundredsOfElasticBounces) {
  for (const std::string model : bouncing) {
    SCOPED_TRACE(model);
    const Outcome run = test::run_text(model + "analysis: {duration: 2, tolerance: 1e-4}\n");
    EXPECT_GT(run.results.impacts.size(), 150u);
    EXPECT_LT(run.summary.energy.error, 1e-4);
    EXPECT_LT(run.summary.solver.steps, 20000) << "2 to 3 times as many as without control of the energy balance";
  }
}

Energies with_imbalance(double input, double imbalance) { return {.input = input, .kinetic = input - imbalance}; }

TEST(EnergyBudget, LeavesStepsAloneUntilHalfOfTheToleranceIsSpent) {
  EnergyBudget budget(1e-4, 4, 0);
  budget.audit(with_imbalance(1024, 0));
  EXPECT_EQ(budget.share(), 1.0);
  for (const double sign : {-1, 1}) {
    budget.audit(with_imbalance(1024, sign * 0.499e-4 * 1024));
    EXPECT_EQ(budget.share(), 1.0);
    budget.audit(with_imbalance(1024, sign * 0.75e-4 * 1024));
    EXPECT_NEAR(budget.share(), std::pow(0.5, 4), 1e-9) << "half of the steps";
  }
}

TEST(EnergyBudget, ShortensStepsToATenthAtMost) {
  EnergyBudget budget(1e-4, 3, 0);
  budget.audit(with_imbalance(1024, 0.2));
  EXPECT_DOUBLE_EQ(budget.share(), 1e-3);
}

TEST(EnergyBudget, ComparesWithTheLargestInputOfTheRun) {
  EnergyBudget budget(1e-4, 4, 1);
  budget.audit(with_imbalance(0, 0.4e-4));
  EXPECT_EQ(budget.share(), 1.0);
  budget.audit(with_imbalance(1024, 0));
  budget.audit(with_imbalance(-1, 0.4e-4 * 1024));
  EXPECT_EQ(budget.share(), 1.0);
}

TEST(EnergyBudget, LetsTheLeastEnergyCountLessWithEveryAudit) {
  EnergyBudget budget(1e-4, 4, 1024);
  const Energies small = with_imbalance(1, 1e-4 * 1024 / 16);  // 64 tolerances of the energy present
  for (int audit = 1; audit <= 7; ++audit) {
    budget.audit(small);
    EXPECT_EQ(budget.share(), 1.0) << audit;
  }
  for (int audit = 8; audit <= 16; ++audit) budget.audit(small);
  EXPECT_DOUBLE_EQ(budget.share(), std::pow(EnergyBudget::shortest_part, 4));
}

// A body of 1.8 t on a stiff spring at the wall, pressed by the ground motion: 2,034 vibrations between 0 and 2 m a/k =
// 0.23 um.
TEST(Energy, ClosesOverThousandsOfSmallVibrations) {
  const double m = 1795.1043268305666, a = 4.618567519154774, k = 73382944985.9216;
  const Outcome run = test::run_text(
      "ground_motion: {pulse: {shape: rectangle, amplitude: -4.618567519154774, start: 0, duration: 2.5}}\n"
      "structures: {b: {body: {mass: 1795.1043268305666}}, w: {wall: {}}}\n"
      "links: [{between: [b, w], gap: 0, law: linear_spring, stiffness: 73382944985.9216}]\n"
      "analysis: {duration: 2, tolerance: 1e-4}\n");
  EXPECT_NEAR(run.summary.links[0].peak_force, 2 * m * a, 1e-4 * 2 * m * a);
  EXPECT_NEAR(run.summary.structures[0].peak_displacement[0], 2 * m * a / k, 1e-4 * 2 * m * a / k);
  EXPECT_LT(run.summary.energy.error, 1e-4);
}

}  // namespace energy_test
}  // namespace pounding
