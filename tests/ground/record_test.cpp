#include <pounding/ground/record.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/core/error.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace record_test {

constexpr double g = 9.80665;
constexpr double pi = std::numbers::pi;

Record read(const std::string& text, const std::string& units = {}) {
  return read_record_text(text, "r.txt", {.units = units});
}

std::string error_of(const std::string& text, const std::string& units = {}) {
  return test::refusal<InputError>([&] { read(text, units); });
}

const std::string new_header =
    "PEER NGA STRONG MOTION DATABASE RECORD\n"
    "Nowhere, 1/1/2001, Station 1, 90\n"
    "ACCELERATION TIME SERIES IN UNITS OF G\n"
    "NPTS=      7, DT=   .0100 SEC,\n";
const std::string old_header =
    "PEER STRONG MOTION DATABASE RECORD. PROCESSING BY NOBODY.\n"
    "NOWHERE 01/01/01, STATION 1, 090\n"
    "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz  LP=40.0 Hz\n"
    "    7    0.0100    NPTS, DT\n";
const std::string values =
    "   .0000000E+00   .1000000E-01  -.2500000E+00   .3000000E-03  -.1000000E-02\n"
    "  0.5  -1.e-1\n";

void expect_the_seven_values(const Record& record) {
  EXPECT_EQ(record.format, "PEER AT2");
  EXPECT_EQ(record.unit, "G");
  ASSERT_EQ(record.points(), 7u);
  EXPECT_TRUE(record.samples.uniform);
  EXPECT_DOUBLE_EQ(record.step(), 0.01);
  const std::vector<double> expected = {0, 0.01, -0.25, 0.0003, -0.001, 0.5, -0.1};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_DOUBLE_EQ(record.samples.accelerations[i], expected[i] * g) << i;
    EXPECT_DOUBLE_EQ(record.samples.times[i], 0.01 * static_cast<double>(i)) << i;
  }
  EXPECT_DOUBLE_EQ(record.measures.pga, 0.5 * g);
}

TEST(PeerRecord, NewHeaderIsRead) {
  const Record record = read(new_header + values);
  expect_the_seven_values(record);
  EXPECT_EQ(record.title, "Nowhere, 1/1/2001, Station 1, 90");
}

TEST(PeerRecord, OldHeaderIsRead) { expect_the_seven_values(read(old_header + values)); }

TEST(PeerRecord, LineEndsOfWindowsAreRead) {
  std::string text;
  for (const char c : new_header + values) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expect_the_seven_values(read(text));
}

TEST(PeerRecord, OtherUnitsAreConverted) {
  std::string text = new_header + values;
  text.replace(text.find("OF G"), 4, "OF CM/SEC/SEC");
  const Record record = read(text);
  EXPECT_EQ(record.unit, "CM/SEC/SEC");
  EXPECT_DOUBLE_EQ(record.measures.pga, 0.005);
}

TEST(PeerRecord, WrongCountIsAnErrorWithItsLine) {
  EXPECT_TRUE(test::mentions(error_of(new_header + "0 1 2 3 4\n5\n\n"), {"r.txt:6", "7", "NPTS"}));
  EXPECT_TRUE(test::mentions(error_of(new_header + values + " 0.1\n"), {"r.txt:7", "NPTS"}));
}

TEST(PeerRecord, BrokenValueIsAnErrorWithItsLine) {
  EXPECT_TRUE(test::mentions(error_of(new_header + "0 1 2 3 4\n5 *****\n"), {"*****", "r.txt:6"}));
  EXPECT_TRUE(test::mentions(error_of(new_header + "0 1 NaN 3 4\n5 6\n"), {"NaN", "r.txt:5"}));
}

TEST(PeerRecord, BrokenHeaderIsAnErrorWithItsLine) {
  const std::string top = "title\nstation\nIN UNITS OF G\n";
  EXPECT_TRUE(test::mentions(error_of(top + "NPTS= , DT= .01 SEC\n0 1\n"), {"NPTS= 5372, DT= .0100 SEC", "r.txt:4"}));
  EXPECT_TRUE(test::mentions(error_of(top + "NPTS= 2, DT= 0 SEC\n0 1\n"), {"r.txt:4", "0", "DT"}));
  EXPECT_TRUE(test::mentions(error_of(top + "NPTS= 2.5, DT= 1 SEC\n0 1\n"), {"r.txt:4", "2.5", "NPTS"}));
}

TEST(PeerRecord, VelocityFileIsRefused) {
  std::string text = new_header + values;
  text.replace(text.find("ACCELERATION TIME SERIES IN UNITS OF G"), 38, "VELOCITY TIME SERIES IN UNITS OF CM/S");
  EXPECT_TRUE(test::mentions(error_of(text), {"CM/S", "r.txt:3", "m/s^2", "cm/s^2"}));
}

TEST(PeerRecord, UnitIsNeverGuessed) {
  const std::string text = "title\nNPTS= 2, DT= .01\n0 1\n";
  EXPECT_TRUE(test::mentions(error_of(text), {"units:", "r.txt", "m/s^2", "cm/s^2"}));
  EXPECT_DOUBLE_EQ(read(text, "g").measures.pga, g);
}

TEST(TwoColumns, EverySeparatorIsRead) {
  for (const char* text : {"0,0\n0.02,1.5\n0.04,-2\n", "0;0\n0.02; 1.5\n0.04 ;-2\n", "0 0\n  0.02\t1.5  \n0.04   -2",
                           "0, 0\r\n0.02, 1.5\r\n0.04, -2\r\n",
                           "\xEF\xBB\xBF"
                           "0,0\n0.02,1.5\n0.04,-2\n"}) {
    const Record record = read(text, "m/s^2");
    EXPECT_EQ(record.format, "two columns");
    EXPECT_EQ(record.samples.times, (std::vector<double>{0, 0.02, 0.04})) << text;
    EXPECT_EQ(record.samples.accelerations, (std::vector<double>{0, 1.5, -2})) << text;
    EXPECT_TRUE(record.samples.uniform);
  }
}

TEST(TwoColumns, NamesMayStateTheUnits) {
  EXPECT_DOUBLE_EQ(read("time,acc (g)\n0,0\n0.02,1\n").measures.pga, g);
  EXPECT_DOUBLE_EQ(read("time (s), acc (cm/s^2)\n0,0\n0.02,100\n").measures.pga, 1);
  EXPECT_DOUBLE_EQ(read("time [s]; acc [m/s**2]\n0;0\n0.02;100\n").measures.pga, 100);
  EXPECT_DOUBLE_EQ(read("\"time (sec)\",\"acc (gal)\"\n0,0\n0.02,100\n").measures.pga, 1);
  EXPECT_DOUBLE_EQ(read("t (s)  a (g)\n0 0\n0.02 1\n").measures.pga, g);
  EXPECT_DOUBLE_EQ(read("time a(g)\n0 0\n0.02 1\n").measures.pga, g);
  const Record milliseconds = read("time (ms),acc (g)\n0,0\n20,1\n");
  EXPECT_DOUBLE_EQ(milliseconds.samples.times[1], 0.02);
  EXPECT_EQ(milliseconds.unit, "g");
}

TEST(TwoColumns, CommentsAndBlankLinesAreSkipped) {
  const Record record = read("# from nowhere, 2 columns\n% 1 2 3\n\ntime,acc (g)\n0,0\n# middle\n0.02,1\n\n");
  EXPECT_EQ(record.points(), 2u);
}

TEST(TwoColumns, TimesNeedNotBeEven) {
  const Record record = read("0 0\n0.1 1\n0.15 2\n", "g");
  EXPECT_FALSE(record.samples.uniform);
  EXPECT_EQ(record.step(), 0);
  EXPECT_TRUE(test::mentions(record.summary(), {"r.txt", "3"}));
}

TEST(TwoColumns, ErrorsSayWhere) {
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1 x\n", "g"), {"x", "r.txt:2"}));
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1 nan\n", "g"), {"nan", "r.txt:2"}));
  EXPECT_TRUE(test::mentions(error_of("0,0\n0.1,\n", "g"), {"r.txt:2"}));
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1\n", "g"), {"r.txt:2"}));
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1 1\n0.2 1 1\n", "g"), {"r.txt:3", "2"}));
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1 1\n0.1 2\n", "g"), {"r.txt:3", "0.1"}));
  EXPECT_TRUE(test::mentions(error_of("-0.1 0\n0.1 1\n", "g"), {"r.txt:1", "-0.1"}));
  EXPECT_TRUE(test::mentions(error_of("0 0\nt,a\n", "g"), {"t", "r.txt:2"}));
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1 -0.2\n-0.3 0.1\n", "g"), {"r.txt:3", "-0.3"}));
  EXPECT_TRUE(test::mentions(error_of("0.1 0.2\n0.05 0.1\n", "g"), {"step: 0.01 s", "r.txt:2", "0.05"}));
  EXPECT_TRUE(test::mentions(error_of("time,acc (g)\n0,0\n"), {"r.txt"}));
  EXPECT_TRUE(test::mentions(error_of(""), {"r.txt"}));
}

TEST(TwoColumns, UnitErrorsSayWhatToDo) {
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1 1\n"), {"units:", "r.txt", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(test::mentions(error_of("time,acc (mm)\n0,0\n0.1,1\n"),
                             {"mm", "displacement: {record: FILE}", "r.txt:1", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(test::mentions(error_of("time,acc (g)\n0,0\n0.1,1\n", "m/s^2"), {"units", "r.txt:1", "m/s^2"}));
  EXPECT_NO_THROW(read("time,acc (cm/s^2)\n0,0\n0.1,1\n", "gal"));
  EXPECT_TRUE(test::mentions(error_of("time (mm),acc (g)\n0,0\n0.1,1\n"), {"mm", "r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of("time (q),acc (g)\n0,0\n0.1,1\n"), {"q", "r.txt:1"}));
}

TEST(Record, MissingFileIsNamed) {
  try {
    read_record("no/such.AT2");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"no/such.AT2"}));
  }
}

TEST(Record, BecomesAGroundMotion) {
  const GroundMotion motion = scaled(read("0 0\n0.02 1\n0.04 0\n", "m/s^2"), 3);
  EXPECT_DOUBLE_EQ(motion.acceleration(0.01), 1.5);
  EXPECT_TRUE(test::mentions(motion.source(), {"r.txt", "0.02 s", "m/s^2", "3"}));
}

TEST(Measures, TriangleHasItsClosedForms) {
  // a rises from 0 to 2 in 1 s and returns in 1 s: v(2) = 2, u(2) = 2, integral of a^2 = 2 * 4/3.
  const RecordMeasures m = measure({.times = {0, 1, 2}, .accelerations = {0, 2, 0}});
  EXPECT_DOUBLE_EQ(m.pga, 2);
  EXPECT_DOUBLE_EQ(m.pgv, 2);
  EXPECT_DOUBLE_EQ(m.pgd, 2);
  EXPECT_DOUBLE_EQ(m.arias, pi / (2 * g) * 8 / 3);
  // Up to t <= 1 the integral is 4 t^3/3: it reaches 5 % of 8/3 at t^3 = 0.1. The other end is symmetric.
  EXPECT_NEAR(m.t5, std::cbrt(0.1), 1e-14);
  EXPECT_NEAR(m.t95, 2 - std::cbrt(0.1), 1e-14);
  EXPECT_NEAR(m.significant_duration(), 2 - 2 * std::cbrt(0.1), 1e-14);
}

TEST(Measures, PeaksBetweenSamplesAreFound) {
  // a = 1 - t: v = t - t^2/2 peaks at t = 1 with 1/2; u = t^2/2 - t^3/6 peaks at t = 2 with 2/3, v(3) = -3/2.
  const RecordMeasures m = measure({.times = {0, 3}, .accelerations = {1, -2}});
  EXPECT_DOUBLE_EQ(m.pgv, 1.5);
  EXPECT_DOUBLE_EQ(m.pgd, 2.0 / 3);
  // Cut off at t = 1.5, both end values of v are below its peak.
  EXPECT_DOUBLE_EQ(measure({.times = {0, 1.5}, .accelerations = {1, -0.5}}).pgv, 0.5);
  // With constant deceleration after 1 s the displacement peaks at t = 2.
  const RecordMeasures turned = measure({.times = {0, 1, 1 + 1e-12, 3}, .accelerations = {1, 1, -1, -1}});
  EXPECT_NEAR(turned.pgv, 1, 1e-11);
  EXPECT_NEAR(turned.pgd, 1, 1e-11);
}

TEST(Measures, SineHasItsClosedForms) {
  // a = sin w t over one period: pgv = 2/w, pgd = 2 pi/w^2, integral of a^2 = T/2.
  const double w = 4;
  Samples samples;
  for (int i = 0; i <= 4000; ++i) {
    samples.times.push_back(2 * pi / w * i / 4000);
    samples.accelerations.push_back(std::sin(w * samples.times.back()));
  }
  const RecordMeasures m = measure(samples);
  EXPECT_NEAR(m.pgv, 2 / w, 1e-6);
  EXPECT_NEAR(m.pgd, 2 * pi / (w * w), 1e-6);
  EXPECT_NEAR(m.arias, pi / (2 * g) * pi / w, 1e-6);
}

TEST(Measures, RecordOfZerosIsZero) {
  const RecordMeasures m = measure({.times = {0, 1}, .accelerations = {0, 0}});
  EXPECT_EQ(m.arias, 0);
  EXPECT_EQ(m.pgd, 0);
  EXPECT_EQ(m.significant_duration(), 0);
}

}  // namespace record_test
}  // namespace pounding
