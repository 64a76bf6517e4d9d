/// Harmonics with a phase, sums of them, initial velocities, and motions given as displacements.

#include <pounding/ground/displacement_motion.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/ground/spectrum.hpp>
#include <pounding/ground/support_motion.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace motions_test {

using test::refusal;

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Phase, ShiftsTheSineAndMakesItJumpAtItsStart) {
  const GroundMotion motion(Harmonic{.amplitude = 3, .period = 0.6, .duration = 2, .start = 0.5, .phase = pi / 2});
  for (const double t : {0.5, 0.6, 1.234, 2.4})
    EXPECT_NEAR(motion.acceleration(t), 3 * std::cos(2 * pi * (t - 0.5) / 0.6), 1e-13);
  EXPECT_EQ(motion.acceleration_before(0.5), 0);
  EXPECT_DOUBLE_EQ(motion.acceleration(0.5), 3);
  EXPECT_TRUE(test::mentions(motion.source(), {"3 m/s^2", "0.6 s", "90 deg", "2 s"}));
}

TEST(Phase, DecidesThePeakOfAShortMotion) {
  const auto peak = [](double phase, double duration) {
    return GroundMotion(Harmonic{-2, 1, duration, 0, phase}).peak();
  };
  EXPECT_DOUBLE_EQ(peak(pi / 6, 1.0 / 12), 2 * std::sin(pi / 3));
  EXPECT_DOUBLE_EQ(peak(pi / 6, 0.2), 2);
  EXPECT_DOUBLE_EQ(peak(pi * 0.75, 0.1), 2 * std::sin(pi * 0.75));
  EXPECT_DOUBLE_EQ(peak(-pi * 0.25, 0.2), 2 * std::sin(pi * 0.25));
  EXPECT_DOUBLE_EQ(peak(pi / 2, 1e-3), 2);
}

TEST(Sum, IsThatOfItsHarmonics) {
  const Harmonic one{1.5, 0.7, 3, 0.2, 0.3}, two{-0.4, 0.11, 3, 0.2, -1.2}, three{2, 1.9, 3, 0.2, 0};
  const GroundMotion sum(HarmonicSum{{{1.5, 0.7, 0.3}, {-0.4, 0.11, -1.2}, {2, 1.9}}, 3, 0.2});
  for (const double t : {-1.0, 0.1, 0.2, 0.25, 1.3, 3.19, 3.2, 5.0}) {
    double a = 0, before = 0, v = 0, d = 0;
    for (const Harmonic& part : {one, two, three}) {
      const GroundMotion motion(part);
      a += motion.acceleration(t);
      before += motion.acceleration_before(t);
      v += motion.velocity(t);
      d += motion.displacement(t);
    }
    EXPECT_NEAR(sum.acceleration(t), a, 1e-14) << t;
    EXPECT_NEAR(sum.acceleration_before(t), before, 1e-14) << t;
    EXPECT_NEAR(sum.velocity(t), v, 1e-15) << t;
    EXPECT_NEAR(sum.displacement(t), d, 1e-15) << t;
  }
  EXPECT_EQ(sum.next_break(-infinity), 0.2);
  EXPECT_EQ(sum.next_break(0.2), 3.2);
  EXPECT_EQ(sum.next_break(3.2), infinity);
  EXPECT_EQ(sum.shortest_period(), 0.11);
  EXPECT_TRUE(test::mentions(sum.source(), {"1.5 m/s^2", "0.7 s", "17.1887 deg", "-0.4 m/s^2", "0.11 s", "-68.7549 deg",
                                            "2 m/s^2", "1.9 s", "3 s"}));
}

TEST(Sum, HasThePeakOfAllItsParts) {
  // sin x + sin 3x / 3 has its maximum sqrt(8)/3 at x = pi/4. If cut off at x = 0.5, the maximum is there.
  EXPECT_NEAR(GroundMotion(HarmonicSum{{{1, 1}, {1.0 / 3, 1.0 / 3}}, 5}).peak(), std::sqrt(8) / 3, 1e-5);
  EXPECT_NEAR(GroundMotion(HarmonicSum{{{1, 1}, {1.0 / 3, 1.0 / 3}}, 0.25 / pi}).peak(),
              std::sin(0.5) + std::sin(1.5) / 3, 1e-12);
  EXPECT_EQ(GroundMotion(HarmonicSum{{{1, 1}, {-0.5, 0.3}}, 1e6}).peak(), 1.5);
  EXPECT_EQ(GroundMotion(HarmonicSum{{{1, 1}, {-1, 1}}, 5}).peak(), 0);
}

TEST(Sum, OfOneHarmonicHasItsSpectrum) {
  const std::vector<double> periods{0.1, 0.5, 1};
  const auto one = response_spectrum(GroundMotion(HarmonicSum{{{2, 0.4, 0.3}}, 4}), periods, 0.05);
  const auto other = response_spectrum(GroundMotion(Harmonic{2, 0.4, 4, 0, 0.3}), periods, 0.05);
  for (std::size_t i = 0; i < periods.size(); ++i) EXPECT_NEAR(one[i].sd, other[i].sd, 1e-12);
}

TEST(InitialVelocity, KeepsAHarmonicAccelerationFromDrifting) {
  const double a = 3, period = 0.6, phase = 0.4, w = 2 * pi / period;
  const GroundMotion motion =
      GroundMotion(Harmonic{a, period, 60, 0, phase}).with_initial_motion(-a / w * std::cos(phase));
  for (const double t : {0.0, 0.1, 7.3, 59.9}) {
    EXPECT_NEAR(motion.velocity(t), -a / w * std::cos(w * t + phase), 1e-13) << t;
    EXPECT_NEAR(motion.displacement(t), -a / (w * w) * (std::sin(w * t + phase) - std::sin(phase)), 1e-13) << t;
  }
  EXPECT_TRUE(test::mentions(motion.source(), {"3 m/s^2", "0.6 s", "22.9183 deg", "60 s", "-0.2639 m/s"}));
}

TEST(InitialVelocity, IsAddedToEveryMotion) {
  for (const GroundMotion& rest : {GroundMotion(Pulse{Pulse::Shape::half_sine, 2, 0.7, 0.1}),
                                   GroundMotion(Samples{{0.1, 0.2, 0.5}, {1, -2, 3}})}) {
    const GroundMotion moved = rest.with_initial_motion(0.3, -0.05);
    for (const double t : {0.0, 0.05, 0.15, 0.4, 2.0}) {
      EXPECT_DOUBLE_EQ(moved.velocity(t), rest.velocity(t) + 0.3);
      EXPECT_DOUBLE_EQ(moved.displacement(t), rest.displacement(t) + 0.3 * t - 0.05);
      EXPECT_EQ(moved.acceleration(t), rest.acceleration(t));
    }
    EXPECT_EQ(moved.source(), rest.source() + ", from 0.3 m/s, from -50 mm");
  }
}

TEST(Displacement, ByHarmonicsIsMetWithoutDrift) {
  const Harmonic one{0.05, 0.8, 100, 0, 0.7};
  const GroundMotion motion = motion_of_displacement(one);
  const GroundMotion sum = motion_of_displacement(HarmonicSum{{{0.05, 0.8, 0.7}, {-0.01, 0.3}}, 100});
  for (const double t : {0.0, 0.3, 12.3, 99.99}) {
    const double d = 0.05 * std::sin(2 * pi * t / 0.8 + 0.7), w = 2 * pi / 0.8;
    EXPECT_NEAR(motion.displacement(t), d, 1e-13) << t;
    EXPECT_NEAR(motion.velocity(t), 0.05 * w * std::cos(w * t + 0.7), 1e-13) << t;
    EXPECT_NEAR(motion.acceleration(t), -w * w * d, 1e-11) << t;
    EXPECT_NEAR(sum.displacement(t), d - 0.01 * std::sin(2 * pi * t / 0.3), 1e-13) << t;
  }
}

TEST(Displacement, OfSamplesIsMetAtEachAndSmoothBetween) {
  std::vector<double> times, displacements;
  for (int i = 0; i <= 4000; ++i) {
    times.push_back(0.01 * i);
    displacements.push_back(0.1 * (1 - std::cos(1.3 * times.back())) * std::exp(-0.05 * times.back()));
  }
  const GroundMotion motion = motion_of_displacement(times, displacements);
  for (std::size_t i = 0; i < times.size(); i += 7)
    EXPECT_NEAR(motion.displacement(times[i]), displacements[i], 1e-13) << i;
  EXPECT_EQ(motion.velocity(0), 0);
  EXPECT_NEAR(motion.acceleration_before(40), 0, 1e-15);
  EXPECT_EQ(motion.sample_step(), 0.01);
  // The interpolation error of a smooth function is h^4/384 times its fourth derivative, which is below 0.3 m/s^4.
  for (const double t : {3.123, 11.4567, 25.005})
    EXPECT_NEAR(motion.displacement(t), 0.1 * (1 - std::cos(1.3 * t)) * std::exp(-0.05 * t), 1e-11) << t;
}

TEST(Displacement, MovesSupportsByWhatIsGiven) {
  const std::vector<GroundMotion> grounds{motion_of_displacement(Harmonic{0.02, 0.5, 10, 0, pi / 2}),
                                          motion_of_displacement(HarmonicSum{{{0.03, 0.7, 0.2}}, 10})};
  const SupportMotion motion(grounds, std::vector<std::array<int, 3>>{{0, -1, -1}, {1, -1, -1}});
  for (const double t : {0.0, 0.33, 9.0}) {
    double d = 0, v = 0;
    motion.displacement(t, [&](std::size_t, int, double amount) { d += amount; });
    motion.velocity(t, [&](std::size_t, int, double amount) { v += amount; });
    EXPECT_NEAR(d, 0.03 * std::sin(2 * pi * t / 0.7 + 0.2) - 0.02 * std::cos(4 * pi * t), 1e-14);
    EXPECT_NEAR(v, 0.03 * 2 * pi / 0.7 * std::cos(2 * pi * t / 0.7 + 0.2) + 0.02 * 4 * pi * std::sin(4 * pi * t),
                1e-13);
  }
}

TEST(Delayed, WaitsWhereItStands) {
  // At a phase of 90 degrees the ground starts from rest at a nonzero displacement.
  const GroundMotion cosine = motion_of_displacement(Harmonic{0.02, 0.5, 10, 0, pi / 2}), later = cosine.delayed(0.3);
  EXPECT_EQ(cosine.initial_velocity(), 0);
  EXPECT_DOUBLE_EQ(later.displacement(0.2), 0.02);
  EXPECT_NEAR(later.displacement(0.7), cosine.displacement(0.4), 1e-15);
  const GroundMotion sum =
      motion_of_displacement(HarmonicSum{{{0.02, 0.5, pi / 2}, {0.1, 0.3, 1.5 * pi}}, 10}).delayed(0.3);
  EXPECT_NEAR(sum.displacement(0.7), 0.02 * std::cos(1.6 * pi) - 0.1 * std::cos(pi * 0.8 / 0.3), 1e-14);
}

TEST(NewMotions, WrongValuesAreRefused) {
  const double nan = std::nan("");
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(Harmonic{1, 1, 1, 0, nan}); }), {"phase"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(HarmonicSum{{}, 1}); }), {"ground"}));
  EXPECT_TRUE(
      test::mentions(refusal([&] { return GroundMotion(HarmonicSum{{{1, 1}, {1, -1}}, 1}); }), {"-1", "period"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(HarmonicSum{{{1, 1, infinity}}, 1}); }), {"phase"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(HarmonicSum{{{1, 1}}, 0}); }), {"0", "duration"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion().with_initial_motion(1); }), {"ground"}));
  EXPECT_TRUE(
      test::mentions(refusal([&] { return GroundMotion(Harmonic{1, 1, 1}).with_initial_motion(nan); }), {"ground"}));
  EXPECT_TRUE(test::mentions(
      refusal([&] { return GroundMotion(Harmonic{1, 1, 1}).with_initial_motion(0.3).delayed(1); }), {"0.3 m/s"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return motion_of_displacement(Harmonic{1, 0, 1}); }), {"0", "period"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return motion_of_displacement(Harmonic{1, 1, 1, 0.5}); }), {"ground"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return motion_of_displacement({0, 1}, {0}); }), {"2"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return motion_of_displacement({0, 1, 1}, {0, 1, 2}); }), {"2"}));
}

}  // namespace motions_test
}  // namespace pounding
