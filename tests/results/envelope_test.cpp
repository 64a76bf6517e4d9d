// Extremes inside steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

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
  EXPECT_EQ(extremes.t_max[0], 1) << "the first of equal values is reported";
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
  EXPECT_EQ(extremes.min[0], 2) << "the beginning is the end of the previous step";
}

// Random paths, each compared with a thousand of its values.
TEST(Extremes, OfAPathOfDegreeFourAreFoundAndBounded) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    const Quartic path{uniform(random), uniform(random), uniform(random), 2 * uniform(random), 4 * uniform(random)};
    EXPECT_NEAR(path.at(0), path.begin, 1e-15);
    EXPECT_EQ(path.at(0.5), path.middle);
    EXPECT_NEAR(path.at(1), path.end, 1e-15);
    Extremes extremes(1);
    extremes.update(0, 1, path.begin);
    extremes.update(0, 1, 2, path);
    const auto [low, high] = path.bounds();
    double minimum = path.begin, largest = path.begin;
    for (int k = 1; k <= 1000; ++k) {
      const double value = path.at(1e-3 * k);
      minimum = std::min(minimum, value);
      largest = std::max(largest, value);
    }
    EXPECT_GE(minimum, low);
    EXPECT_LE(largest, high);
    // A parabola deviates from a path by 1/125 of the third derivative times the cube of its length.
    const double allowed = std::pow(0.25, 3) / 124 * (6 * std::abs(path.alpha) + 12 * std::abs(path.beta)) + 1e-6;
    EXPECT_NEAR(extremes.min[0], minimum, allowed);
    EXPECT_NEAR(extremes.max[0], largest, allowed);
  }
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

// A step without a new extreme costs few operations. Extremes without a previous value process each step completely.
TEST(Extremes, OfManyStepsAreThoseOfEachStepAlone) {
  std::mt19937 random(3);
  std::normal_distribution<double> any;
  for (int round = 0; round < 200; ++round) {
    Extremes cubics(1), parabolas(1);
    double begin = 0, rate = 1, time = 0, minimum[2] = {0, 0}, largest[2] = {0, 0};
    cubics.update(0, time, begin);
    parabolas.update(0, time, begin);
    for (int step = 0; step < 20; ++step) {
      const double h = 0.1, end = any(random), rate_end = 20 * any(random),
                   middle = 0.5 * (begin + end) + 0.5 * any(random);
      cubics.update(0, time, h, begin, rate, end, rate_end);
      parabolas.update(0, time, h, begin, middle, end);
      Extremes alone[2] = {Extremes(1), Extremes(1)};
      alone[0].update(0, time, h, begin, rate, end, rate_end);
      alone[1].update(0, time, h, begin, middle, end);
      for (int i = 0; i < 2; ++i) {
        minimum[i] = std::min(minimum[i], alone[i].min[0]);
        largest[i] = std::max(largest[i], alone[i].max[0]);
      }
      ASSERT_EQ(cubics.min[0], minimum[0]);
      ASSERT_EQ(cubics.max[0], largest[0]);
      ASSERT_EQ(parabolas.min[0], minimum[1]);
      ASSERT_EQ(parabolas.max[0], largest[1]);
      begin = end;
      rate = rate_end;
      time += h;
    }
  }
}

}  // namespace envelope_test
}  // namespace pounding
