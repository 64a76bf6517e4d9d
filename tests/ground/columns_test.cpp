/// Columns of numbers: with times or a constant step, one or several values per line, with the headers, units and
/// decimal commas found in practice.

#include <pounding/ground/record.hpp>

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/core/units.hpp>
#include "ground/record_text.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace columns_test {

constexpr double g = standard_gravity;
using Values = std::vector<double>;

using test::error_of;
using test::read;

const RecordOptions in_si{.units = "m/s^2"};
const RecordOptions at_step{.units = "m/s^2", .step = 0.02};

TEST(ValuesAtAStep, AreReadInOrderHoweverManyStandInALine) {
  for (const char* const text :
       {"0\n1.5\n-2\n0.25\n3\n", "0 1.5 -2\n0.25 3\n", "0,1.5,-2,0.25\n3", "# no times\n0;1.5\n-2;0.25\n3\n",
        "El Centro\nvalues follow\n0\t1.5\t-2\t0.25\t3\n"}) {
    const Record record = read(text, at_step);
    EXPECT_EQ(record.samples.accelerations, (Values{0, 1.5, -2, 0.25, 3})) << text;
    EXPECT_EQ(record.samples.times, (Values{0, 0.02, 2 * 0.02, 3 * 0.02, 4 * 0.02})) << text;
    EXPECT_TRUE(record.samples.uniform);
  }
  EXPECT_TRUE(test::mentions(read("0\n1\n", at_step).summary(), {"r.txt", "0.02 s", "m/s^2"}));
  EXPECT_EQ(read("0 1 2\n3 4 5\n", at_step).format, "3 values per line");
}

TEST(ValuesAtAStep, ErrorsSayWhatToType) {
  EXPECT_TRUE(test::mentions(error_of("0\n1\n2\n", in_si), {"step: 0.01 s", "r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of("1 -2 3 4\n0.5 1 1 1\n", in_si), {"step: 0.01 s", "r.txt:2", "0.5"}));
  EXPECT_TRUE(
      test::mentions(error_of("0 1\n0.02 2\n0.04 -1\n", {.units = "g", .step = 0.02}), {"step", "r.txt:1", "0.02 s"}));
  EXPECT_TRUE(test::mentions(error_of("0 1 2 3\n0.0049 2 1 2\n0.0100 -1 0 0\n", {.units = "g", .step = 0.005}),
                             {"step", "r.txt:1", "0.005 s"}));
  EXPECT_TRUE(test::mentions(error_of("4 0.02\n0 1 2 3\n", at_step), {"r.txt:2", "4"}));
  EXPECT_TRUE(test::mentions(error_of("0 1 2\n0 1\n2 1 0\n", at_step), {"r.txt:2", "3"}));
  EXPECT_TRUE(test::mentions(error_of("5\n", at_step), {"r.txt"}));
  EXPECT_TRUE(test::mentions(error_of("0 1\n2 x\n", at_step), {"x", "r.txt:2"}));
  EXPECT_TRUE(test::mentions(error_of("0 1\n2 nan\n", at_step), {"nan", "r.txt:2"}));
}

TEST(ValuesAtAStep, StandInColumnsWhereAChannelIsNamed) {
  const std::string text = "# ns [m/s^2]; ew [m/s^2]\n0;5\n1;4\n0;3\n";
  EXPECT_EQ(read(text, {.channel = "ew", .step = 0.01}).samples.accelerations, (Values{5, 4, 3}));
  EXPECT_EQ(read(text, {.channel = "1", .step = 0.01}).channel, "1: ns, column 1");
  EXPECT_TRUE(test::mentions(error_of(text, {.step = 0.01}), {"channel:", "r.txt", "2", "1"}));
  EXPECT_TRUE(test::mentions(error_of("ns;ew\n0;5\n1;4\n0;3\n", at_step), {"channel:", "r.txt", "2", "1"}));
  EXPECT_EQ(read("0;5\n1;4\n0;3\n", {.units = "g", .channel = "2", .step = 0.01}).channel, "2, column 2");
  EXPECT_EQ(read("El Centro\n0 5\n1 4\n", at_step).points(), 4u);
  EXPECT_TRUE(test::mentions(error_of("0\n1\n", {.units = "g", .channel = "1", .step = 0.01}), {"channel", "r.txt"}));
}

TEST(Step, MustBeThatOfTheFile) {
  const std::string peer = "title\nNPTS= 3, DT= .01\n0 1 2\n";
  EXPECT_NO_THROW(read(peer, {.units = "g", .step = 0.01}));
  EXPECT_TRUE(test::mentions(error_of(peer, {.units = "g", .step = 0.02}), {"step", "r.txt", "0.01 s", "0.02 s"}));
}

const std::string three = "time (s), NS (cm/s^2), EW (cm/s^2)\n0, 0, 10\n0.01, 100, 20\n0.02, -50, 30\n";

TEST(SeveralColumns, AreChannelsByNumberOrName) {
  EXPECT_EQ(read(three, {.channel = "1"}).samples.accelerations, (Values{0, 1, -0.5}));
  EXPECT_EQ(read(three, {.channel = "2"}).samples.accelerations, (Values{0.1, 0.2, 0.3}));
  const Record named = read(three, {.channel = "ew"});
  EXPECT_EQ(named.samples.accelerations, (Values{0.1, 0.2, 0.3}));
  EXPECT_EQ(named.samples.times, (Values{0, 0.01, 0.02}));
  EXPECT_TRUE(test::mentions(named.summary(), {"r.txt", "0.01 s", "3", "cm/s^2"}));
  EXPECT_EQ(read("0 0 10\n0.01 100 20\n", {.units = "gal", .channel = "2"}).samples.accelerations, (Values{0.1, 0.2}));
}

TEST(SeveralColumns, AreListedWhereNoneIsChosen) {
  EXPECT_TRUE(test::mentions(error_of(three), {"channel:", "r.txt", "2", "3"}));
  EXPECT_TRUE(test::mentions(error_of("0 0 0\n0.1 1 1\n", {.units = "g"}), {"channel:", "r.txt", "2", "3"}));
  EXPECT_TRUE(test::mentions(error_of(three, {.channel = "Up"}), {"Up", "r.txt", "2", "3"}));
  EXPECT_TRUE(test::mentions(error_of(three, {.units = "g", .channel = "1"}), {"units", "r.txt:1", "cm/s^2"}));
}

TEST(SeveralColumns, OfOtherQuantitiesAreNoChannels) {
  const std::string text = "# t[s] a[m/s^2] v[m/s] d[m]\n0 1 9 0.5\n0.1 2 9 0.25\n";
  EXPECT_EQ(read(text).samples.accelerations, (Values{1, 2}));
  EXPECT_EQ(read(text).channel, "1: a, column 2");
  const Record moved = read(text, {.displacement = true});
  EXPECT_EQ(moved.channel, "3: d, column 4");
  EXPECT_EQ(moved.initial_displacement, 0.5);
  EXPECT_TRUE(test::mentions(error_of("t,v (cm/s),w (cm/s)\n0,1,1\n0.1,1,1\n", {.channel = "v"}),
                             {"r.txt:1", "m/s^2", "cm/s^2"}));
}

TEST(Cells, MayStandInQuotesAndBeEmptyBelowTheValues) {
  for (const char* const text :
       {"\"t\",\"a (m/s^2)\"\n\"0\",\"0.5\"\n\"0.02\",\"-1.25\"\n", "t,a (m/s^2)\n0,0.5\n0.02,-1.25\n,,\n,\n",
        "t;a (m/s^2)\n\"0,00\";\"0,5\"\n\"0,02\";\"-1,25\"\n;;\n"}) {
    const Record record = read(text, {});
    EXPECT_EQ(record.samples.times, (Values{0, 0.02})) << text;
    EXPECT_EQ(record.samples.accelerations, (Values{0.5, -1.25})) << text;
  }
}

TEST(DecimalCommas, AreReadWhereSemicolonsOrBlanksPartTheColumns) {
  for (const char* const text :
       {"0,00;0,5\n0,02;-1,25\n", "0;0,5\n0,02;-1,25\n", "0,00 0,5\n0,02 -1,25\n", "0,00\t0,5\r\n0,02\t-1,25\r\n",
        "Zeit [s];a [m/s^2]\n0,00;0,5\n0,02;-1,25\n", "# a, b\n0 0,5\n0,02 -1,25\n"}) {
    const Record record = read(text, in_si);
    EXPECT_EQ(record.samples.times, (Values{0, 0.02})) << text;
    EXPECT_EQ(record.samples.accelerations, (Values{0.5, -1.25})) << text;
  }
  EXPECT_EQ(read("0,5 1,25\n-2,5\n", at_step).samples.accelerations, (Values{0.5, 1.25, -2.5}));
}

TEST(DecimalCommas, AreNotGuessed) {
  EXPECT_TRUE(test::mentions(error_of("0,5\n1,25\n", at_step), {"0,5", "r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of("0;1.234,5\n1;2\n", in_si), {"1.234,5", "r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of("0,000,0,000\n0,010,0,099\n", in_si), {"r.txt:2"}));
  // Commas next to blanks in a CSV file remain separators.
  EXPECT_EQ(read("0, 1\n1, 2\n", in_si).samples.accelerations, (Values{1, 2}));
  EXPECT_EQ(read("0,1\n1,2\n", in_si).samples.accelerations, (Values{1, 2}));
}

TEST(Headers, StateUnitsInManyWays) {
  for (const char* const header :
       {"# acceleration[cm/s^2]\n", "time acceleration[cm/s^2]\n", "% Units are (gal)\n", "units: cm/s/s\n",
        "El Centro 1940\n# Units = CM/SEC/SEC\n", "Acceleration data in units of cm/s2.\n",
        "# acc (cm/sec^2), PGA = 0.35 g\n", "Accelerations in gal, 3 points\n",
        "1940 Imperial Valley, component (N)\n\nacc (cm/s\xC2\xB2)\n"}) {
    EXPECT_EQ(read(std::string(header) + "0 0\n0.1 250\n").samples.accelerations, (Values{0, 2.5})) << header;
    EXPECT_EQ(read(std::string(header) + "0\n250\n", {.step = 0.1}).samples.accelerations, (Values{0, 2.5})) << header;
  }
  EXPECT_DOUBLE_EQ(read("Acceleration data, units are (g)\n0 0\n0.1 1\n").measures.pga, g);
  EXPECT_DOUBLE_EQ(read("% recorded in g\n0 0\n0.1 1\n").measures.pga, g);
  EXPECT_DOUBLE_EQ(read("IN UNITS OF G. FILTERED\n0 0\n0.1 1\n").measures.pga, g);
}

TEST(Headers, AValueWithAUnitIsNoStatement) {
  EXPECT_TRUE(
      test::mentions(error_of("# PGA = 341.7 cm/s^2 at 2 s\n0 0\n0.1 1\n"), {"units:", "r.txt", "m/s^2", "cm/s^2"}));
  EXPECT_EQ(read("# PGA = 341.7 cm/s^2 at 2 s\n0 0\n0.1 1\n", in_si).samples.accelerations, (Values{0, 1}));
}

TEST(Headers, OtherUnitsInCommentsNameNoColumns) {
  EXPECT_EQ(read("# depth 5 (km)\n0 0\n0.1 1\n", in_si).samples.accelerations, (Values{0, 1}));
  EXPECT_EQ(read("# acc (gal), smoothed\n0 0\n0.1 1\n").samples.accelerations, (Values{0, 0.01}));
  EXPECT_EQ(read("# t[ms] a\n0 0\n100 1\n", in_si).samples.times, (Values{0, 0.1}));
  EXPECT_EQ(read("% earthquake of M 6.9\n0 0\n0.1 1\n", {.units = "mm", .displacement = true}).unit, "mm");
}

TEST(Headers, ContradictionsNameBoth) {
  EXPECT_TRUE(
      test::mentions(error_of("# Station\n# units are (g)\n0 0\n0.1 1\n", in_si), {"units", "r.txt:2", "m/s^2"}));
  EXPECT_TRUE(test::mentions(error_of("# Station\n# units are (g)\n0 0\n0.1 1\n", {.units = "mm"}),
                             {"mm", "r.txt", "m/s^2", "cm/s^2"}));
  const std::string both = "# acc (g)\n# converted, units: cm/s^2\n0 0\n0.1 1\n";
  EXPECT_TRUE(test::mentions(error_of(both), {"units:", "r.txt:2", "cm/s^2", "1"}));
  EXPECT_EQ(read(both, {.units = "gal"}).samples.accelerations, (Values{0, 0.01}));
  EXPECT_TRUE(test::mentions(error_of(both, in_si), {"units", "r.txt:1", "m/s^2"}));
}

TEST(EndOfData, IsReadOverInEveryFormat) {
  EXPECT_EQ(read("0 0\n0.1 1\n*** End Data ***\nprinted by nobody\n", in_si).points(), 2u);
  EXPECT_EQ(read("0\n1\n2\nEOF\n", at_step).points(), 3u);
  EXPECT_EQ(read("title\nNPTS= 3, DT= .01\n0 1\n2\n*** End Data ***\n", {.units = "g"}).points(), 3u);
  EXPECT_TRUE(test::mentions(error_of("title\nNPTS= 4, DT= .01\n0 1\n2\n*** End Data ***\n", {.units = "g"}),
                             {"r.txt:4", "3", "NPTS"}));
}

TEST(EndOfData, OtherTextIsRefused) {
  EXPECT_TRUE(test::mentions(error_of("0, 1\n0.1, abc\n0.2, 3\n", in_si), {"abc", "r.txt:2"}));
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1 1\nprinted by nobody\n", in_si), {"printed by nobody", "r.txt:3"}));
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1 1\n*** End Data ***\n0.2 3\n", in_si), {"r.txt:4", "3"}));
}

TEST(Displacements, GiveTheirAccelerationsByASpline) {
  // d = 1 - cos would need many samples; a cubic is exact: d = 3 t^2 - t^3 has d(0) = v(0) = 0 and a(1) = 0.
  std::string text = "t (s), d (mm)\n";
  for (const double t : {0.0, 0.25, 0.5, 0.625, 1.0})
    text += std::to_string(t) + ", " + std::to_string(1e3 * (3 * t * t - t * t * t)) + "\n";
  const Record record = read(text, {.displacement = true});
  for (std::size_t i = 0; i < record.points(); ++i)
    EXPECT_NEAR(record.samples.accelerations[i], 6 - 6 * record.samples.times[i], 1e-9);
  EXPECT_NEAR(record.measures.pgd, 2, 1e-9);
  EXPECT_NEAR(record.measures.pgv, 3, 1e-9);
  EXPECT_EQ(record.remark, "displacements");
  const GroundMotion motion = scaled(record, -2);
  EXPECT_NEAR(motion.displacement(0.7), -2 * (3 * 0.49 - 0.343), 1e-9);
}

TEST(Displacements, MayBeginWithAVelocityAndAwayFromZero) {
  // d = 0.5 + 2 t - t^3 + 3 t^2 from t = 0.2 on; before that the velocity is that at 0.2.
  const auto d = [](double s) { return 0.5 + 2 * s + 3 * s * s - s * s * s; };
  std::string text;
  for (const double s : {0.0, 0.5, 1.0}) text += std::to_string(s + 0.2) + " " + std::to_string(d(s)) + "\n";
  const Record record = read(text, {.units = "m", .displacement = true, .initial_velocity = 2});
  EXPECT_EQ(record.initial_displacement, 0.5);
  const GroundMotion motion = scaled(record, 1);
  EXPECT_NEAR(motion.displacement(0.9), d(0.7), 1e-12);
  EXPECT_NEAR(motion.velocity(0.9), 2 + 6 * 0.7 - 3 * 0.49, 1e-12);
  EXPECT_NEAR(motion.displacement(0.2), 0.5, 1e-15);
  EXPECT_NEAR(motion.displacement(0), 0.1, 1e-15);
}

TEST(Displacements, AreReadFromPeerAndRefusedElsewhere) {
  const std::string peer = "PEER\nnowhere\nDISPLACEMENT TIME SERIES IN UNITS OF CM\nNPTS= 3, DT= .01 SEC\n 0 .01 .05\n";
  EXPECT_DOUBLE_EQ(scaled(read(peer, {.displacement = true}), 1).displacement(0.02), 5e-4);
  EXPECT_TRUE(test::mentions(error_of(peer), {"CM", "displacement: {record: FILE}", "r.txt:3", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(test::mentions(error_of("time,acc (g)\n0,0\n0.1,1\n", {.displacement = true}), {"g", "r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of("0 0\n0.1 1\n", {.displacement = true}), {"units:", "r.txt"}));
}

}  // namespace columns_test
}  // namespace pounding
