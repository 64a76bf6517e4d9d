// Extremes between the ends of steps.

#include <gtest/gtest.h>

#include <pounding/results/envelope.hpp>

namespace pounding {
namespace envelope_test {

TEST(Extremes, AreTheLeastAndTheLargestValueWithTheirTimes) {
  Extremes extremes(1);
  EXPECT_EQ(extremes.peak(0), 0) << "before the first value";
  extremes.update(0, 1.0, 2.0);
  extremes.update(0, 2.0, -3.0);
  extremes.update(0, 3.0, 1.0);
  extremes.update(0, 4.0, 2.0);
  EXPECT_EQ(extremes.max[0], 2);
  EXPECT_EQ(extremes.t_max[0], 1) << "the first of equal values counts";
  EXPECT_EQ(extremes.min[0], -3);
  EXPECT_EQ(extremes.t_min[0], 2);
  EXPECT_EQ(extremes.peak(0), 3);
}

TEST(Extremes, OfValuesOfOneSignKeepTheSign) {
  Extremes extremes(1);
  extremes.update(0, 1.0, -2.0);
  extremes.update(0, 2.0, -3.0);
  EXPECT_EQ(extremes.max[0], -2);
  EXPECT_EQ(extremes.min[0], -3);
}

TEST(Extremes, AreFoundInsideAStepByTheSlopesAtItsEnds) {
  // u = 1 + 4 t - 2 t^2 on [0, 3]: the maximum 3 is at t = 1, the minimum -5 at the end.
  Extremes whole(1);
  whole.update(0, 10, 3, 1, 4, -5, -8);
  EXPECT_DOUBLE_EQ(whole.max[0], 3);
  EXPECT_DOUBLE_EQ(whole.t_max[0], 11);
  EXPECT_EQ(whole.min[0], -5);
  EXPECT_EQ(whole.t_min[0], 13);
  EXPECT_EQ(whole.peak(0), 5);
}

TEST(Extremes, OfAMotionThatDoesNotTurnAreAtTheEnd) {
  Extremes extremes(1);
  extremes.update(0, 0, 1, 0, 1, 2, 1);
  EXPECT_EQ(extremes.max[0], 2);
  EXPECT_EQ(extremes.min[0], 2) << "the beginning is the end of the step before";
}

TEST(Extremes, AreFoundOnTheParabolaThroughBothEndsAndTheMiddle) {
  // a = s (0.8 - s) on [0, 1]: the maximum 0.16 is at s = 0.4, between the samples.
  Extremes extremes(1);
  extremes.update(0, 2, 10, 0, 0.5 * (0.8 - 0.5), 0.8 - 1);
  EXPECT_NEAR(extremes.max[0], 0.16, 1e-15);
  EXPECT_NEAR(extremes.t_max[0], 6, 1e-12);
  EXPECT_EQ(extremes.min[0], 0.8 - 1) << "the end, in the other direction";
  // The parabola through 0, 1, 2 has no maximum.
  Extremes straight(1);
  straight.update(0, 0, 1, 0, 1, 2);
  EXPECT_EQ(straight.max[0], 2);
}

}  // namespace envelope_test
}  // namespace pounding
