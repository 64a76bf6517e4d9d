// Largest values between the ends of steps.

#include <gtest/gtest.h>

#include <pounding/run/peaks.hpp>

namespace pounding {
namespace {

TEST(Peak, IsTheLargestAbsoluteValue) {
  Peak peak;
  EXPECT_EQ(peak.value(), 0);
  peak.update(2.0);
  peak.update(-3.0);
  peak.update(1.0);
  EXPECT_EQ(peak.value(), 3);
}

TEST(Peak, IsFoundInsideAStepByTheSlopesAtItsEnds) {
  // u = 1 + 4 t - 2 t^2 on [0, 3]: the maximum 3 is at t = 1.
  Peak peak;
  peak.update(3, 1, 4, -5, -8);
  EXPECT_EQ(peak.value(), 5) << "the end of the step is larger";
  Peak inside;
  inside.update(2, 1, 4, 1, -4);
  EXPECT_DOUBLE_EQ(inside.value(), 3);
}

TEST(Peak, OfAMotionThatDoesNotTurnIsAtTheEnd) {
  Peak peak;
  peak.update(1, 0, 1, 2, 1);
  EXPECT_EQ(peak.value(), 2);
}

TEST(Peak, IsFoundOnTheParabolaThroughBothEndsAndTheMiddle) {
  // a = s (0.8 - s) on [0, 1]: the maximum 0.16 is at s = 0.4, between the samples.
  Peak peak;
  peak.update(0, 0.5 * (0.8 - 0.5), 0.8 - 1);
  EXPECT_EQ(peak.value(), 1 - 0.8) << "the end, in the other direction, is larger";
  // a = s (1.2 - s): the maximum 0.36 is at s = 0.6.
  Peak inside;
  inside.update(0, 0.35, 0.2);
  EXPECT_NEAR(inside.value(), 0.36, 1e-15);
  // The parabola through 0, 1, 2 has no maximum.
  Peak straight;
  straight.update(0, 1, 2);
  EXPECT_EQ(straight.value(), 2);
}

}  // namespace
}  // namespace pounding
