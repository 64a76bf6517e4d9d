/// Keys of a ground motion beyond its kind: phases, sums, displacements, initial velocities, steps of records.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "ground/motion_section.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace motion_input_test {

constexpr double pi = std::numbers::pi;
constexpr double g = 9.80665;

class MotionInput : public test::MotionSection {
 protected:
  void SetUp() override {
    MotionSection::SetUp();
    std::ofstream(folder_ / "bare.txt") << "0 10 -20\n5\n";
    std::ofstream(folder_ / "two.csv") << "t;ns [g];ew [g]\n0,0;0,1;0,2\n0,5;-0,3;0,4\n";
    std::ofstream(folder_ / "moved.csv") << "t [s],d [mm]\n0,0\n0.5,30\n1,20\n";
    std::ofstream(folder_ / "acc.csv") << "time,acc (g)\n0,0\n0.02,0.5\n0.04,-0.25\n";
  }
};

TEST_F(MotionInput, HarmonicHasAPhaseAndAnInitialVelocity) {
  const GroundMotion motion =
      read("harmonic: {amplitude: 2, period: 0.5, duration: 3, phase: 30 deg, initial_velocity: -0.1 m/s}");
  EXPECT_DOUBLE_EQ(motion.acceleration(0), 1);
  EXPECT_EQ(motion.initial_velocity(), -0.1);
  EXPECT_DOUBLE_EQ(read("harmonic: {amplitude: 2, period: 0.5, duration: 3, phase: 1 rad}").acceleration(0),
                   2 * std::sin(1.0));
  EXPECT_DOUBLE_EQ(read("harmonic: {amplitude: 2, period: 0.5, duration: 3, phase: -1}").acceleration(0),
                   -2 * std::sin(1.0));
}

TEST_F(MotionInput, SumHasOneDuration) {
  const GroundMotion motion = read(
      "{sum: [{amplitude: 0.2 g, period: 0.5 s}, {amplitude: 1, period: 0.2, phase: 90 deg}], duration: 4, "
      "initial_velocity: 0.2}");
  EXPECT_NEAR(motion.acceleration(0.05), 0.2 * g * std::sin(0.2 * pi) + std::cos(0.5 * pi), 1e-14);
  EXPECT_EQ(motion.duration(), 4);
  EXPECT_EQ(motion.velocity(0), 0.2);
}

TEST_F(MotionInput, DisplacementIsAHarmonicASumOrARecord) {
  const GroundMotion harmonic =
      read("displacement: {harmonic: {amplitude: 20 mm, period: 0.5, duration: 3, phase: 90 deg}}");
  EXPECT_DOUBLE_EQ(harmonic.displacement(0), 0.02);
  EXPECT_NEAR(harmonic.displacement(0.125), 0, 1e-16);
  const GroundMotion sum =
      read("displacement: {sum: [{amplitude: 2 cm, period: 0.5}, {amplitude: 1 cm, period: 1}], duration: 3}");
  EXPECT_NEAR(sum.displacement(0.25), 0.01, 1e-15);
  const GroundMotion record = read("displacement: {record: moved.csv, scale: -0.5}");
  EXPECT_NEAR(record.displacement(0.5), -0.015, 1e-15);
  EXPECT_EQ(record.velocity(0), 0);
  EXPECT_TRUE(test::mentions(record.source(), {"moved.csv", "0.5 s", "3", "-0.5"}));
  const GroundMotion moving = read("displacement: {record: moved.csv, scale: -0.5, initial_velocity: 0.1}");
  EXPECT_DOUBLE_EQ(moving.velocity(0), 0.1);
  EXPECT_NEAR(moving.displacement(1), -0.01, 1e-15);
}

TEST_F(MotionInput, RecordTakesAStepAndAChannel) {
  const GroundMotion values = read("{record: bare.txt, units: gal, step: 50 ms}");
  EXPECT_DOUBLE_EQ(values.acceleration(0.05), 0.1);
  EXPECT_NEAR(values.acceleration_before(0.15), 0.05, 1e-15);
  EXPECT_DOUBLE_EQ(read("{record: two.csv, channel: ew}").acceleration(0), 0.2 * g);
  EXPECT_DOUBLE_EQ(read("{record: two.csv, channel: 1, initial_velocity: 3 cm/s}").velocity(0), 0.03);
}

TEST_F(MotionInput, RecordErrorsSayWhatToType) {
  EXPECT_TRUE(test::mentions(error("{record: bare.txt, units: gal}"),
                             {"m.yaml:1:10", "record", "step: 0.01 s", "bare.txt:2", "3"}));
  EXPECT_TRUE(test::mentions(error("{record: bare.txt, step: 0.02}"),
                             {"m.yaml:1:10", "record", "units:", "bare.txt", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(
      test::mentions(error("{record: acc.csv, step: 0.02}"), {"m.yaml:1:10", "record", "step", "acc.csv:2", "0.02 s"}));
  EXPECT_TRUE(test::mentions(error("{record: bare.txt, units: g, step: 0}"), {"m.yaml:1:36", "step", "0.5 s"}));
  EXPECT_TRUE(test::mentions(error("{record: two.csv}"), {"m.yaml:1:10", "record", "channel:", "two.csv", "2", "3"}));
  EXPECT_TRUE(test::mentions(error("{record: acc.csv, units: m/s^2}"),
                             {"m.yaml:1:10", "record", "units", "acc.csv:1", "m/s^2"}));
  EXPECT_TRUE(test::mentions(
      error("{record: moved.csv}"),
      {"m.yaml:1:10", "record", "mm", "displacement: {record: FILE}", "moved.csv:1", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(test::mentions(error("displacement: {record: acc.csv}"),
                             {"m.yaml:1:24", "displacement.record", "g", "acc.csv:1"}));
  EXPECT_TRUE(test::mentions(error("displacement: {record: moved.csv, pga: 1}"),
                             {"m.yaml:1:35", "displacement", "pga", "record", "channel", "units"}));
}

TEST_F(MotionInput, AnglesAreNotMistaken) {
  EXPECT_TRUE(test::mentions(error("harmonic: {amplitude: 2, period: 0.5, duration: 3, phase: 90}"),
                             {"m.yaml:1:59", "harmonic.phase", "90 deg", "-360 deg", "5156.62 deg"}));
  EXPECT_TRUE(test::mentions(error("harmonic: {amplitude: 2, period: 0.5, duration: 3, phase: 5 %}"),
                             {"m.yaml:1:59", "harmonic.phase", "90 deg", "5 %"}));
  EXPECT_TRUE(test::mentions(error("harmonic: {amplitude: 2, period: 0.5, duration: 3, phase: 90 s}"),
                             {"m.yaml:1:59", "harmonic.phase", "5 %", "90 s"}));
}

TEST_F(MotionInput, KeysInTheWrongPlaceAreRefused) {
  EXPECT_TRUE(test::mentions(error("{harmonic: {amplitude: 1, period: 1}, duration: 3}"),
                             {"m.yaml:1:39", "duration", "harmonic: {..., duration: 3}"}));
  EXPECT_TRUE(test::mentions(error("{harmonic: {amplitude: 1, period: 1, duration: 3}, initial_velocity: 1}"),
                             {"m.yaml:1:52", "initial_velocity", "record"}));
  EXPECT_TRUE(test::mentions(error("{pulse: {shape: sine, amplitude: 1, duration: 1}, step: 0.1}"),
                             {"m.yaml:1:51", "step", "record"}));
  EXPECT_TRUE(test::mentions(error("{sum: [{amplitude: 1, period: 1, duration: 3}], duration: 3}"),
                             {"m.yaml:1:34", "sum[0]", "duration", "amplitude", "period", "phase"}));
  EXPECT_TRUE(test::mentions(error("{sum: [{amplitude: 1, period: 1}]}"), {"m.yaml:1:1", "duration: 10 s"}));
  EXPECT_TRUE(test::mentions(error("{sum: [], duration: 3}"),
                             {"m.yaml:1:7", "sum", "sum: [{amplitude: 0.35 g, period: 0.5 s}]"}));
  EXPECT_TRUE(test::mentions(error("{sum: {amplitude: 1, period: 1}, duration: 3}"), {"m.yaml:1:7", "sum", "[a, b]"}));
  EXPECT_TRUE(
      test::mentions(error("displacement: {}"),
                     {"m.yaml:1:15", "displacement",
                      "displacement: {harmonic: {amplitude: 20 mm, period: 0.5 s, duration: 10 s}}", "record", "sum"}));
  EXPECT_TRUE(test::mentions(error("displacement: {pulse: {}}"),
                             {"m.yaml:1:16", "displacement", "pulse", "record", "harmonic", "sum"}));
  EXPECT_TRUE(test::mentions(error("displacement: {harmonic: {}, sum: []}"),
                             {"m.yaml:1:30", "displacement.sum", "harmonic", "sum"}));
  EXPECT_TRUE(test::mentions(error("displacement: {harmonic: {amplitude: 0.2 g, period: 1, duration: 1}}"),
                             {"m.yaml:1:38", "displacement.harmonic.amplitude", "20 mm", "0.2 g"}));
  EXPECT_TRUE(
      test::mentions(error("displacement: {harmonic: {amplitude: 1 mm, period: 1, duration: 1, initial_velocity: 1}}"),
                     {"m.yaml:1:68", "displacement.harmonic", "initial_velocity", "amplitude", "period", "duration"}));
  EXPECT_TRUE(test::mentions(error("{harmonic: {amplitude: 1, period: 1, duration: 1}, displacement: {}}"),
                             {"m.yaml:1:52", "displacement", "harmonic", "displacement"}));
}

}  // namespace motion_input_test
}  // namespace pounding
