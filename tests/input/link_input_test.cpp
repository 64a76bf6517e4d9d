// Errors in a link and its law: location, text that was read, allowed values, text to type.

#include <gtest/gtest.h>

#include <string>
#include "support/models.hpp"

namespace pounding {
namespace link_input_test {

using test::at, test::mentions, test::refused;

const std::string two_oscillators =
    "structures:\n"
    "  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n"
    "  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}\n";
const std::string analysis = "analysis: {duration: 1}\n";

std::string whole(const std::string& rest) { return two_oscillators + rest + "\n"; }
std::string file(const std::string& text) { return text; }
std::string link(const std::string& keys) { return two_oscillators + "links:\n  - {" + keys + "}\n" + analysis; }
std::string law(const std::string& keys) { return link("between: [left, right], gap: 20 mm, law: " + keys); }
std::string floors(const std::string& ends) {
  return "structures:\n"
         "  left: {shear_building: {storeys: 3, mass: 250 t, stiffness: 220 MN/m, height: 3.2 m}, damping: 5 %}\n"
         "  right: {shear_building: {storeys: 2, mass: 250 t, stiffness: 350 MN/m, height: 3 m}, damping: 5 %}\n"
         "  w: {wall: {}}\n"
         "  v: {wall: {}}\n"
         "links:\n"
         "  - {gap: 20 mm, law: hertz, stiffness: 2.75e9, " +
         ends + "}\n" + analysis;
}

TEST(LinkInput, ReportsMissingKeys) {
  refused(link("gap: 20 mm, law: hertz, stiffness: 2.75e9"), at("5:5", "links[0]"),
          mentions({"between: [left, right]"}));
  refused(link("between: [left, right], law: hertz, stiffness: 2.75e9"), at("5:5", "links[0]"),
          mentions({"gap: 20 mm"}));
  refused(link("between: [left, right], gap: 20 mm, stiffness: 2.75e9"), at("5:5", "links[0]"),
          mentions({"law: hertz_damped"}));
}

TEST(LinkInput, RequiresADesignVelocityForAClosedGap) {
  const std::string closed =
      "between: [left, right], gap: 0, law: bilinear_hertz, stiffness: 2.75e9, restitution: 0.65";
  refused(link(closed), at("5:35", "links[0].gap"),
          mentions({"impact_velocity: 0.5 m/s", "bilinear_hertz", "initial_stiffness", "secondary_stiffness",
                    "yield_penetration"}));
  EXPECT_EQ(test::model_of(link(closed + ", impact_velocity: 0.5 m/s")).links.size(), 1u);
  EXPECT_EQ(test::model_of(link("between: [left, right], gap: 0, law: bilinear_hertz, initial_stiffness: 1200 MN/m, "
                                "secondary_stiffness: 150 MN/m, "
                                "yield_penetration: 0.9 mm"))
                .links.size(),
            1u);
}

TEST(LinkInput, NamesTwoStructuresThatExist) {
  refused(link("between: left, gap: 20 mm, law: hertz, stiffness: 2.75e9"), at("5:15", "links[0].between"),
          mentions({"between: [left, right]", "between: neighbours"}));
  refused(link("between: [left], gap: 20 mm, law: hertz, stiffness: 2.75e9"), at("5:15", "links[0].between"),
          mentions({"between: [left, right]"}));
  refused(link("between: [left, left], gap: 20 mm, law: hertz, stiffness: 2.75e9"), at("5:15", "links[0].between"),
          mentions({"left"}));
  refused(link("between: [lefft, right], gap: 20 mm, law: hertz, stiffness: 2.75e9"), at("5:16", "links[0].between[0]"),
          mentions({"lefft", "left"}));
  refused(link("between: [left, nobody], gap: 20 mm, law: hertz, stiffness: 2.75e9"), at("5:22", "links[0].between[1]"),
          mentions({"nobody", "left", "right"}));
  refused(link("between: [left.2, right], gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          at("5:16", "links[0].between[0]"), mentions({"left.2"}));
}

TEST(LinkInput, NamesFloorsThatExist) {
  refused(floors("between: [left, right.1]"), at("7:59", "links[0].between[0]"), mentions({"floors: all", "left.3"}));
  refused(floors("between: [left.4, right.1]"), at("7:59", "links[0].between[0]"), mentions({"left.4", "left.3", "1"}));
  refused(floors("between: [left.0, right.1]"), at("7:59", "links[0].between[0]"), mentions({"left.0", "left.3", "1"}));
  refused(floors("between: [left.top, right.1]"), at("7:59", "links[0].between[0]"),
          mentions({"left.top", "left.3", "1"}));
  refused(floors("between: [left.1, w.1]"), at("7:67", "links[0].between[1]"), mentions({"w"}));
  refused(floors("between: [v, w]"), at("7:58", "links[0].between"));
}

TEST(LinkInput, TakesAllFloorsOnlyWhenTheyFaceEachOther) {
  refused(floors("between: [left, right], floors: all"), at("7:58", "links[0].between"),
          mentions({"floors: all", "[left.1, right.1]", "3.2 m", "3 m"}));
  refused(floors("between: [left.1, right], floors: all"), at("7:75", "links[0].floors"), mentions({"between"}));
  refused(floors("between: [left, w], floors: 2"), at("7:77", "links[0].floors"),
          mentions({"2", "all", "level", "any"}));
  refused(floors("between: [v, w], floors: all"), at("7:58", "links[0].between"));
}

TEST(LinkInput, TakesAGapThatIsALengthOfAtLeastZero) {
  refused(link("between: [left, right], gap: -5 mm, law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"),
          mentions({"gap"}));
  refused(link("between: [left, right], gap: .nan, law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"),
          mentions({"20 mm", ".nan"}));
  refused(link("between: [left, right], gap: 20 kN, law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"),
          mentions({"20 mm", "20 kN"}));
  refused(link("between: [left, right], gap: 20 mn, law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"),
          mentions({"20 mm", "mn", "MN"}));
  refused(link(R"(between: [left, right], gap: "1,5 mm", law: hertz, stiffness: 2.75e9)"), at("5:35", "links[0].gap"),
          mentions({"20 mm", "1,5 mm", "1.5 mm"}));
  refused(link("between: [left, right], gap: [1 mm, 2 mm], law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"),
          mentions({"20 mm", "2"}));
  refused(link("between: [left, right], gap: {x: 1 mm}, law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"),
          mentions({"20 mm"}));
}

TEST(LinkInput, RejectsStructuresThatOverlapAtTheStart) {
  refused(file("structures:\n"
               "  a: {body: {mass: 1}, initial_displacement: 30 mm}\n"
               "  b: {body: {mass: 1}}\n"
               "links:\n"
               "  - {between: [a, b], gap: 20 mm, law: hertz, stiffness: 1e9}\n"
               "analysis: {duration: 1}\n"),
          at("5:28", "links[0].gap"), mentions({"10 mm", "30 mm"}));
}

TEST(LinkInput, HasAUniqueName) {
  refused(law("hertz, stiffness: 2.75e9}\n"
              "  - {between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          at("6:15", "links[1].between"), mentions({"left-right", "name: second"}));
  refused(law("hertz, stiffness: 2.75e9, name: x}\n"
              "  - {between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9, name: x"),
          at("6:79", "links[1].name"), mentions({"x", "name: second"}));
  refused(law("hertz, stiffness: 2.75e9, name: a/b"), at("5:79", "links[0].name"),
          mentions({"..", "/", "third_floor"}));
  refused(law("hertz, stiffness: 2.75e9, name: ."), at("5:79", "links[0].name"), mentions({"..", "/", "third_floor"}));
  refused(law("hertz, stiffness: 2.75e9, name: .."), at("5:79", "links[0].name"), mentions({"..", "/", "third_floor"}));
  refused(law(R"(hertz, stiffness: 2.75e9, name: "")"), at("5:79", "links[0].name"),
          mentions({"..", "/", "third_floor"}));
}

TEST(LinkInput, IsAListOfMaps) {
  refused(whole("links: {between: [left, right]}\nanalysis: {duration: 1}\n"), at("4:8", "links"),
          mentions({"between: [left, right]"}));
  refused(whole("links:\nanalysis: {duration: 1}\n"), at("4:1", "links"), mentions({"between: [left, right]"}));
  refused(whole("links:\n  - hertz\nanalysis: {duration: 1}\n"), at("5:5", "links[0]"), mentions({"{key: value}"}));
}

TEST(LawInput, IsKnownByName) {
  refused(law("hertz_damp, stiffness: 2.75e9, restitution: 0.65"), at("5:47", "links[0].law"),
          mentions({"hertz_damp", "hertz_damped"}));
  refused(law("cushion, stiffness: 2.75e9"), at("5:47", "links[0].law"),
          mentions({"cushion", "linear_spring", "kelvin_voigt", "kelvin_voigt_no_tension"}));
}

TEST(LawInput, KnowsItsFormulas) {
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, formula: ye_2019"), at("5:108", "links[0].formula"),
          mentions({"ye_2019", "ye_2009", "hertz_damped"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, formula: newton"), at("5:108", "links[0].formula"),
          mentions({"newton", "exact", "lankarani_nikravesh", "hunt_crossley", "hertz_damped"}));
  refused(law("hertz, stiffness: 2.75e9, formula: exact"), at("5:73", "links[0].formula"), mentions({"hertz"}));
  refused(law("kelvin_voigt_no_tension, stiffness: 9.35e7, restitution: 0.65, formula: ye_2009"),
          at("5:119", "links[0].formula"),
          mentions({"ye_2009", "exact", "anagnostopoulos", "kelvin_voigt_no_tension"}));
}

TEST(LawInput, NeedsARestitutionForAFormula) {
  refused(law("hertz_damped, stiffness: 2.75e9, formula: exact"), at("5:89", "links[0].formula"),
          mentions({"exact", "hertz_damped"}));
  refused(law("hertz_damped, stiffness: 2.75e9, formula: exact, damping_factor: 0.5"), at("5:89", "links[0].formula"),
          mentions({"exact", "hertz_damped"}));
}

TEST(LawInput, NeedsItsParameters) {
  refused(law("hertz"), at("5:47", "links[0].law"), mentions({"stiffness: 2.06e+09 N/m^1.5", "hertz"}));
  refused(law("kelvin_voigt, restitution: 0.5"), at("5:47", "links[0].law"),
          mentions({"stiffness: 9.35e+07 N/m", "kelvin_voigt"}));
  refused(law("adams_impact, stiffness: 2.75e9, restitution: 0.65"), at("5:47", "links[0].law"),
          mentions({"depth: 0.001 m", "adams_impact"}));
  refused(law("hertz_damped, exponent: 2, restitution: 0.5"), at("5:47", "links[0].law"),
          mentions({"stiffness: 2.75e+09 N/m^2", "hertz_damped"}));
  refused(law("stereomechanical"), at("5:47", "links[0].law"), mentions({"stereomechanical"}));
}

TEST(LawInput, TakesItsDampingExactlyOnce) {
  refused(law("hertz_damped, stiffness: 2.75e9"), at("5:47", "links[0].law"),
          mentions({"hertz_damped", "damping_factor", "damping_coefficient"}));
  refused(law("kelvin_voigt, stiffness: 9.35e7, restitution: 0.65, damping_ratio: 0.1"),
          at("5:93", "links[0].restitution"), mentions({"kelvin_voigt", "damping_ratio"}));
  refused(law("hertz_damped, stiffness: 2.75e9, damping_factor: 0.5, damping_coefficient: 2e9"),
          at("5:96", "links[0].damping_factor"), mentions({"hertz_damped", "damping_factor", "damping_coefficient"}));
}

TEST(LawInput, TakesARestitutionAboveZeroAndUpToOne) {
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0"), at("5:93", "links[0].restitution"),
          mentions({"kelvin_voigt", "0", "stereomechanical", "restitution"}));
  refused(law("stereomechanical, restitution: -0.1"), at("5:78", "links[0].restitution"),
          mentions({"-0.1", "[0, 1]", "0.65"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 1.2"), at("5:93", "links[0].restitution"),
          mentions({"1.2", "0.65"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: -0.5"), at("5:93", "links[0].restitution"),
          mentions({"-0.5", "0.65"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: .nan"), at("5:93", "links[0].restitution"),
          mentions({"5 %", ".nan"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.5 m"), at("5:93", "links[0].restitution"),
          mentions({"5 %", "0.5 m"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: all"), at("5:93", "links[0].restitution"),
          mentions({"5 %", "all"}));
  refused(law("bilinear_hertz, stiffness: 2.75e9, restitution: 0.1"), at("5:95", "links[0].restitution"),
          mentions({"bilinear_hertz", "yield_ratio", "0.1", "0.3535533905932738"}));
}

TEST(LawInput, TakesOnlyKeysThatItUses) {
  refused(law("hertz, stiffness: 2.75e9, restitution: 0.65"), at("5:86", "links[0].restitution"), mentions({"hertz"}));
  refused(law("hertz, stiffness: 2.75e9, impact_velocity: 1 m/s"), at("5:90", "links[0].impact_velocity"),
          mentions({"impact_velocity", "hertz"}));
  refused(law("hertz, stiffness: 2.75e9, damping_ratio: 0.1"), at("5:73", "links[0]"),
          mentions({"damping_ratio", "between", "within", "floors"}));
  refused(law("stereomechanical, restitution: 0.5, stiffness: 1e9"), at("5:83", "links[0]"),
          mentions({"stiffness", "between", "within", "floors"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, damping_ratoi: 0.1"), at("5:99", "links[0]"),
          mentions({"damping_ratoi", "damping_factor"}));
  refused(law("hertz_damped, stiffness: 2.75e9, damping_coefficient: 1, impact_velocity: 1 m/s"),
          at("5:121", "links[0].impact_velocity"), mentions({"impact_velocity", "damping_coefficient"}));
}

TEST(LawInput, RejectsInvalidParameters) {
  refused(law("hertz, stiffness: 0"), at("5:65", "links[0].stiffness"), mentions({"0", "stiffness"}));
  refused(law("hertz, stiffness: -5 GN/m^1.5"), at("5:65", "links[0].stiffness"), mentions({"-5e+09", "stiffness"}));
  refused(law("hertz, stiffness: .inf"), at("5:65", "links[0].stiffness"), mentions({"2.75e9 N/m^1.5", ".inf"}));
  refused(law("hertz, stiffness: 2.75e9, exponent: 0.5"), at("5:83", "links[0].exponent"),
          mentions({"0.5", "exponent"}));
  refused(law("hertz, stiffness: 2.75e9, exponent: 0"), at("5:83", "links[0].exponent"), mentions({"5 %", "0"}));
  refused(law("kelvin_voigt, stiffness: 9.35e7, damping_ratio: -0.1"), at("5:95", "links[0].damping_ratio"),
          mentions({"damping_ratio", "-0.1"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, impact_velocity: 0"),
          at("5:116", "links[0].impact_velocity"), mentions({"0.3 m/s"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, reduced_mass: 0 t"),
          at("5:113", "links[0].reduced_mass"), mentions({"100 t", "0 t"}));
}

TEST(LawInput, TakesEachParameterInItsUnit) {
  refused(law("hertz, stiffness: 93500 kN/m"), at("5:65", "links[0].stiffness"),
          mentions({"2.75e9 N/m^1.5", "93500 kN/m"}));
  refused(law("kelvin_voigt, stiffness: 1e9 N/m^1.5, restitution: 0.5"), at("5:72", "links[0].stiffness"),
          mentions({"93500 kN/m", "1e9 N/m^1.5"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, reduced_mass: 5 kN"),
          at("5:113", "links[0].reduced_mass"), mentions({"100 t", "5 kN"}));
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, impact_velocity: 1 m"),
          at("5:116", "links[0].impact_velocity"), mentions({"0.3 m/s", "1 m"}));
}

TEST(LinkInput, EstimatesTheStiffness) {
  refused(law("hertz, stiffness: {radius: 2 m, penetration: 5 mm}"), at("5:66", "links[0].stiffness.radius"));
  refused(law("hertz, stiffness: {velocity: 1 m/s}"), at("5:66", "links[0].stiffness.velocity"),
          mentions({"penetration: 5 mm"}));
  refused(law("hertz, stiffness: {area: 3 m^2}"), at("5:65", "links[0].stiffness"), mentions({"length: 9 m"}));
  refused(law("hertz, stiffness: {radius: [1 m, 2 m, 3 m]}"), at("5:74", "links[0].stiffness.radius"), mentions({"3"}));
  refused(law("hertz, stiffness: {young: 30 GPa}"), at("5:66", "links[0].stiffness"), mentions({"young", "E"}));
}

}  // namespace link_input_test
}  // namespace pounding
