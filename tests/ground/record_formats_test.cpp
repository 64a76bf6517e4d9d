// Small files of each format: K-NET (NIED knetform_en.html), ESM's DYNA 1.2, COSMOS Strong Motion Data Format 1.20
// (2001), CSMIP OSMS 85-03 (1985), USGS smcfmt. The K-NET layout follows its description; the others follow headers of
// published files and independent readers (gmprocess, pystrata, D. Boore's smcwrite). Stations and values are invented.

#include <pounding/ground/record.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <pounding/core/units.hpp>
#include "ground/record_text.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace record_formats_test {

constexpr double g = standard_gravity;
using Values = std::vector<double>;

using test::error_of;
using test::read;
using test::replaced;
using test::table;

// Nine values: a full line of eight and one more. Some fill their columns, so that no blank separates them.
const Values nine = {0, -1234.567, 2.5, -3.25, 4, -1500.125, 6, 0.001, -8};

void expect_samples(const Record& record, double dt, double unit, const Values& expected = nine) {
  ASSERT_EQ(record.points(), expected.size());
  EXPECT_TRUE(record.samples.uniform);
  EXPECT_NEAR(record.step(), dt, 1e-15);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_DOUBLE_EQ(record.samples.accelerations[i], unit * expected[i]) << i;
}

// K-NET and KiK-net.

// One second at 20 Hz: counts that alternate about their mean.
std::string knet(int mean, int amplitude, const std::string& direction = "N-S", int count = 20) {
  std::string text =
      "Origin Time       2001/02/03 04:05:00\n"
      "Lat.              40.0\n"
      "Long.             142.5\n"
      "Depth. (km)       30\n"
      "Mag.              6.2\n"
      "Station Code      ABC001\n"
      "Station Lat.      41.5000\n"
      "Station Long.     140.9000\n"
      "Station Height(m) 39\n"
      "Record Time       2001/02/03 04:05:43\n"
      "Sampling Freq(Hz) 20Hz\n"
      "Duration Time(s)  1\n"
      "Dir.              " +
      direction +
      "\n"
      "Scale Factor      3920(gal)/6182761\n"
      "Max. Acc. (gal)   4.954\n"
      "Last Correction   2001/02/03 04:05:43\n"
      "Memo.             \n";
  for (int i = 0; i < count; ++i)
    text += fmt::format("{:8d}{}", mean + (i % 2 ? -amplitude : amplitude), i % 8 == 7 ? " \n" : " ");
  return text + "\n";
}

TEST(KnetRecord, CountsAreScaledAboutTheirMean) {
  const Record record = read(knet(13190, 7813));
  EXPECT_EQ(record.format, "K-NET");
  EXPECT_EQ(record.unit, "gal");
  EXPECT_EQ(record.station, "ABC001");
  EXPECT_EQ(record.channel, "N-S");
  EXPECT_EQ(record.title, "2001/02/03 04:05:00, M 6.2");
  EXPECT_TRUE(test::mentions(record.remark, {"13190.0"}));
  EXPECT_EQ(record.points(), 20u);
  EXPECT_DOUBLE_EQ(record.step(), 0.05);
  EXPECT_NEAR(record.measures.pga, 0.04954, 5e-6);  // 7813 counts are the 4.954 gal in the header
  EXPECT_DOUBLE_EQ(record.samples.accelerations[1], -7813.0 * 3920 / 6182761 / 100);
  EXPECT_EQ(read(knet(-40, 7813)).samples.accelerations, record.samples.accelerations);
}

TEST(KnetRecord, KikNetNumbersItsChannels) {
  EXPECT_EQ(read(knet(0, 1, "1")).channel, "1: N-S, borehole");
  EXPECT_EQ(read(knet(0, 1, "5")).channel, "5: E-W, surface");
  EXPECT_EQ(read(knet(0, 1, "6"), {.channel = "u-d"}).channel, "6: U-D, surface");
  EXPECT_TRUE(test::mentions(error_of(knet(0, 1, "6"), {.channel = "5"}), {"5", "r.txt", "6"}));
}

TEST(KnetRecord, ErrorsSayWhere) {
  const std::string text = knet(0, 1);
  EXPECT_TRUE(test::mentions(error_of(knet(0, 1, "N-S", 19)), {"r.txt:20", "19"}));
  EXPECT_TRUE(test::mentions(error_of(knet(0, 1, "N-S", 21)), {"r.txt:20"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, "3920(gal)", "3920(cm)")), {"3920(cm)/6182761", "r.txt:14"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, "20Hz", "twentyHz")), {"twenty", "r.txt:11"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, "/6182761", "/0")), {"r.txt:14"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, "Dir. ", "Dire ")), {"DIR.", "r.txt:20"}));
  EXPECT_TRUE(test::mentions(error_of("Origin Time       2001/02/03 04:05:00\n"), {"MAG.", "r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of(text, {.units = "g"}), {"units", "r.txt:14"}));
}

// ESM.

std::string esm(const std::string& type = "ACCELERATION", const std::string& units = "cm/s^2") {
  const std::vector<std::string> known = {"EVENT_NAME: NOWHERE",
                                          "EVENT_ID: XX-2001-0001",
                                          "EVENT_DATE_YYYYMMDD: 20010203",
                                          "EVENT_TIME_HHMMSS: 040500",
                                          "NETWORK: XX",
                                          "STATION_CODE: ABC",
                                          "STATION_NAME: NO_WHERE",
                                          "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20010203_040510.000",
                                          "SAMPLING_INTERVAL_S: 0.005000",
                                          "NDATA: 9",
                                          "DURATION_S: 0.045",
                                          "STREAM: HNE",
                                          "UNITS: " + units,
                                          "BASELINE_CORRECTION: BASELINE REMOVED",
                                          "HEADER_FORMAT: DYNA 1.2",
                                          "DATA_TYPE: " + type,
                                          "PROCESSING: manual (Paolucci et al., 2011)"};
  std::string text;
  for (const std::string& line : known) text += line + "\n";
  for (std::size_t i = known.size(); i < 64; ++i) text += fmt::format("USER{}: \n", i);
  return text + table(nine, 1, "{:.6f}");
}

TEST(EsmRecord, IsReadWithItsHeader) {
  const Record record = read(esm());
  expect_samples(record, 0.005, 0.01);
  EXPECT_EQ(record.format, "ESM");
  EXPECT_EQ(record.unit, "cm/s^2");
  EXPECT_EQ(record.station, "XX ABC NO_WHERE");
  EXPECT_EQ(record.channel, "HNE");
  EXPECT_EQ(record.title, "NOWHERE 20010203");
  EXPECT_EQ(record.remark, "");
  EXPECT_TRUE(test::mentions(record.summary(), {"r.txt", "NO_WHERE", "0.005 s", "cm/s^2", "9", "ESM", "ABC", "HNE"}));
  EXPECT_EQ(read(replaced(esm(), "BASELINE REMOVED", "BASELINE NOT REMOVED")).remark, "uncorrected");
  EXPECT_EQ(read(replaced(esm(), "manual (Paolucci et al., 2011)", "none")).remark, "uncorrected");
}

TEST(EsmRecord, ErrorsSayWhere) {
  EXPECT_TRUE(test::mentions(error_of(esm("VELOCITY", "cm/s")), {"VELOCITY", "r.txt:16"}));
  EXPECT_TRUE(
      test::mentions(error_of(esm("ACCELERATION", "cm/s^2"), {.displacement = true}), {"ACCELERATION", "r.txt:16"}));
  EXPECT_DOUBLE_EQ(read(esm("DISPLACEMENT", "cm"), {.displacement = true}).initial_displacement, 0.01 * nine[0]);
  EXPECT_TRUE(test::mentions(error_of(esm("ACCELERATION", "cm/s")), {"r.txt:13", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(test::mentions(error_of(esm() + "1.0\n"), {"r.txt:74", "9", "NDATA"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(esm(), "NDATA: 9", "NDATA: 10")), {"r.txt:73", "9", "10", "NDATA"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(esm(), "STREAM:", "STRAM:")), {"STREAM", "r.txt:64"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(esm(), "0.005000", "0")), {"r.txt:9", "SAMPLING_INTERVAL_S", "0"}));
  EXPECT_TRUE(test::mentions(error_of(esm().substr(0, esm().find("USER20"))), {"r.txt:20", "64"}));
}

// USGS SMC.

std::string smc(const std::string& kind = "2 CORRECTED ACCELEROGRAM") {
  std::vector<int> integers(48, -32768);
  integers[15] = 2;
  integers[16] = 9;
  Values reals(50, 1.7e38);
  reals[1] = 200;
  // In 8E10.4E1 a negative number fills its columns.
  return kind +
         "\n*\n0482G\n     2001  02  03    0405 NOWHERE, XX, EARTHQUAKE\nMoment Mag=      5.9 Ms=      5.7 Ml=      "
         "6.1\n"
         "station = XX:Nowhere;12th Fl             component= 90\nepicentral dist =      7.0       pk acc =   -1500.\n"
         "inst type=SMA-1      data source = USGS\n*\n*\n*\n" +
         table(integers, 8, "{:10d}") + table(reals, 5, "{:15.7E}") + "|\n| a comment 1 2 3\n" +
         " 0.0000E+0-1.2346E+3 2.5000E+0-3.2500E+0 4.0000E+0-1.5001E+3 6.0000E+0 1.0000E-3\n-8.0000E+0\n";
}
const Values nine_of_smc = {0, -1234.6, 2.5, -3.25, 4, -1500.1, 6, 0.001, -8};

TEST(SmcRecord, BothKindsOfAccelerogramAreRead) {
  const Record record = read(smc());
  expect_samples(record, 0.005, 0.01, nine_of_smc);
  EXPECT_EQ(record.format, "USGS SMC");
  EXPECT_EQ(record.unit, "cm/s^2");
  EXPECT_EQ(record.station, "XX:Nowhere;12th Fl");
  EXPECT_EQ(record.channel, "90");
  EXPECT_EQ(record.title, "2001 02 03 0405 NOWHERE, XX, EARTHQUAKE");
  EXPECT_EQ(record.remark, "");
  EXPECT_EQ(read(smc("1 UNCORRECTED ACCELEROGRAM")).remark, "uncorrected");
}

TEST(SmcRecord, MoreDigitsAreReadWhereTheHeaderSaysSo) {
  std::string text = smc();
  const std::size_t at =
      text.find("|\n") - 10 * 76 - 20;  // integer 47: before integer 48, its line end, and ten lines of reals
  ASSERT_EQ(text.substr(at - 1, 10), "    -32768");
  text.replace(at, 9, "        8");
  const std::size_t values = text.find(" 0.0000E+0");
  text = text.substr(0, values) + table(Values{0, -1234.567, 2.5, -3.25, 4, -1500.125, 6, 0.001, -8}, 5, "{:14.7E}");
  expect_samples(read(text), 0.005, 0.01);
}

TEST(SmcRecord, ErrorsSayWhere) {
  EXPECT_TRUE(test::mentions(error_of(smc("3 VELOCITY")), {"3 VELOCITY", "r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of(smc("4 DISPLACEMENT")), {"4 DISPLACEMENT", "r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of(smc("5 RESPONSE SPECTRA")), {"5 RESPONSE SPECTRA", "r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(smc(), "\n-8.0000E+0", "")), {"r.txt:30", "8", "17", "9"}));
  EXPECT_EQ(error_of(smc() + "\n"), "taken");
  EXPECT_TRUE(test::mentions(error_of(replaced(smc(), "-8.0000E+0", "-8.0000E+0-8.0000E+0")), {"r.txt:31", "9", "17"}));
  EXPECT_TRUE(test::mentions(error_of(smc() + "-8.0000E+0\n"), {"r.txt:32", "9", "17"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(smc(), "-8.0000E+0", "**********")), {"**********", "r.txt:31"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(smc(), "  2.0000000E+02", "  1.7000000E+38")), {"r.txt:18"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(smc(), "|\n", "")), {"|", "r.txt:13", "16", "2"}));
  EXPECT_TRUE(test::mentions(error_of(smc().substr(0, 700)), {"r.txt:17"}));
}

// CSMIP.

// The 13 lines of text of V1, also lines 2 to 14 of V2.
std::string csmip_text(int channel, const std::string& component, const std::string& rest) {
  return fmt::format(
      "Uncorrected Accelerogram Data             Processed: 02/03/01, XXXX  abcdefgh    \n"
      "NOWHERE EARTHQUAKE\n"
      "February 3, 2001 04:05 PST              (Origin:  To be determined)             \n"
      "12345-L2500-12044.02                 Start time:  2/03/01, 12:05:00.0 UTC (GPS) \n"
      "Station No. 12345   40.000N, 123.000W      Etna  s/n 2500  (3 Chns of  3 at Sta)\n"
      "Nowhere - Hall                          XXX   Data: Acceleration                \n"
      "Chan {:2d}: {}\n"
      "NOWHERE EARTHQUAKE     February 3, 2001 04:05 PST                               \n"
      "Hypocenter:  To be determined.               ML:  To be determined.             \n"
      "Instr Period =  .0109 sec,  Damping =  .670,  Sensitivity =  .63  v/g           \n"
      "{}",
      channel, component, rest);
}

std::string csmip_v1(int channel, const std::string& component) {
  return csmip_text(channel, component,
                    "No. of Points =      9  Record Length =   .045 sec   at 200 Samples/sec         \n"
                    "Units of uncor data are sec and g .        Max  =  -.765 g , at    .020 sec.    \n"
                    "RMS calc for complete record =        .   Chn. metadata effective date: 02/03/01\n") +
         table(std::vector<int>(100, 0), 16, "{:5d}") + table(Values(50, 0), 8, "{:10.3f}") +
         "     9 Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)  \n"
         "  .000010 -.765432  .500000 -.250000  .125000  .000001 -.000001  .000000\n-1.250000\n" +
         fmt::format("/&  ----------  End of Data for Station Channel {:3d}  ----------\n", channel);
}
const Values nine_of_v1 = {1e-5, -.765432, .5, -.25, .125, 1e-6, -1e-6, 0, -1.25};

std::string csmip_v2(
    int channel, const std::string& component,
    const std::string& stated = "  9 points of accel data equally spaced at  .005 sec, in cm/sec2. (8f10.3)") {
  const std::string numbers = table(nine, 8, "{:10.3f}");
  return "Corrected accelerogram   12345-L2500-12044.02       Chan  1: 360 Deg     from   \n" +
         csmip_text(channel, component,
                    std::string("Record length = 60.000 sec.\nUncor Max  =   .079 g\nRMS accel =  .\n")) +
         "Accelerogram bandpass filtered with 3 dB pts at   .30 and 40.00 cyc/sec         \n"
         "     9 points of instrument- and baseline-corrected accel, veloc and displ data \n"
         "At equally-spaced intervals of    .005  sec.                                    \n" +
         std::string(8, '\n') + table(std::vector<int>(100, 13200), 16, "{:5d}") +
         table(Values(100, 0), 8, "{:10.3f}") + stated + "\n" + numbers +
         "     9 points of veloc data equally spaced at  .005 sec, in cm/sec. (8f10.3)\n" + numbers +
         "     9 points of displ data equally spaced at  .005 sec, in cm. (8f10.3)\n" + numbers +
         fmt::format("/&  ----------  End of data for channel {:2d}  ----------\n", channel);
}

TEST(CsmipRecord, V2IsReadWithItsHeader) {
  const Record record = read(csmip_v2(1, "360 Deg"));
  expect_samples(record, 0.005, 0.01);
  EXPECT_EQ(record.format, "CSMIP V2");
  EXPECT_EQ(record.unit, "cm/sec2");
  EXPECT_EQ(record.station, "12345 Nowhere - Hall");
  EXPECT_EQ(record.channel, "1: 360 Deg");
  EXPECT_EQ(record.title, "NOWHERE EARTHQUAKE February 3, 2001 04:05 PST");
  EXPECT_EQ(record.remark, "");
}

TEST(CsmipRecord, V2OfTheEightiesStatesItsUnitInBrackets) {
  const Record record =
      read(csmip_v2(1, "UP", "    9 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)"));
  expect_samples(record, 0.02, 0.01);
  EXPECT_EQ(record.unit, "CM/SEC/SEC");
}

TEST(CsmipRecord, V1IsReadAsUncorrected) {
  const Record record = read(csmip_v1(2, "Up          Sta Chn: 14    Location: Roof - Center"));
  expect_samples(record, 0.005, g, nine_of_v1);
  EXPECT_EQ(record.format, "CSMIP V1");
  EXPECT_EQ(record.unit, "g");
  EXPECT_EQ(record.channel, "2: Up, Roof - Center");
  EXPECT_EQ(record.remark, "uncorrected");
  EXPECT_TRUE(test::mentions(record.summary(), {"r.txt", "0.005 s", "V1", "12345", "2", "9", "CSMIP"}));
}

TEST(CsmipRecord, V1OfSsa1RecordersStatesItsPointsAsV2Does) {
  const std::string text =
      csmip_text(1, "90 DEG",
                 "NO. OF POINTS =      9  RECORD LENGTH = 60.000 SEC   AT 200 SAMPLES/SEC         \n"
                 "UNITS OF UNCOR ACCEL IS G.                 MAX  =   .058 G, AT   9.425 SEC.     \n"
                 "RMS ACCEL OF COMPLETE RECORD =  .008 G.                                         \n") +
      table(std::vector<int>(100, 0), 16, "{:5d}") + table(Values(50, 0), 8, "{:10.3f}") +
      "    9 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC.  (UNITS: G)\n"
      "  .000010 -.765432  .500000 -.250000  .125000  .000001 -.000001  .000000\n-1.250000\n"
      "/&  ----------  END OF DATA FOR CHANNEL  1  ----------\n";
  const Record record = read(text);
  expect_samples(record, 0.005, g, nine_of_v1);
  EXPECT_EQ(record.format, "CSMIP V1");
}

std::string csmip_pairs() {
  return csmip_text(1, "90 DEG",
                    "NO. OF POINTS =      6  RECORD LENGTH = 100.010 SEC                              \n"
                    "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =  -.200 G, AT  11.576 SEC.     \n"
                    "RMS ACCEL OF COMPLETE RECORD =  .021 G.                                         \n") +
         table(std::vector<int>(100, 0), 16, "{:5d}") + table(Values(50, 0), 8, "{:10.3f}") +
         "   .000  -.006   .005   .007   .011   .010   .015-12.345100.005   .020\n100.010  -.030\n"
         "/&  ----------  END OF DATA FOR CHANNEL  1  ----------\n";
}

TEST(CsmipRecord, V1OfFilmHoldsUnevenPairsInTenthsOfG) {
  const Record record = read(csmip_pairs());
  EXPECT_EQ(record.unit, "G/10");
  EXPECT_EQ(record.remark, "uncorrected");
  EXPECT_FALSE(record.samples.uniform);
  EXPECT_EQ(record.samples.times, (Values{0, 0.005, 0.011, 0.015, 100.005, 100.010}));
  const Values tenths = {-0.006, 0.007, 0.010, -12.345, 0.020, -0.030};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(record.samples.accelerations[i], g / 10 * tenths[i]);
}

TEST(CsmipRecord, ChannelIsChosenByNumberOrComponent) {
  const std::string text = csmip_v2(1, "90 Deg") + replaced(csmip_v2(2, "Up"), "     2.500", "     2.750") +
                           csmip_v2(5, "360 Deg   Location: Roof");
  EXPECT_TRUE(test::mentions(error_of(text), {"channel:", "r.txt", "3", "90", "2", "5", "360"}));
  EXPECT_EQ(read(text, {.channel = "2"}).samples.accelerations[2], 0.0275);
  EXPECT_EQ(read(text, {.channel = "up"}).samples.accelerations[2], 0.0275);
  EXPECT_EQ(read(text, {.channel = "90 deg"}).samples.accelerations[2], 0.025);
  EXPECT_EQ(read(text, {.channel = "5"}).channel, "5: 360 Deg, Roof");
  EXPECT_TRUE(test::mentions(error_of(text, {.channel = "3"}), {"3", "r.txt", "90", "2", "5", "360"}));
  EXPECT_TRUE(test::mentions(error_of(csmip_v2(1, "Up") + csmip_v2(2, "Up"), {.channel = "Up"}), {"Up", "r.txt", "2"}));
  EXPECT_TRUE(test::mentions(error_of(csmip_v2(1, "Up") + csmip_v2(1, "90 Deg")), {"channel:", "r.txt", "2", "90"}));
}

TEST(CsmipRecord, ErrorsSayWhere) {
  const std::string v2 = csmip_v2(1, "Up");  // values on lines 47 and 48
  EXPECT_TRUE(test::mentions(error_of(replaced(v2, "  9 points of accel", " 10 points of accel")),
                             {"r.txt:48", "9", "46", "10"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(v2, "  9 points of accel", " 17 points of accel")),
                             {"r.txt:48", "9", "46", "17"}));
  EXPECT_TRUE(
      test::mentions(error_of(replaced(v2, "  9 points of accel", "  8 points of accel")), {"r.txt:48", "8", "46"}));
  EXPECT_TRUE(
      test::mentions(error_of(replaced(v2, "  9 points of accel", "  7 points of accel")), {"r.txt:47", "7", "46"}));
  EXPECT_TRUE(test::mentions(error_of(v2.substr(0, v2.find("    -8.000"))), {"r.txt:47", "8", "46", "9"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(v2, "(8f10.3)", "(7f10.3)")), {"r.txt:47", "7", "10", "46"}));
  EXPECT_TRUE(
      test::mentions(error_of(replaced(v2, "in cm/sec2", "in cm/sec")), {"cm/sec", "r.txt:46", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(v2, ".005 sec, in", ".000 sec, in")), {"r.txt:46", "0"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(v2, "points of accel data", "points of veloc data")), {"r.txt:1"}));
  EXPECT_TRUE(test::mentions(error_of(v2 + "what is this\n"),
                             {"Corrected accelerogram", "Uncorrected accelerogram data", "r.txt:56"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(csmip_pairs(), "   .011", "   .005")), {"r.txt:28", "0.005"}));
  EXPECT_TRUE(
      test::mentions(error_of(replaced(csmip_pairs(), "\n100.010  -.030", "\n100.010")), {"r.txt:29", "11", "12"}));
  EXPECT_TRUE(test::mentions(
      error_of("Response and Fourier Amplitude Spectra\nCorrected accelerogram\nUncorrected Accelerogram Data\n"),
      {"r.txt:1", "V3", "V1", "V2"}));
}

// COSMOS.

std::string cosmos(int channel, const std::string& component, const std::string& quantity = "acceleration",
                   const std::string& unit = "cm/sec2(04),", const std::string& level = "Corrected") {
  std::string text = fmt::format(
      "{} {}    (Format v01.20 with 13 text lines) Src: nowhere\n"
      "Record of Nowhere Earthquake   of Sat Feb 3, 2001\n"
      "Hypocenter: To be determined    H=   km       ML=     Mw=\n"
      "Origin: To be determined\n"
      "Statn No: 05- 12345 Code:XX-12345  XXX  Nowhere - Hall\n"
      "Coords: 40.000  -123.000   Site geology:\n"
      "Recorder: Etna   s/n 1614 ( 3 Chns of   3 at Sta) Sensor: FBA\n"
      "Rcrd start time: 2/03/2001, 12:05:00.000 UTC (Q=5) RcrdId: 12345\n"
      "Sta Chan {:2d}: {} (Rcrdr Chan {:2d}) Location: \n"
      "Raw record length =    .045 sec, Uncor max =    20108 counts, at   25.205 sec.\n"
      "Processed:                         XXX . Max =    -1500 cm/sec2 at    0.025 sec\n"
      "Record not filtered.\n"
      "Values used when parameter or data value is unknown/unspecified:   -999, -999.0\n",
      level, quantity, channel, component, channel);
  Values reals(100, -999);
  reals[33] = 0.01;   // of the raw record
  reals[61] = 5;      // [ms]
  reals[62] = 0.045;  // [s]
  return text + " 100 Integer-header values follow on  10 lines, Format= (10I8)\n" +
         table(std::vector<int>(100, 12345678), 10, "{:8d}") +
         " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n" + table(reals, 6, "{:13.6f}") +
         "   2 Comment line(s) follow, each starting with a \"|\":\n|<SCNL>12345.HNN.XX.--\n|   9 acceleration pts, "
         "units=no\n" +
         "       9 " + quantity + " pts, approx    0 secs, units=" + unit + "Format=(8F9.3)\n" +
         table(nine, 8, "{:9.3f}") + fmt::format("End-of-data for Chan {:2d} {}\n", channel, quantity);
}

TEST(CosmosRecord, V2IsReadWithItsHeader) {
  const Record record = read(cosmos(1, "340 deg"));
  expect_samples(record, 0.005, 0.01);
  EXPECT_EQ(record.format, "COSMOS V2");
  EXPECT_EQ(record.unit, "cm/sec2");
  EXPECT_EQ(record.station, "XX-12345 XXX Nowhere - Hall");
  EXPECT_EQ(record.channel, "1: 340 deg");
  EXPECT_EQ(record.title, "Record of Nowhere Earthquake of Sat Feb 3, 2001");
  EXPECT_EQ(record.remark, "");
}

TEST(CosmosRecord, V1IsReadAsUncorrectedInItsUnit) {
  const Record record = read(cosmos(1, "Up", "acceleration", "g.     (02)", "Uncorrected"));
  expect_samples(record, 0.005, g);
  EXPECT_EQ(record.format, "COSMOS V1");
  EXPECT_EQ(record.unit, "g");
  EXPECT_EQ(record.remark, "uncorrected");
  expect_samples(read(cosmos(1, "Up", "acceleration", "cm/s^2,")), 0.005, 0.01);
  expect_samples(read(cosmos(1, "Up", "acceleration", "mg (11), ")), 0.005, g / 1000);
}

TEST(CosmosRecord, OtherColumnsAndHeaderLengthsAreRead) {
  std::string text = replaced(cosmos(1, "Up"), "with 13 text lines", "with 14 text lines");
  text = replaced(text, " 100 Integer", "one more line of text\n 100 Integer");
  text =
      replaced(text, "Format=(8F9.3)\n" + table(nine, 8, "{:9.3f}"), "Format=(1E15.6)\n" + table(nine, 1, "{:15.6e}"));
  expect_samples(read(text), 0.005, 0.01);
}

TEST(CosmosRecord, OnlyAccelerationsAreChannels) {
  const std::string text = cosmos(1, "90 deg") + cosmos(1, "90 deg", "velocity", "cm/sec(05),") +
                           cosmos(1, "90 deg", "displacement", "cm(06),") +
                           replaced(cosmos(2, "Up"), "    2.500", "    2.750") +
                           cosmos(2, "Up", "velocity", "cm/sec(05),");
  EXPECT_TRUE(test::mentions(error_of(text), {"channel:", "r.txt", "90 deg", "2"}));
  EXPECT_EQ(read(text, {.channel = "1"}).samples.accelerations[2], 0.025);
  EXPECT_EQ(read(text, {.channel = "Up"}).samples.accelerations[2], 0.0275);
  EXPECT_TRUE(test::mentions(error_of(cosmos(1, "90 deg", "velocity", "cm/sec(05),")), {"r.txt:46"}));
}

TEST(CosmosRecord, ChannelsWithoutNumbersAreCounted) {
  const auto unnumbered = [](const std::string& component) {
    return replaced(cosmos(1, component), "Sta Chan  1:", "Sta Chan  ?:");
  };
  EXPECT_EQ(read(unnumbered("Up")).channel, "Up");
  const std::string text = unnumbered("90 deg") + unnumbered("Up");
  EXPECT_EQ(read(text, {.channel = "2"}).channel, "2: Up");
}

TEST(CosmosRecord, SeriesMayEndAsInTheSampleOfTheStandard) {
  const auto sample = [](int channel, const std::string& component) {
    return replaced(cosmos(channel, component), fmt::format("End-of-data for Chan {:2d} acceleration", channel),
                    fmt::format("/&  ---------  End of data for channel {:2d}  ---------", channel));
  };
  expect_samples(read(sample(1, "90 deg")), 0.005, 0.01);
  EXPECT_EQ(read(sample(1, "90 deg") + sample(2, "Up"), {.channel = "Up"}).channel, "2: Up");
}

TEST(CosmosRecord, ErrorsSayWhere) {
  const std::string text = cosmos(1, "Up");  // values on lines 47 and 48
  EXPECT_TRUE(test::mentions(error_of(cosmos(1, "Up", "acceleration", "counts (50),")),
                             {"counts", "r.txt:46", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, "       9 acceleration", "      10 acceleration")),
                             {"r.txt:48", "9", "46", "10"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, "       9 acceleration", "       8 acceleration")),
                             {"(Format v01.20 ...", "r.txt:48"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, "     5.000000", "    50.000000")),
                             {"r.txt:36", "50 ms", "0.045 s", "62", "63", "9"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, "     5.000000", "  -999.000000")), {"r.txt:36", "62", "-999"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, " 100 Integer-header", " some Integer-header")), {"r.txt:14"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(text, "(6F13.6)", "free")), {"Format= (8F10.5)", "r.txt:25"}));
  EXPECT_TRUE(test::mentions(error_of(text.substr(0, text.find(" 100 Real"))), {"r.txt:24"}));
}

TEST(RecordFormats, AnUnknownFormatListsTheKnownOnes) {
  EXPECT_TRUE(test::mentions(error_of("Response spectra of a site\nSite NBLC\nand so on\n"),
                             {"r.txt", "V1", "V2", "V1A", "V2A", "AT2", "NET", "ESM", "COSMOS", "CSMIP", "USC", "BHRC",
                              "AFAD", "NSMN", "UNAM", "USGS", "SMC", "PEER"}));
}

TEST(RecordFormats, ChannelIsRefusedWhereNoneIsNamed) {
  EXPECT_TRUE(test::mentions(error_of("time,acc (g)\n0,0\n0.02,1\n", {.channel = "1"}), {"r.txt", "channel"}));
  EXPECT_TRUE(
      test::mentions(error_of("a\nb\nIN UNITS OF G\nNPTS= 2, DT= .01\n0 1\n", {.channel = "1"}), {"r.txt", "channel"}));
}

TEST(RecordFormats, LineEndsOfWindowsAreRead) {
  for (const std::string& text :
       {knet(5, 3), esm(), smc(), csmip_v1(1, "Up"), csmip_v2(1, "Up"), csmip_pairs(), cosmos(1, "Up")}) {
    std::string windows;
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(read(windows).samples.accelerations, read(text).samples.accelerations);
    EXPECT_EQ(read(windows).summary(), read(text).summary());
  }
}

TEST(RecordFormats, ALineMayEndTheData) {
  const std::string at2 = "a\nb\nIN UNITS OF G\nNPTS= 3, DT= .01\n0 1 2\n",
                    columns = "time (s), acc (g)\n0, 0\n0.01, 1\n0.02, 2\n";
  const std::vector<double> values = read(at2).samples.accelerations;
  for (const char* end : {"*** End Data ***\n", "END OF DATA\n\n", "-end-of-file-", "End"}) {
    EXPECT_EQ(read(at2 + end).samples.accelerations, values) << end;
    EXPECT_EQ(read(columns + end).samples.accelerations, values) << end;
  }
  EXPECT_EQ(read(knet(5, 3) + "*** End Data ***\n").samples.accelerations, read(knet(5, 3)).samples.accelerations);
  EXPECT_TRUE(test::mentions(error_of("a\nb\nIN UNITS OF G\nNPTS= 4, DT= .01\n0 1 2\n*** End Data ***\n"),
                             {"r.txt:5", "3", "4", "NPTS"}));
  EXPECT_TRUE(test::mentions(error_of(at2 + "*** End Data ***\n3\n"), {"r.txt:7", "3", "NPTS"}));
  EXPECT_TRUE(test::mentions(error_of(columns + "*** End Data ***\n0.03, 3\n"), {"r.txt:6", "5"}));
  EXPECT_TRUE(test::mentions(error_of(at2 + "*** Data ***\n"), {"r.txt:6", "3", "NPTS"}));
}

TEST(RecordFormats, NoTruncatedFileIsReadOrCrashes) {
  for (const std::string& text : {knet(5, 3), esm(), smc(), csmip_v1(1, "Up"), csmip_pairs(), cosmos(1, "Up")}) {
    // Up to the last value: the end marker of the channel is not needed.
    const std::size_t end = std::min({text.find("\n/&"), text.find("\nEnd-of"), text.size()});
    for (std::size_t length = 60; length + 20 < end; length += 37)
      EXPECT_NE(error_of(text.substr(0, length)), "taken") << text.substr(0, 40) << length;
  }
}

}  // namespace record_formats_test
}  // namespace pounding
