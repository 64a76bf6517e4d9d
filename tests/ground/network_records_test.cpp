// Small files of national networks: GeoNet (GNS Accelerogram Data Files, Standard Format, 2008), USC (EERL 73-03),
// BHRC, AFAD (TR-NSMN) and UNAM, with the layout of published files. Stations and values are invented.

#include <pounding/ground/record.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <pounding/core/units.hpp>
#include "ground/record_text.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace network_records_test {

constexpr double g = standard_gravity;
using Values = std::vector<double>;

using test::error_of;
using test::read;
using test::replaced;
using test::table;

void expect_samples(const Record& record, double dt, double unit, const Values& expected) {
  ASSERT_EQ(record.points(), expected.size());
  EXPECT_NEAR(record.step(), dt, 1e-15);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(record.samples.accelerations[i], unit * expected[i], 1e-12) << i;
}

// GeoNet. The first number fills its columns, so that no blank precedes it.
const Values twelve = {-11026.2, 1.5, 2, 3, -4, 5, 6, 7, 8, 9, 10, -11.5};

std::string geonet(const std::string& component, bool raw = true, const std::string& unit = "1.00",
                   const Values& values = twelve) {
  const int count = static_cast<int>(values.size());
  std::vector<int> integers(40, 12);
  integers[30] = 999, integers[33] = count, integers[34] = integers[35] = raw ? 0 : count;
  Values reals(60, 1.5);
  reals[0] = 200, reals[24] = 0.005, reals[25] = raw ? 0.005 : 0.02;
  std::string text = fmt::format(
      "{} accelerogram 20010203_040506_ABCD_20 GNS Science\n"
      "Site ABCD      42 37 10S  173 03 13E     Cusp file:  20010203_040508_ABCD\n"
      "Nowhere Farm\nInstrument Cusp_10462\nResolution: 18-bit   Instr Period: 0.0050 s   Damping: 0.700\n"
      "Accelerogram 20010203_040506_ABCD_20                 Processed 2001 December 09\n5 km south-west of Nowhere\n"
      "2001 February 3          04:05:06 UT\nEpicentre  42 41 33S 173 01 19E  Bearing S18W  Dist    9km  Depth   15km "
      "Mw 7.82\n"
      "Number of points  {}     Duration 0.06  s\n{}\n{}\nComponent {}\n"
      "Acceleration:  Peak -11026.2 mm/s/s at  44.87 s     RMS   516.57 mm/s/s\n{}\n{}\n",
      raw ? "Uncorrected" : "Corrected", count,
      raw ? fmt::format("Raw readings in units of {} mm/s/s  at intervals of 0.005 s", unit)
          : "Instrument corrected data at 0.020 sec intervals",
      raw ? "Data is unfiltered" : "Band-pass filter transition bands are .10-.25 Hz and 24.50-25.50 Hz", component,
      raw ? "Velocity record unevaluated" : "Velocity:      peak -1016.55 mm/s   at  46.58 sec     rms    96.10 mm/s",
      raw ? "Displacement record unevaluated"
          : "Displacement:  peak  234.852 mm     at  46.36 sec     rms   38.013 mm");
  text += table(integers, 10, "{:8d}") + table(reals, 10, "{:8.4f}") + table(values, 10, "{:8.1f}");
  if (!raw) text += table(values, 10, "{:8.2f}") + table(values, 10, "{:8.3f}");
  return text;
}

TEST(GeonetRecord, V1AIsReadAsUncorrected) {
  const Record record = read(geonet("N28W"));
  expect_samples(record, 0.005, 1e-3, twelve);
  EXPECT_TRUE(test::mentions(record.summary(), {"r.txt", "0.005 s", "V1A", "N28W", "12", "ABCD"}));
  EXPECT_EQ(record.title, "2001 February 3 04:05:06 UT, 5 km south-west of Nowhere");
  expect_samples(read(geonet("Up", true, "0.50")), 0.005, 0.5e-3, twelve);
  EXPECT_NO_THROW(read(geonet("Up"), {.units = "mm/s^2", .step = 0.005}));
  EXPECT_TRUE(test::mentions(error_of(geonet("Up"), {.units = "g"}), {"units", "r.txt:14"}));
}

TEST(GeonetRecord, V2AHoldsVelocitiesAndDisplacementsBehindItsAccelerations) {
  const std::string text = geonet("N28W  Longitudinal Accelerometer Axis", false) +
                           geonet("S62W  Transverse Accelerometer Axis", false, "", {1, 2, 3}) +
                           geonet("Up  Vertical", false);
  EXPECT_TRUE(test::mentions(error_of(text), {"channel:", "r.txt", "3", "N28W", "2", "S62W"}));
  const Record record = read(text, {.channel = "s62w"});
  expect_samples(record, 0.02, 1e-3, {1, 2, 3});
  EXPECT_EQ(record.format, "GeoNet V2A");
  EXPECT_EQ(record.remark, "");
  expect_samples(read(text, {.channel = "3"}), 0.02, 1e-3, twelve);
}

TEST(GeonetRecord, MissingSamplesAreLeftOutAtTheEndsAndRefusedBetween) {
  const Record record = read(geonet("Up", true, "1.00", {999999.9, 999999.9, 1, 2, 3, 999999.9}));
  expect_samples(record, 0.005, 1e-3, {1, 2, 3});
  EXPECT_TRUE(test::mentions(record.remark, {"3"}));
  EXPECT_TRUE(test::mentions(error_of(geonet("Up", true, "1.00", {1, 999999.9, 3})), {"r.txt:27", "999999.9"}));
}

TEST(GeonetRecord, AnIntervalOfFourDecimalsMeansAWholeRate) {
  EXPECT_DOUBLE_EQ(read(replaced(geonet("Up"), "  0.0050  0.0050", "  0.0039  0.0039")).step(), 1.0 / 256);
}

TEST(GeonetRecord, ErrorsSayWhere) {
  EXPECT_TRUE(test::mentions(error_of(replaced(geonet("Up"), "points  12", "points  22")),
                             {"r.txt:28", "2", "10", "35", "36", "3"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(geonet("Up"), "points  12", "points  10")),
                             {"r.txt:28", "2", "10", "35", "36"}));
  EXPECT_TRUE(
      test::mentions(error_of(replaced(geonet("Up"), "Component", "Direction")), {"Component N28W", "r.txt:13"}));
  EXPECT_EQ(error_of(replaced(geonet("Up"), "Number of points", "Points")), "r.txt:10: has no \"Number of points\"");
  EXPECT_TRUE(test::mentions(error_of(replaced(geonet("Up"), "Peak -11026.2 mm/s/s", "unevaluated")),
                             {"Acceleration: Peak", "r.txt:14"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(geonet("Up"), "  0.0050  0.0050", "  0.0050  0.0000")),
                             {"r.txt:23", "26", "0"}));
  EXPECT_EQ(error_of(geonet("Up").substr(0, 900)).substr(0, 6), "r.txt:");
}

// USC.

std::string usc_text(const std::string& component, const std::string& count) {
  return fmt::format(
      "FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:                        \n"
      "NOWHERE EARTHQUAKE                                                      18\n"
      "FEB 03, 2001 -1230 GMT                                                  22\n"
      "IBB102  94.170.0 N                                                      18\n"
      "STATION USC# 0017   34 06 52N, 118 22 47W                               39\n"
      "1 NOWHERE AVE., LOS ANGELES, CA                                         31\n"
      "COMP {:<67}9\n"
      "NOWHERE EARTHQUAKE   FEB 03, 2001 -1230 GMT                             43\n"
      "EPICENTER -   34 12 48N, 118 32 13W                                     35\n"
      "INSTR PERIOD =  .037 SEC  DAMPING =   .568  SENSITIVITY =   1.69CM/G    69\n"
      "NO. OF POINTS =   {}      DURATION =  30.013 SEC                         50\n"
      "UNITS ARE SEC AND G/10                                                  22\n"
      "RMS ACCLN. OF COMPLETE RECORD =     .211 G/10                           45\n",
      component, count);
}

std::string usc_v1(const std::string& component, int integers_per_line = 16) {
  return usc_text(component, "6") +
         table(std::vector<int>(100, 0), static_cast<std::size_t>(integers_per_line),
               integers_per_line == 16 ? "{:5d}" : "{:4d}") +
         table(Values(50, 0), 8, "{:10.3f}") +
         "    .000   .046   .004   .022   .008  -.003   .013-12.345100.005   .009\n 100.010   .011\n";
}

TEST(UscRecord, V1HoldsUnevenPairs) {
  for (const int integers_per_line : {16, 20}) {
    const Record record = read(usc_v1("S05W", integers_per_line));
    EXPECT_EQ(record.samples.times, (Values{0, 0.004, 0.008, 0.013, 100.005, 100.010}));
    const Values tenths = {0.046, 0.022, -0.003, -12.345, 0.009, 0.011};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(record.samples.accelerations[i], g / 10 * tenths[i]);
    EXPECT_TRUE(test::mentions(
        record.summary(), {"r.txt", "V1", "G/10", "0017", "S05W", "6", "USC", "NOWHERE", "AVE", "LOS", "ANGELES"}));
    EXPECT_EQ(record.title, "NOWHERE EARTHQUAKE FEB 03, 2001 -1230 GMT");
  }
}

const Values ten = {-1.133, -1152.5, -.596, .494, .888, -.019, -1.193, -.564, 2.5, -3};

std::string usc_v2(const std::string& component) {
  const std::string numbers = table(ten, 8, "{:10.3f}");
  return "CORRECTED ACCELEROGRAM  IIBB127  94.610.0 COMP N08W   FILE   0  CORRESPONDING T \n" +
         usc_text(component, "8820") +
         "ACCELEROGRAM IS BAND-PASS FILTERED BETWEEN  .225- .325 AND 25.00-27.00 HZ.      \n" + std::string(10, '\n') +
         table(std::vector<int>(100, 0), 16, "{:5d}") + table(Values(100, 0), 8, "{:10.3f}") +
         "  10 POINTS OF ACC DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS CM/SEC/SEC\n" + numbers +
         "  10 POINTS OF VEL DATA EQUALLY SPACED AT   .020 SEC.  IN UNITS CM/SEC\n" + numbers;
}

TEST(UscRecord, V2HoldsEvenAccelerations) {
  const Record record = read(usc_v2("N08W"));
  expect_samples(record, 0.02, 0.01, ten);
  EXPECT_EQ(record.format, "USC V2");
  EXPECT_EQ(record.unit, "CM/SEC/SEC");
  EXPECT_EQ(record.remark, "");
}

TEST(UscRecord, SeveralComponentsAreChosenByName) {
  const std::string text = usc_v1("S05W") + usc_v1(" UP") + usc_v2("N85W");
  EXPECT_TRUE(test::mentions(error_of(text), {"channel:", "r.txt", "3", "S05W", "2", "N85W"}));
  EXPECT_EQ(read(text, {.channel = "up"}).points(), 6u);
  EXPECT_EQ(read(text, {.channel = "N85W"}).points(), 10u);
}

TEST(UscRecord, ErrorsSayWhere) {
  EXPECT_TRUE(
      test::mentions(error_of(replaced(usc_v1("UP"), "POINTS =   6", "POINTS =   7")), {"r.txt:29", "12", "11", "14"}));
  EXPECT_TRUE(
      test::mentions(error_of(replaced(usc_v1("UP"), "G/10 ", "CM/S ")), {"CM/S", "r.txt:12", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(usc_v1("UP"), "COMP ", "CHAN ")), {"COMP S05W", "r.txt:7"}));
}

// BHRC.

std::string bhrc(const std::string& component, const std::string& points = "12") {
  Values reals(50, 0);
  reals[8] = 200;  // the first one on the second line
  return fmt::format(
             "* VOL1DS FILE:  1234/01\nInst Type = SSA-2\nOrigin Time : 2001/02/03   04:05:06\n\n{}\n                  "
             "  \nCOMP "
             "{}1         \n"
             "Nowhere                   Station   37.485 N 45.891 E   Altitude 1333m   Azimuth L 324   T 54 \n"
             "Epicenter 38.520 N 46.860 E   FD 12 Km mb      Ms      Mw6.1   M        ML   (BHRC   )\n"
             "INSTR PERIOD =  .019 SEC   DAMPING =  .640                            \nNO. OF POINTS =   {}      "
             "DURATION =    "
             ".060        \n"
             "UNITS ARE SECONDS AND G/10\n                    \n",
             component, component, points) +
         table(std::vector<int>(88, 0), 14, "{:5d}") + table(reals, 8, "{:14.6E}") + table(twelve, 10, "{:13.5E}") +
         "/&\n";
}

TEST(BhrcRecord, IsReadWithItsHeader) {
  const Record record = read(bhrc("L"));
  expect_samples(record, 0.005, g / 10, twelve);
  EXPECT_TRUE(test::mentions(record.summary(), {"r.txt", "324 deg", "0.005 s", "V1", "G/10", "1234/01", "12", "BHRC"}));
}

TEST(BhrcRecord, ComponentsAreChosenByName) {
  const std::string text = bhrc("L") + bhrc("V") + bhrc("T");
  EXPECT_TRUE(test::mentions(error_of(text), {"channel:", "r.txt", "324 deg", "54 deg", "3", "2"}));
  expect_samples(read(text, {.channel = "T"}), 0.005, g / 10, twelve);
}

TEST(BhrcRecord, ErrorsSayWhere) {
  EXPECT_TRUE(test::mentions(error_of(replaced(bhrc("L"), ".060", ".600")), {"r.txt:22", "0.6 s", "200", "12", "11"}));
  EXPECT_TRUE(test::mentions(error_of(bhrc("L", "13")), {"r.txt:29", "12", "11", "13"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(bhrc("L"), "* VOL1DS", "* VOL2DS")), {"r.txt:1", "V1"}));
}

// AFAD (TR-NSMN).

std::string nsmn() {
  return "STRONG GROUND MOTION RECORDS OF TURKIYE\n"
         "PLACE                   : NOWHERE METEOROLOJI M\xC3\x9C"
         "D\xC3\x9CRLU\xC4\x9E\xC3\x9C\n"
         "EARTHQUAKE DATE         : 2001/02/03 04:05:06 (GMT)\nEPICENTER COORDINATES   : "
         "36.91980N-27.44350E\nEARTHQUAKE DEPTH "
         "(km)   : 19.44\n"
         "EARTHQUAKE MAGNITUDE    : 6.5 Mw\nSTATION ID              : 4304\nSTATION COORDINATES     : "
         "38.99478N-29.40040E\nSTATION ALTITUDE (m)    : 735\n"
         "RECORDER TYPE           : Guralp cmg5td\nRECORDER SERIAL NO      : 5B02\nRECORD TIME             : "
         "03/02/2001 "
         "04:05:10.000000 (GMT)\n"
         "NUMBER OF DATA          : 3\nSAMPLING INTERVAL (sec) : 0.01\nRAW PGA VALUES (gal)    : (N-S) 1.25 (E-W) 8.5 "
         "(U-D) 0.5\n"
         "Copyright EARTHQUAKE DEPARTMENT\nDISASTER AND EMERGENCY MANAGEMENT PRESIDENCY\n       N-S          E-W       "
         "   U-D\n"
         "   -0.250000      0.000010     0.000207\n    1.250000     -8.500000     0.500000\n   -0.000194      0.000015 "
         "   "
         "-0.125000\n";
}

TEST(NsmnRecord, ComponentsAreColumnsInGal) {
  const Record record = read(nsmn(), {.channel = "E-W"});
  expect_samples(record, 0.01, 0.01, {0.00001, -8.5, 0.000015});
  EXPECT_EQ(record.format, "AFAD (TR-NSMN)");
  EXPECT_EQ(record.unit, "gal");
  EXPECT_EQ(record.channel, "2: E-W");
  EXPECT_EQ(record.title, "2001/02/03 04:05:06 (GMT), M 6.5 Mw");
  EXPECT_TRUE(record.station.starts_with("4304 NOWHERE"));
  expect_samples(read(nsmn(), {.channel = "3"}), 0.01, 0.01, {0.000207, 0.5, -0.125});
}

TEST(NsmnRecord, ErrorsSayWhere) {
  EXPECT_TRUE(test::mentions(error_of(nsmn()), {"channel:", "r.txt", "3", "2"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(nsmn(), "DATA          : 3", "DATA          : 4"), {.channel = "1"}),
                             {"r.txt:21", "9", "3", "12", "NUMBER", "DATA"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(nsmn(), "(gal) ", "(cm) "), {.channel = "1"}),
                             {"displacement: {record: FILE}", "r.txt:15", "m/s^2", "cm/s^2"}));
  EXPECT_TRUE(
      test::mentions(error_of(replaced(nsmn(), "E-W          U-D", "E-W"), {.channel = "1"}), {"r.txt:18", "2", "3"}));
}

// UNAM.

std::string unam() {
  const std::string rule = "---------+---------+---------+---------+---------+---------+---------+---------+\n";
  return "**************************************************************************************\n"
         "                       INSTITUTO DE INGENIERIA, UNAM\n"
         "**************************************************************************************\n"
         "ARCHIVO ESTANDAR DE ACELERACION:\nVERSION DEL FORMATO                    : 2.0\n\n"
         "================================================================================\nDATOS DE LA ESTACION:\n"
         "NOMBRE DE LA ESTACION                  : NINGUNA PARTE\nCLAVE DE LA ESTACION                   : NADA\n"
         "LOCALIZACION DE LA ESTACION            : AV. COSTERA\n                                       : \n"
         "NUMERO DE CANALES                      : 3\nORIENTACION C1-C6 (rumbo;orientacion)  : "
         "/V;+/N00E;+/N90E;+\nORIENTACION "
         "C7-C12 (rumbo;orientacion) : \n"
         "INTERVALO DE MUESTREO, C1-C6 (s)       : /0.005/0.005/0.01\nINTERVALO DE MUESTREO, C7-C12 (s)      : \n"
         "FECHA DEL SISMO [GMT]                  : 2001/02/03\nHORA EPICENTRO (GMT)                   : "
         "18:14:40\nMAGNITUD(ES)   "
         "                        : /M=7.1\n"
         "DURACION DEL REGISTRO (s), C1-C6       : /0.02/0.02/0.02\nDURACION DEL REGISTRO (s), C7-C12      : \n"
         "NUM. TOTAL DE MUESTRAS, C1-C6          : /4/4/2\nNUM. TOTAL DE MUESTRAS, C7-C12         : \n"
         "UNIDADES DE LOS DATOS                  : Gal (cm/s/s)\nFACTOR DE DECIMACION                   : 1\n"
         "FORMATO DATOS (FORTRAN,10 campos/dato) : 3F10.4\n\nCOMENTARIOS:\n\n"
         "================================================================================\nDATOS DE ACELERACION:\n" +
         rule + "   CANAL-1   CANAL-2   CANAL-3\n         V      N00E      N90E\n" + rule +
         "   -0.0083   -0.0214    1.5000\n   -0.0157-1234.0103    0.0319\n   -0.0240   -0.0681\n   -0.0425   -0.0177\n";
}

TEST(UnamRecord, ComponentsAreColumns) {
  const Record record = read(unam(), {.channel = "N00E"});
  expect_samples(record, 0.005, 0.01, {-0.0214, -1234.0103, -0.0681, -0.0177});
  EXPECT_TRUE(
      test::mentions(record.summary(), {"r.txt", "0.005 s", "2", "N00E", "4", "UNAM", "NADA", "NINGUNA", "PARTE"}));
  EXPECT_EQ(record.title, "2001/02/03 /M=7.1");
  expect_samples(read(unam(), {.channel = "3"}), 0.01, 0.01, {1.5, 0.0319});
}

TEST(UnamRecord, AFewMoreRowsThanStatedAreLeftOut) {
  std::string values;
  for (int i = 0; i < 202; ++i) values += "   -0.0083   -0.0214    1.5000\n";
  std::string text = replaced(replaced(unam(), "/4/4/2", "/200/200/200"), "/0.02/0.02/0.02", "/1.0/1.0/2.0");
  text = text.substr(0, text.find("   -0.0083")) + values;
  const Record record = read(text, {.channel = "V"});
  EXPECT_EQ(record.points(), 200u);
  ASSERT_FALSE(record.warnings.empty());
  EXPECT_TRUE(test::mentions(record.warnings.front(), {"2", "200", "23"}));
  EXPECT_TRUE(test::mentions(error_of(text + "   -0.0083   -0.0214    1.5000\n", {.channel = "V"}),
                             {"r.txt:237", "200", "23"}));
}

TEST(UnamRecord, ErrorsSayWhere) {
  EXPECT_TRUE(test::mentions(error_of(unam()), {"channel:", "r.txt", "3", "2", "N00E", "N90E"}));
  EXPECT_TRUE(
      test::mentions(error_of(replaced(unam(), "/4/4/2", "/5/5/2"), {.channel = "V"}), {"r.txt:40", "4", "23", "5"}));
  EXPECT_TRUE(
      test::mentions(error_of(replaced(unam(), "/4/4/2", "/3/4/2"), {.channel = "V"}), {"r.txt:40", "3", "23"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(unam(), "/0.02/0.02/0.02", "/0.2/0.02/0.02"), {.channel = "1"}),
                             {"r.txt:16", "0.005 s", "0.2 s", "4", "21"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(unam(), ": 3F10.4", ": libre"), {.channel = "1"}),
                             {"libre", "r.txt:27", "3", "3F10.4"}));
  EXPECT_TRUE(test::mentions(error_of(replaced(unam(), "CLAVE DE", "NOMBRE"), {.channel = "1"}),
                             {"CLAVE DE LA ESTACION", "r.txt:40"}));
}

// All networks.

TEST(NetworkRecords, LineEndsPaddingAndTruncationChangeNoNumber) {
  const std::vector<std::pair<std::string, RecordOptions>> all = {
      {geonet("N28W"), {}}, {geonet("Up", false), {}},  {usc_v1("S05W"), {}},      {usc_v2("N08W"), {}},
      {bhrc("L"), {}},      {nsmn(), {.channel = "1"}}, {unam(), {.channel = "2"}}};
  for (const auto& [text, options] : all) {
    const Record record = read(text, options);
    std::string windows;
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(read(windows, options).samples.accelerations, record.samples.accelerations);
    EXPECT_EQ(read(text + "\x1A", options).samples.accelerations, record.samples.accelerations);
    EXPECT_EQ(read(text + "\f\n\x1A" + std::string(100, '\0'), options).samples.accelerations,
              record.samples.accelerations);
    // Velocities and displacements after the accelerations are not needed.
    const std::size_t last = std::min(text.find("  10 POINTS OF VEL"), text.find_last_of("0123456789"));
    for (std::size_t length = 60; length < last; length += 37)
      EXPECT_NE(error_of(text.substr(0, length), options), "taken") << text.substr(0, 30) << length;
  }
}

}  // namespace network_records_test
}  // namespace pounding
