#include <pounding/core/units.hpp>

#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/core/error.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace units_test {

std::string error_of(std::string_view text, const Dimension& expected) {
  return test::refusal<InputError>([&] { parse_quantity(text, expected); });
}

std::string unit_error(std::string_view unit) {
  return test::refusal<InputError>([&] { parse_unit(unit); });
}

TEST(Quantity, BareNumberIsSi) {
  EXPECT_EQ(parse_quantity("2.75e9", dimension::hertz_stiffness), 2.75e9);
  EXPECT_EQ(parse_quantity("  -3 ", dimension::force), -3);
  EXPECT_EQ(parse_quantity("+1e5", dimension::stiffness), 1e5);
  EXPECT_EQ(parse_quantity(".5", dimension::time), 0.5);
}

TEST(Quantity, EveryNamedUnitHasItsSiValue) {
  struct Case {
    const char* text;
    Dimension dimension;
    double value;
  };
  const double pi = std::numbers::pi;
  const std::vector<Case> cases = {{"1 m", dimension::length, 1},
                                   {"20 mm", dimension::length, 0.02},
                                   {"3 cm", dimension::length, 0.03},
                                   {"2 km", dimension::length, 2000},
                                   {"10 in", dimension::length, 0.254},
                                   {"1 ft", dimension::length, 0.3048},
                                   {"7 kg", dimension::mass, 7},
                                   {"250 t", dimension::mass, 250e3},
                                   {"1 lb", dimension::mass, 0.45359237},
                                   {"5 s", dimension::time, 5},
                                   {"5 ms", dimension::time, 0.005},
                                   {"2 min", dimension::time, 120},
                                   {"1 h", dimension::time, 3600},
                                   {"2 Hz", dimension::frequency, 2},
                                   {"1 g", dimension::acceleration, 9.80665},
                                   {"100 gal", dimension::acceleration, 1},
                                   {"3 N", dimension::force, 3},
                                   {"3 kN", dimension::force, 3e3},
                                   {"3 MN", dimension::force, 3e6},
                                   {"3 GN", dimension::force, 3e9},
                                   {"1 lbf", dimension::force, 4.4482216152605},
                                   {"1 kip", dimension::force, 4448.2216152605},
                                   {"1 Pa", dimension::stress, 1},
                                   {"1 kPa", dimension::stress, 1e3},
                                   {"1 MPa", dimension::stress, 1e6},
                                   {"30 GPa", dimension::stress, 30e9},
                                   {"1 psi", dimension::stress, 6894.757293168},
                                   {"1 ksi", dimension::stress, 6894757.293168},
                                   {"1 J", dimension::energy, 1},
                                   {"1 kJ", dimension::energy, 1e3},
                                   {"1 kips", dimension::force, 4448.2216152605},
                                   {"2 kgf", dimension::force, 19.6133},
                                   {"1 tf", dimension::force, 9806.65},
                                   {"10 tonf", dimension::force, 98066.5},
                                   {"1 lbm", dimension::mass, 0.45359237},
                                   {"0.5 sec", dimension::time, 0.5},
                                   {"5 msec", dimension::time, 0.005},
                                   {"1 MJ", dimension::energy, 1e6},
                                   {"1 rad", dimension::none, 1},
                                   {"180 deg", dimension::none, pi},
                                   {"5 %", dimension::none, 0.05}};
  for (const Case& c : cases) EXPECT_NEAR(parse_quantity(c.text, c.dimension) / c.value, 1, 1e-12) << c.text;
}

TEST(Quantity, ProductsQuotientsAndPowersCombine) {
  EXPECT_DOUBLE_EQ(parse_quantity("93500 kN/m", dimension::stiffness), 93.5e6);
  EXPECT_DOUBLE_EQ(parse_quantity("1 N/mm", dimension::stiffness), 1e3);
  EXPECT_DOUBLE_EQ(parse_quantity("4 kN/m^1.5", dimension::hertz_stiffness), 4e3);
  EXPECT_NEAR(parse_quantity("1 N/mm^1.5", dimension::hertz_stiffness), std::pow(1e3, 1.5), 1e-9);
  EXPECT_DOUBLE_EQ(parse_quantity("8000 cm^4", dimension::second_moment), 8e-5);
  for (const char* text :
       {"2 kN s/m", "2 kN*s/m", "2kN * s / m", "2 kN s m^-1", "2 (kN s)/m", "2 kN/(m/s)", "2e3 N s/m"})
    EXPECT_DOUBLE_EQ(parse_quantity(text, dimension::damping), 2e3) << text;
  for (const char* text : {"3 m/s^2", "3 m/s2", "3 m/s/s", "300 cm/s^2", "3 m/(s s)"})
    EXPECT_DOUBLE_EQ(parse_quantity(text, dimension::acceleration), 3) << text;
  EXPECT_NEAR(parse_quantity("1 kips/in", dimension::stiffness), 175126.83524647636, 1e-6);
  EXPECT_DOUBLE_EQ(parse_quantity("2 tonf/m", dimension::stiffness), 19613.3);
  EXPECT_DOUBLE_EQ(parse_quantity("250 kgf/cm^2", dimension::stress), 250 * 98066.5);
  EXPECT_DOUBLE_EQ(parse_quantity("386.4 in/sec^2", dimension::acceleration), 386.4 * 0.0254);
  EXPECT_DOUBLE_EQ(parse_quantity("15 rad/s", dimension::frequency), 15);
  EXPECT_DOUBLE_EQ(parse_quantity("4 1/s", dimension::frequency), 4);
  EXPECT_DOUBLE_EQ(parse_quantity("5%", dimension::none), 0.05);
}

TEST(Quantity, WrongDimensionSaysWhatThePlaceTakesAndWhatWasRead) {
  EXPECT_TRUE(test::mentions(error_of("20 kN", dimension::length), {"20 mm", "20 kN"}));
  EXPECT_TRUE(test::mentions(error_of("20 mm", dimension::none), {"5 %", "20 mm"}));
  EXPECT_TRUE(test::mentions(error_of("5 g", dimension::mass), {"100 t", "5 g"}));
  EXPECT_TRUE(test::mentions(error_of("10 lb", dimension::force), {"200 kN", "10 lb"}));
  EXPECT_TRUE(test::mentions(error_of("3 kN^2", dimension::force), {"200 kN", "3 kN^2", "N^2"}));
  EXPECT_TRUE(test::mentions(error_of("3 m", parse_unit_dimension("N/m^1.2")), {"1 N/m^1.2", "3 m"}));
}

TEST(Quantity, UnknownUnitOffersTheNearest) {
  EXPECT_TRUE(test::mentions(error_of("20 mmm", dimension::length), {"20 mm", "mmm"}));
  EXPECT_TRUE(test::mentions(error_of("20 KN", dimension::force), {"200 kN", "KN"}));
  EXPECT_TRUE(test::mentions(unit_error("kNm"), {"kNm", "kN m"}));
  EXPECT_TRUE(test::mentions(unit_error("KNm/rad"), {"KNm", "kN m"}));
  EXPECT_TRUE(test::mentions(unit_error("furlong"), {"furlong"}));
}

TEST(Quantity, TextThatIsNoFiniteNumberIsRefused) {
  for (const char* text : {"nan", "inf", "-inf", ".inf", ".nan", "1e999", "mm", "", "+-3", "--3", "1e308 km"})
    EXPECT_TRUE(test::mentions(error_of(text, dimension::length), {"20 mm", std::string(text)}));
  EXPECT_TRUE(test::mentions(error_of("0,02 m", dimension::length), {"20 mm", "0,02 m", "0.02 m"}));
  EXPECT_TRUE(test::mentions(error_of("2 3 m", dimension::length), {"20 mm", "3 m"}));
  EXPECT_TRUE(test::mentions(error_of("2 1", dimension::none), {"5 %", "1"}));
}

TEST(Unit, BadSpellingIsRefused) {
  EXPECT_TRUE(test::mentions(unit_error("kN/m s"), {"kN/m s", "N s/m", "N/(m s)"}));
  EXPECT_TRUE(test::mentions(unit_error("kN/"), {"kN/"}));
  EXPECT_TRUE(test::mentions(unit_error("kN/(m s"), {"kN/(m s", ")"}));
  EXPECT_TRUE(test::mentions(unit_error("kN)"), {"kN)"}));
  EXPECT_TRUE(test::mentions(unit_error("m^"), {"in unit"}));
  EXPECT_TRUE(test::mentions(unit_error("m^x"), {"m^x"}));
}

TEST(Unit, PureNumbersHaveNoDimension) {
  for (const char* text : {"", "1", "-", "%", "rad"}) EXPECT_EQ(parse_unit_dimension(text), dimension::none) << text;
}

TEST(Unit, TextOfADimensionReadsBackAsThatDimension) {
  for (const char* text :
       {"kg",    "m",         "s",   "N",  "N/m",    "N s/m",       "N/m^1.5", "N/m^1.2", "N s/m^2.5", "N^2",   "kg m",
        "1/s^3", "N s^0.5/m", "s/m", "Pa", "kg/m^2", "m^0.5 s^0.5", "1/(m s)", "N/m^4",   "kg^2",      "kg s/m"}) {
    const Dimension dimension = parse_unit_dimension(text);
    EXPECT_EQ(parse_unit_dimension(unit_text(dimension)), dimension) << text << " became " << unit_text(dimension);
  }
}

TEST(Unit, EveryExampleIsAValueOfItsDimension) {
  for (const char* unit :
       {"1",   "kg", "m",   "s",     "1/s",     "m^2", "m^3",    "m^4",  "m/s",    "s/m",    "m/s^2",  "N",
        "N s", "J",  "N/m", "N s/m", "N/m^1.5", "Pa",  "kg/m^3", "kg/m", "kg/m^2", "kg m^2", "N/m^1.2"}) {
    const Dimension dimension = parse_unit_dimension(unit);
    EXPECT_GT(parse_quantity(quantity_example(dimension), dimension), 0) << unit;
  }
}

TEST(FormatQuantity, ChoosesTheUnitAnEngineerWould) {
  EXPECT_EQ(format_quantity(0.02, dimension::length), "20 mm");
  EXPECT_EQ(format_quantity(3.2, dimension::length), "3.2 m");
  EXPECT_EQ(format_quantity(-0.0123456, dimension::length), "-12.35 mm");
  EXPECT_EQ(format_quantity(1.27e6, dimension::force), "1.27 MN");
  EXPECT_EQ(format_quantity(950, dimension::force), "950 N");
  EXPECT_EQ(format_quantity(93.5e6, dimension::stiffness), "93.5 MN/m");
  EXPECT_EQ(format_quantity(3500, dimension::mass), "3.5 t");
  EXPECT_EQ(format_quantity(3.43, dimension::acceleration), "3.43 m/s^2");
  EXPECT_EQ(format_quantity(0.65, dimension::none), "0.65");
  EXPECT_EQ(format_quantity(0, dimension::force), "0 N");
  EXPECT_EQ(format_quantity(123456, dimension::force, 3), "123 kN");
}

TEST(FormatQuantity, RoundsBeforeItChoosesTheUnit) { EXPECT_EQ(format_quantity(0.99996, dimension::length), "1 m"); }

TEST(NearestName, FindsTypingMistakesAndNothingElse) {
  const std::vector<std::string_view> laws = {"hertz", "hertz_damped", "jankowski", "linear_spring"};
  EXPECT_EQ(nearest_name("hertz_damp", laws), "hertz_damped");
  EXPECT_EQ(nearest_name("Hertz-Damped", laws), "hertz_damped");
  EXPECT_EQ(nearest_name("jankwoski", laws), "jankowski");  // transposed letters
  EXPECT_EQ(nearest_name("spring", laws), "");
  EXPECT_EQ(nearest_name("x", std::vector<std::string_view>{"y"}), "");
  EXPECT_EQ(nearest_name("", laws), "");
}

TEST(Suggestion, NamesTheNearestElseListsAll) {
  const std::vector<std::string_view> names = {"scale", "pga"};
  EXPECT_EQ(suggestion("scael", names), " Did you mean \"scale\"?");
  EXPECT_EQ(suggestion("velocity", names), " Allowed: scale, pga.");
  EXPECT_EQ(suggestion("velocity", std::span<const std::string_view>{}), "");
}

}  // namespace units_test
}  // namespace pounding
