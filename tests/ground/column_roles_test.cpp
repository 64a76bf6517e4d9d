// Sample-number columns, lines with the number of values and the step, padding, and warnings about implausible records.

#include <pounding/ground/record.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <pounding/core/units.hpp>
#include "ground/record_text.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace column_roles_test {

constexpr double g = standard_gravity;
using Values = std::vector<double>;
using Texts = std::vector<std::string>;

using test::error_of;
using test::read;

// 200 values with a peak of 0.3 of the unit.
double value(int i) { return 0.3 * std::sin(0.31 * i) * std::exp(-1e-4 * (i - 100) * (i - 100)); }

std::string rows(const char* format, int count = 200, double step = 0.005, int first = 0, double factor = 1) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += fmt::format(fmt::runtime(format), fmt::arg("i", i + first), fmt::arg("t", i * step),
                        fmt::arg("a", factor * value(i)));
  return text;
}

void expect_motion(const Record& record, double step = 0.005) {
  ASSERT_EQ(record.points(), 200u) << record.summary();
  EXPECT_NEAR(record.step(), step, 1e-12);
  EXPECT_NEAR(record.samples.accelerations[37], g * value(37), 1e-5);
  EXPECT_EQ(record.warnings, Texts{});
}

TEST(Counters, StandInFrontOfTheTimes) {
  for (const int first : {0, 1, 17}) {
    expect_motion(read("No.,Time(s),Acc(g)\n" + rows("{i},{t:.3f},{a:.7e}\n", 200, 0.005, first)));
    expect_motion(read("Point Time(s) Acc(g)\n" + rows("{i} {t:.3f} {a:.7e}\n", 200, 0.005, first)));
    expect_motion(read(rows("{i}\t{t:.3f}\t{a:.7e}\n", 200, 0.005, first), {.units = "g"}));
    expect_motion(read("#;t [ms];a [g]\n" + rows("{i};{t:.1f};{a:.7e}\n", 200, 5, first)));
  }
}

TEST(Counters, StandAnywhere) {
  expect_motion(read("Time(s),No.,Acc(g)\n" + rows("{t:.3f},{i},{a:.7e}\n")));
  expect_motion(read("Time(s),Acc(g),Sample\n" + rows("{t:.3f},{a:.7e},{i}\n")));
  EXPECT_EQ(read("1 0 0.1\n2 0.01 0.3\n3 0.05 -0.2\n4 0.06 0.1\n", {.units = "g"}).samples.times,
            (Values{0, 0.01, 0.05, 0.06}));
  expect_motion(read("Acc(g),Time(s)\n" + rows("{a:.7e},{t:.3f}\n")));
}

TEST(Counters, LeaveTheNumbersOfChannelsToTheValues) {
  const std::string text = "No.,Time(s),NS(g),EW(g)\n" + rows("{i},{t:.3f},{a:.7e},1\n");
  EXPECT_TRUE(test::mentions(error_of(text), {"channel:", "r.txt", "2", "3", "4"}));
  expect_motion(read(text, {.channel = "1"}));
}

TEST(Counters, GiveWayToTheStep) {
  for (const char* const header : {"No.,Acc(g)\n", "Time(s),Acc(g)\n", "i;acc (g)\n", "# acc (g)\n"})
    for (const char* const row : {"{i},{a:.7e}\n"}) {
      const bool semicolons = std::string(header).find(';') != std::string::npos;
      expect_motion(read(header + rows(semicolons ? "{i};{a:.7e}\n" : row), {.step = 0.005}));
    }
  expect_motion(read("No.,Time(s),Acc(g)\n" + rows("{i},{t:.3f},{a:.7e}\n"), {.step = 0.005}));
  expect_motion(read(rows("{i} {a:.7e}\n", 200, 0, 1), {.units = "g", .step = 0.005}));
  EXPECT_TRUE(test::mentions(error_of("No.,Time(s),Acc(g)\n" + rows("{i},{t:.3f},{a:.7e}\n"), {.step = 0.01}),
                             {"step", "r.txt:2", "0.005 s"}));
  EXPECT_TRUE(test::mentions(error_of(rows("{i} {a:.7e} {a:.7e}\n"), {.units = "g", .step = 0.005}),
                             {"channel:", "r.txt", "2", "3"}));
}

TEST(Counters, AreNoTimesWithoutAWarning) {
  EXPECT_TRUE(test::mentions(error_of("No.,Acc(g)\n" + rows("{i},{a:.7e}\n")), {"No.", "step: 0.01 s", "r.txt:2"}));
  for (const char* const header : {"t,a (g)\n", "# units: g\n", "time (s), acc (g)\n"}) {
    const Texts warnings = read(header + rows("{i},{a:.7e}\n")).warnings;
    ASSERT_EQ(warnings.size(), 1u) << header;
    EXPECT_TRUE(test::mentions(warnings[0], {"step: 0.01 s", "2"}));
  }
  expect_motion(read("t (ms), a (g)\n" + rows("{i},{a:.7e}\n")), 0.001);
}

TEST(Counters, OfAnySpacingGiveWayToAStep) {
  const RecordOptions at_step{.units = "g", .step = 0.005};
  for (const double spacing : {2.0, 5.0, 10.0}) {
    expect_motion(read(rows("{t:.0f} {a:.7e}\n", 200, spacing), at_step));
    expect_motion(read("n,acc\n" + rows("{t:.0f},{a:.7e}\n", 200, spacing), at_step));
  }
  EXPECT_TRUE(test::mentions(error_of("time (s),acc\n" + rows("{t:.0f},{a:.7e}\n", 200, 2), at_step),
                             {"step", "r.txt:2", "2 s"}));
}

TEST(Counters, StandInRecordsOfDisplacementAndForce) {
  const Record moved = read("No.,Time(s),Disp(mm)\n" + rows("{i},{t:.3f},{a:.7e}\n"), {.displacement = true});
  EXPECT_NEAR(moved.step(), 0.005, 1e-12);
  const RecordOptions force{.force = dimension::force};
  const Record pushed = read("No.,Time(s),Force(kN)\n" + rows("{i},{t:.2f},{a:.5f}\n", 200, 0.01), force);
  EXPECT_NEAR(pushed.step(), 0.01, 1e-12);
  EXPECT_NEAR(pushed.samples.accelerations[37], 1e3 * value(37), 1e-2);
  EXPECT_EQ(pushed.warnings, Texts{});
  EXPECT_EQ(read("t,Force(kN)\n" + rows("{i},{a:.5f}\n"), force).warnings.size(), 1u);
  EXPECT_EQ(read("time,Force(kN)\n0,0\n10,5\n30,5\n", force).warnings, Texts{}) << "slow forces are usual";
}

TEST(LinesOfCounts, AboveTimesNeedNoStep) {
  for (const char* const text : {"200 0.005\n", "200\n0.005\n", "0.005 200\n"})
    expect_motion(read(text + rows("{t:.3f} {a:.7e}\n"), {.units = "g"}));
}

TEST(LinesOfCounts, AreNoSamples) {
  const RecordOptions at_step{.units = "g", .step = 0.005};
  for (const char* const lines :
       {"200\n0.005\n", "0.005\n200\n", "200 0.005\n", "0.005, 200\n", "Gilroy\n  200\n  5.000E-03\n"}) {
    const Record record = read(lines + rows("{a:.7e}\n"), at_step);
    expect_motion(record);
    EXPECT_TRUE(test::mentions(record.remark, {"0.005 s", "200"}));
  }
  expect_motion(read("200\n" + rows("{a:.7e}\n"), at_step));
  expect_motion(read("200\n" + rows("{t:.3f} {a:.7e}\n"), {.units = "g"}));
  std::string eight;
  for (int i = 0; i < 200; ++i) eight += fmt::format(" {:.6f}{}", value(i), i % 8 == 7 ? "\n" : "");
  expect_motion(read("200 0.005\n" + eight, at_step));
  EXPECT_TRUE(test::mentions(read("200\n0.005\n" + rows("{a:.7e}\n"), at_step).remark, {"0.005 s", "1", "2", "200"}));
}

TEST(LinesOfCounts, AreNamedWhereTheyDoNotFit) {
  const std::string values = rows("{a:.7e}\n");
  EXPECT_TRUE(
      test::mentions(error_of("200\n0.005\n" + values, {.units = "g"}), {"step: 0.005 s", "r.txt:1", "2", "200"}));
  EXPECT_TRUE(test::mentions(error_of("200\n0.005\n" + values, {.units = "g", .step = 0.01}),
                             {"step: 0.005 s", "r.txt:1", "0.01 s", "2", "200"}));
  const RecordOptions at_step{.units = "cm/s^2", .step = 0.005};
  EXPECT_TRUE(test::mentions(error_of("250\n0.005\n" + values, at_step), {"r.txt:1"}));
  EXPECT_TRUE(test::mentions(
      error_of("1940 5 18 4 36\n 12 7 3 2 1\n" + rows("{a:.5f} {a:.5f} {a:.5f} {a:.5f} {a:.5f}\n"), at_step),
      {"r.txt:1", "2"}));
  EXPECT_TRUE(
      test::mentions(test::only(read("32.795\n-115.55\n" + rows("{a:.5f}\n", 200, 0, 0, 100), at_step).warnings),
                     {"-115.55", "2", "202"}));
  EXPECT_TRUE(test::mentions(test::only(read("0.005\n" + rows("{a:.7e}\n"), {.units = "g", .step = 0.005}).warnings),
                             {"0.005", "1"}));
}

TEST(LinesOfCounts, AreNotSeenInShortOrWholeNumbers) {
  EXPECT_EQ(read("2\n5\n7\n", {.units = "g", .step = 0.01}).points(), 3u);
  std::string whole = "12\n";
  for (int i = 0; i < 30; ++i) whole += fmt::format("{}\n", i % 7);
  EXPECT_EQ(read(whole, {.units = "gal", .step = 0.01}).points(), 31u);
}

TEST(Lines, OfUnequalLengthNameTheMissingStep) {
  EXPECT_TRUE(test::mentions(error_of("Gilroy, g\n-0.1 0.2 0.3 0.4\n0.5 0.6 0.7 0.8\n0.9 1\n", {.units = "g"}),
                             {"step: 0.01 s", "r.txt:4", "2"}));
}

TEST(Padding, OfOldFilesIsIgnored) {
  const std::string at2 = "PEER\nnowhere\nIN UNITS OF G\nNPTS= 4, DT= .01\n 0 .1\n .2 -.1\n",
                    columns = "time,acc (g)\n0,0\n0.01,.1\n0.02,.2\n0.03,-.1\n";
  for (const std::string& text : {at2, columns}) {
    const Values values = read(text).samples.accelerations;
    for (const std::string& end : {std::string("\x1A"), std::string("\x1A\n"), std::string(512, '\0'),
                                   std::string("\f"), "\n\f\n\x1A" + std::string(7, '\0')}) {
      EXPECT_EQ(read(text + end).samples.accelerations, values);
      EXPECT_EQ(read(text.substr(0, text.size() - 1) + end).samples.accelerations, values);
    }
    EXPECT_EQ(read("\f" + text).samples.accelerations, values);
    EXPECT_NE(error_of(text + std::string("1\0", 2) + "2\n"), "taken");
  }
}

TEST(PeerDt, MayBeInMilliseconds) {
  const auto step = [](const std::string& line) {
    return read("a\nb\nIN UNITS OF G\n" + line + "\n 0 .1 -.2\n").step();
  };
  for (const char* const line : {"NPTS=    3, DT=   5.0 MSEC,", "NPTS= 3, DT= 5.0MSEC", "NPTS= 3, DT= 5 ms",
                                 "DT= 0.005 SEC, NPTS= 3", "NPTS= 3, DT= .0050 SEC", "NPTS= 3, DT=.5000E-02",
                                 "NPTS= 3, DT= .005 SECONDS", "3 0.005 NPTS, DT", "NPTS= 3 DT= .005 UNITS= G"})
    EXPECT_DOUBLE_EQ(step(line), 0.005) << line;
  EXPECT_TRUE(test::mentions(error_of("a\nb\nIN UNITS OF G\nNPTS= 3, DT= 5 FEET\n 0 .1 -.2\n"),
                             {"FEET", "r.txt:4", "SEC", "MSEC"}));
}

TEST(ImplausibleRecords, NameTheLikelyUnit) {
  const auto warnings = [](const std::string& text, const RecordOptions& options) {
    return read(text, options).warnings;
  };
  const std::string text = "t (s), a\n" + rows("{t:.3f},{a:.7e}\n", 200, 0.01, 0, 1000);
  const Texts in_g = warnings(text, {.units = "g"});
  ASSERT_EQ(in_g.size(), 1u);
  EXPECT_TRUE(test::mentions(in_g[0], {"0.005 g", "3 g", "cm/s^2"}));
  EXPECT_EQ(warnings(text, {.units = "cm/s^2"}), Texts{});
  const Texts weak = warnings("t (s), a\n" + rows("{t:.3f},{a:.7e}\n"), {.units = "cm/s^2"});
  ASSERT_EQ(weak.size(), 1u);
  EXPECT_TRUE(test::mentions(weak[0], {"g", "cm/s^2"}));
  const Texts moved =
      warnings("t (s), d\n" + rows("{t:.3f},{a:.7e}\n", 200, 0.01, 0, 100), {.units = "m", .displacement = true});
  ASSERT_EQ(moved.size(), 2u);
  EXPECT_TRUE(test::mentions(moved[1], {"5 m", "cm"}));
}

TEST(ImplausibleRecords, HaveLongSteps) {
  const Texts warnings = read("a\nb\nIN UNITS OF G\nNPTS= 3, DT= 5\n 0 .1 -.2\n").warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(test::mentions(warnings[0], {"5 s", "0.1 s"}));
  EXPECT_EQ(read("a\nb\nIN UNITS OF G\nNPTS= 3, DT= .1\n 0 .1 -.2\n").warnings, Texts{});
}

TEST(ImplausibleRecords, KeepTheirWarningsAsMotions) {
  const Record record = read("a\nb\nIN UNITS OF G\nNPTS= 3, DT= 5\n 0 .1 -.2\n");
  ASSERT_NE(scaled(record, 2).samples(), nullptr);
  EXPECT_EQ(scaled(record, 2).delayed(1).samples()->warnings, Texts{"record r.txt: " + record.warnings[0]});
}

}  // namespace column_roles_test
}  // namespace pounding
