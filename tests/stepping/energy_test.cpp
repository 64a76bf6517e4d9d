// The audit: input = kinetic + strain + damping + impact, for every law, to the tolerance of the run.

#include <gtest/gtest.h>

#include <string>

#include "support/book.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace {

using test::every_law;

class Energy : public testing::TestWithParam<const char*> {};

TEST_P(Energy, ClosesBelowTheToleranceOfTheRun) {
  test::Book book("Energies",
                  "input = kinetic + strain + damping + impact, two oscillators by every law",
                  "the tolerance of the run");
  const double coarse = test::run_text(test::two_oscillators(GetParam(), 1e-4)).summary.energy.error;
  const Outcome fine = test::run_text(test::two_oscillators(GetParam(), 1e-6));
  book.below(test::law_of(GetParam()) + ": imbalance of the energies over the input [-]", fine.summary.energy.error, 1e-6);
  EXPECT_LT(fine.summary.energy.error, 0.1 * coarse) << "the imbalance falls with the tolerance";
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
  const Outcome run = test::run_text("structures: {a: {body: {mass: 2 t}, initial_velocity: 3 m/s}}\nanalysis: {duration: 1}\n");
  EXPECT_DOUBLE_EQ(run.summary.energy.input, 9000.0);
  EXPECT_DOUBLE_EQ(run.summary.energy.kinetic, 9000.0);
}

}  // namespace
}  // namespace pounding
