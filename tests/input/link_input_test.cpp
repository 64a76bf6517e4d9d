// Every mistake in a link and its law: where it is, what was read, what is allowed, what to type.

#include <gtest/gtest.h>

#include <string>

#include "support/refusals.hpp"

namespace pounding {
namespace link_input_test {

using test::refused;

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

TEST(LinkInput, SaysWhichOfItsKeysIsMissing) {
  refused(link("gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          R"(5:5: links[0]: key "between" is missing; type "between: [left, right]")");
  refused(link("between: [left, right], law: hertz, stiffness: 2.75e9"),
          R"(5:5: links[0]: key "gap" is missing; type "gap: 20 mm")");
  refused(link("between: [left, right], gap: 20 mm, stiffness: 2.75e9"),
          R"(5:5: links[0]: key "law" is missing; type "law: hertz_damped")");
}

TEST(LinkInput, AsksForADesignSpeedWhereAClosedGapHasNone) {
  const std::string closed =
      "between: [left, right], gap: 0, law: bilinear_hertz, stiffness: 2.75e9, restitution: 0.65";
  refused(link(closed),
          "5:35: links[0].gap: bilinear_hertz takes its stiffness from the closing speed of each impact, and the "
          "bodies of left-right touch at "
          "rest from the start; give a design speed, such as impact_velocity: 0.5 m/s, or initial_stiffness, "
          "secondary_stiffness and "
          "yield_penetration");
  EXPECT_EQ(test::model_of(link(closed + ", impact_velocity: 0.5 m/s")).links.size(), 1u);
  EXPECT_EQ(test::model_of(link("between: [left, right], gap: 0, law: bilinear_hertz, initial_stiffness: 1200 MN/m, "
                                "secondary_stiffness: 150 MN/m, "
                                "yield_penetration: 0.9 mm"))
                .links.size(),
            1u);
}

TEST(LinkInput, NamesTwoStructuresThatExist) {
  refused(link("between: left, gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          "5:15: links[0].between: takes two structures, the left one first; type between: [left, right], or between: "
          "neighbours");
  refused(link("between: [left], gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          "5:15: links[0].between: takes two structures, the left one first; type between: [left, right]");
  refused(link("between: [left, left], gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          R"(5:15: links[0].between: "left" cannot hit itself; name two structures, the left one first)");
  refused(link("between: [lefft, right], gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          R"(5:16: links[0].between[0]: unknown structure "lefft". Did you mean "left"?)");
  refused(link("between: [left, nobody], gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          R"(5:22: links[0].between[1]: unknown structure "nobody". Allowed: left, right.)");
  refused(link("between: [left.2, right], gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          R"(5:16: links[0].between[0]: "left.2" names no floor of left, which has one; type left)");
}

TEST(LinkInput, NamesFloorsThatExist) {
  refused(floors("between: [left, right.1]"),
          "7:59: links[0].between[0]: which of the 3 floors of left? Type left.3, or add floors: all");
  refused(floors("between: [left.4, right.1]"),
          R"(7:59: links[0].between[0]: "left.4" names no floor of left, which has the floors 1 to 3; type left.3)");
  refused(floors("between: [left.0, right.1]"),
          R"(7:59: links[0].between[0]: "left.0" names no floor of left, which has the floors 1 to 3; type left.3)");
  refused(floors("between: [left.top, right.1]"),
          R"(7:59: links[0].between[0]: "left.top" names no floor of left, which has the floors 1 to 3; type left.3)");
  refused(floors("between: [left.1, w.1]"), R"(7:67: links[0].between[1]: "w" is a wall and has no floors; type w)");
  refused(floors("between: [v, w]"), "7:58: links[0].between: both ends are walls; one of them must be able to move");
}

TEST(LinkInput, TakesAllFloorsOnlyWhenTheyFaceEachOther) {
  refused(floors("between: [left, right], floors: all"),
          "7:58: links[0].between: floor 1 of left is 3.2 m up and floor 1 of right 3 m: they do not face each "
          R"(other; without "floors: all" a link names its two floors, as in [left.1, right.1])");
  refused(floors("between: [left.1, right], floors: all"),
          R"(7:75: links[0].floors: names all floors, but "between" names one; keep one of the two)");
  refused(floors("between: [left, w], floors: 2"),
          R"(7:77: links[0].floors: unknown choice of floors "2". Allowed: all, level, any.)");
  refused(floors("between: [v, w], floors: all"),
          "7:58: links[0].between: both ends are walls; one of them must be able to move");
}

TEST(LinkInput, TakesAGapThatIsALengthOfAtLeastZero) {
  refused(link("between: [left, right], gap: -5 mm, law: hertz, stiffness: 2.75e9"),
          "5:35: links[0].gap: gap must be finite and not negative; with preload: true a negative one presses from the "
          "start");
  refused(link("between: [left, right], gap: .nan, law: hertz, stiffness: 2.75e9"),
          R"(5:35: links[0].gap: takes a length such as "20 mm"; ".nan" is not a finite number)");
  refused(link("between: [left, right], gap: 20 kN, law: hertz, stiffness: 2.75e9"),
          R"(5:35: links[0].gap: takes a length such as "20 mm"; "20 kN" is a force)");
  refused(link("between: [left, right], gap: 20 mn, law: hertz, stiffness: 2.75e9"),
          R"(5:35: links[0].gap: takes a length such as "20 mm"; unknown unit "mn". Did you mean "MN"?)");
  refused(
      link(R"(between: [left, right], gap: "1,5 mm", law: hertz, stiffness: 2.75e9)"),
      R"(5:35: links[0].gap: takes a length such as "20 mm"; "1,5 mm" needs a decimal point, not a comma; type 1.5 mm)");
  refused(link("between: [left, right], gap: [1 mm, 2 mm], law: hertz, stiffness: 2.75e9"),
          R"(5:35: links[0].gap: takes a length such as "20 mm" or a list of 1 from the ground up; a list of )"
          "2 was read");
  refused(link("between: [left, right], gap: {x: 1 mm}, law: hertz, stiffness: 2.75e9"),
          R"(5:35: links[0].gap: takes a length such as "20 mm"; a map was read)");
}

TEST(LinkInput, RefusesStructuresThatOverlapAtTheStart) {
  refused(file("structures:\n"
               "  a: {body: {mass: 1}, initial_displacement: 30 mm}\n"
               "  b: {body: {mass: 1}}\n"
               "links:\n"
               "  - {between: [a, b], gap: 20 mm, law: hertz, stiffness: 1e9}\n"
               "analysis: {duration: 1}\n"),
          "5:28: links[0].gap: a and b overlap by 10 mm at the start; a gap of 30 mm or more keeps them apart");
}

TEST(LinkInput, HasANameOfItsOwn) {
  refused(law("hertz, stiffness: 2.75e9}\n"
              "  - {between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9"),
          R"(6:15: links[1].between: a link "left-right" exists already; give this one a name of its own, such as )"
          "name: second");
  refused(law("hertz, stiffness: 2.75e9, name: x}\n"
              "  - {between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9, name: x"),
          R"(6:79: links[1].name: a link "x" exists already; give this one a name of its own, such as name: second)");
  refused(law("hertz, stiffness: 2.75e9, name: a/b"),
          R"(5:79: links[0].name: a name must not be empty, "." or "..", or contain "/"; type a name such as )"
          "third_floor");
  refused(law("hertz, stiffness: 2.75e9, name: ."),
          R"(5:79: links[0].name: a name must not be empty, "." or "..", or contain "/"; type a name such as )"
          "third_floor");
  refused(law("hertz, stiffness: 2.75e9, name: .."),
          R"(5:79: links[0].name: a name must not be empty, "." or "..", or contain "/"; type a name such as )"
          "third_floor");
  refused(law(R"(hertz, stiffness: 2.75e9, name: "")"),
          R"(5:79: links[0].name: a name must not be empty, "." or "..", or contain "/"; type a name such as )"
          "third_floor");
}

TEST(LinkInput, IsAListOfMaps) {
  refused(whole("links: {between: [left, right]}\nanalysis: {duration: 1}\n"),
          "4:8: links: takes a list, one link a line; type - {between: [left, right], gap: 20 mm, law: "
          "hertz_damped, ...}");
  refused(whole("links:\nanalysis: {duration: 1}\n"),
          "4:1: links: takes a list, one link a line; type - {between: [left, right], gap: 20 mm, law: "
          "hertz_damped, ...}");
  refused(whole("links:\n  - hertz\nanalysis: {duration: 1}\n"),
          "5:5: links[0]: takes keys with values such as {key: value}; a single value was read");
}

TEST(LawInput, IsKnownByName) {
  refused(law("hertz_damp, stiffness: 2.75e9, restitution: 0.65"),
          R"(5:47: links[0].law: unknown law "hertz_damp". Did you mean "hertz_damped"?)");
  refused(law("cushion, stiffness: 2.75e9"),
          R"(5:47: links[0].law: unknown law "cushion". Allowed: linear_spring, kelvin_voigt, )"
          "kelvin_voigt_no_tension, komodromos, modified_linear_viscoelastic, modified_kelvin, hertz, "
          "hertz_damped, jankowski, bilinear_hertz, viscous_hertz, kuwabara_kono, adams_impact, limited_damper, "
          "stereomechanical, elastoplastic, backfill.");
}

TEST(LawInput, KnowsItsFormulas) {
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, formula: ye_2019"),
          R"(5:108: links[0].formula: unknown formula of hertz_damped "ye_2019". Did you mean "ye_2009"?)");
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, formula: newton"),
          R"(5:108: links[0].formula: unknown formula of hertz_damped "newton". Allowed: exact, )"
          "lankarani_nikravesh, hunt_crossley, ye_2009, hu_guo, gonthier, herbert_mcwhannell, lee_wang, "
          "zhiying_qishao, gharib_hurmuzlu, naderpour_2015.");
  refused(law("hertz, stiffness: 2.75e9, formula: exact"),
          "5:73: links[0].formula: the law hertz has no damping formula; leave it out");
  refused(law("kelvin_voigt_no_tension, stiffness: 9.35e7, restitution: 0.65, formula: ye_2009"),
          R"(5:119: links[0].formula: unknown formula of kelvin_voigt_no_tension "ye_2009". Allowed: exact, )"
          "anagnostopoulos.");
}

TEST(LawInput, NeedsARestitutionForAFormula) {
  refused(law("hertz_damped, stiffness: 2.75e9, formula: exact"),
          R"(5:89: links[0].formula: formula "exact" needs a restitution to find the damping of hertz_damped)");
  refused(law("hertz_damped, stiffness: 2.75e9, formula: exact, damping_factor: 0.5"),
          R"(5:89: links[0].formula: formula "exact" needs a restitution to find the damping of hertz_damped)");
}

TEST(LawInput, NeedsItsParameters) {
  refused(law("hertz"),
          "5:47: links[0].law: hertz needs stiffness (contact stiffness k); type stiffness: 2.06e+09 N/m^1.5");
  refused(law("kelvin_voigt, restitution: 0.5"),
          "5:47: links[0].law: kelvin_voigt needs stiffness (contact stiffness k); type stiffness: 9.35e+07 N/m");
  refused(law("adams_impact, stiffness: 2.75e9, restitution: 0.65"),
          "5:47: links[0].law: adams_impact needs depth (penetration of full damping); type depth: 0.001 m");
  refused(law("hertz_damped, exponent: 2, restitution: 0.5"),
          "5:47: links[0].law: hertz_damped needs stiffness (contact stiffness k); type stiffness: 2.75e+09 N/m^2");
  refused(law("stereomechanical"), "5:47: links[0].law: stereomechanical needs restitution");
}

TEST(LawInput, TakesItsDampingOnceAndOnlyOnce) {
  refused(law("hertz_damped, stiffness: 2.75e9"),
          "5:47: links[0].law: hertz_damped needs its damping: give restitution or damping_factor or "
          "damping_coefficient");
  refused(law("kelvin_voigt, stiffness: 9.35e7, restitution: 0.65, damping_ratio: 0.1"),
          "5:93: links[0].restitution: kelvin_voigt takes its damping once, but restitution and damping_ratio "
          "are given; keep one of them");
  refused(law("hertz_damped, stiffness: 2.75e9, damping_factor: 0.5, damping_coefficient: 2e9"),
          "5:96: links[0].damping_factor: hertz_damped takes its damping once, but damping_factor and "
          "damping_coefficient are given; keep one of them");
}

TEST(LawInput, TakesARestitutionAboveZeroAndUpToOne) {
  refused(
      law("hertz_damped, stiffness: 2.75e9, restitution: 0"),
      "5:93: links[0].restitution: restitution is 0, but must be in (0, 1]: no damping of this law stops the bodies; "
      "with stereomechanical and kelvin_voigt they stick at 0");
  refused(law("stereomechanical, restitution: -0.1"),
          "5:78: links[0].restitution: takes a number in [0, 1] such as 0.65, the speed after an impact over that "
          "before it; \"-0.1\" is outside");
  refused(
      law("hertz_damped, stiffness: 2.75e9, restitution: 1.2"),
      R"(5:93: links[0].restitution: takes a number in (0, 1] such as 0.65, the speed after an impact over that before it; "1.2" would gain )"
      "energy at each impact; 1 loses none");
  refused(
      law("hertz_damped, stiffness: 2.75e9, restitution: -0.5"),
      R"(5:93: links[0].restitution: takes a number in (0, 1] such as 0.65, the speed after an impact over that before it; "-0.5" is outside)");
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: .nan"),
          R"(5:93: links[0].restitution: takes a number such as "5 %"; ".nan" is not a finite number)");
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.5 m"),
          R"(5:93: links[0].restitution: takes a number such as "5 %"; "0.5 m" is a length)");
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: all"),
          R"(5:93: links[0].restitution: takes a number such as "5 %"; "all" is not a finite number)");
  refused(law("bilinear_hertz, stiffness: 2.75e9, restitution: 0.1"),
          "5:95: links[0].restitution: restitution 0.1 cannot be reached by bilinear_hertz with yield_ratio 0.1, "
          "which gives more than 0.3535533905932738; take another restitution, yield_ratio or law");
}

TEST(LawInput, TakesOnlyWhatItUses) {
  refused(law("hertz, stiffness: 2.75e9, restitution: 0.65"),
          "5:86: links[0].restitution: hertz takes no restitution: it loses no energy");
  refused(law("hertz, stiffness: 2.75e9, impact_velocity: 1 m/s"),
          "5:90: links[0].impact_velocity: hertz takes no impact_velocity: nothing in it depends on one");
  refused(
      law("hertz, stiffness: 2.75e9, damping_ratio: 0.1"),
      R"(5:73: links[0]: unknown key "damping_ratio". Allowed: between, within, floors, level_within, gap, preload, name, points, friction, sliding_velocity, law, formula, )"
      "restitution, impact_velocity, reduced_mass, stiffness, exponent.");
  refused(
      law("stereomechanical, restitution: 0.5, stiffness: 1e9"),
      R"(5:83: links[0]: unknown key "stiffness". Allowed: between, within, floors, level_within, gap, preload, name, points, friction, sliding_velocity, law, formula, )"
      "restitution, impact_velocity, reduced_mass.");
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, damping_ratoi: 0.1"),
          R"(5:99: links[0]: unknown key "damping_ratoi". Did you mean "damping_factor"?)");
  refused(law("hertz_damped, stiffness: 2.75e9, damping_coefficient: 1, impact_velocity: 1 m/s"),
          "5:121: links[0].impact_velocity: impact_velocity has no effect beside damping_coefficient; leave one "
          "of them out");
}

TEST(LawInput, TakesParametersThatCanBe) {
  refused(law("hertz, stiffness: 0"), "5:65: links[0].stiffness: stiffness is 0, but must be finite and positive");
  refused(law("hertz, stiffness: -5 GN/m^1.5"),
          "5:65: links[0].stiffness: stiffness is -5e+09, but must be finite and positive");
  refused(law("hertz, stiffness: .inf"),
          R"(5:65: links[0].stiffness: takes a Hertz stiffness such as "2.75e9 N/m^1.5"; ".inf" is not a finite )"
          "number");
  refused(law("hertz, stiffness: 2.75e9, exponent: 0.5"),
          "5:83: links[0].exponent: exponent is 0.5, but must be finite and at least 1");
  refused(law("hertz, stiffness: 2.75e9, exponent: 0"),
          R"(5:83: links[0].exponent: takes a number > 0 such as "5 %"; "0" is outside)");
  refused(law("kelvin_voigt, stiffness: 9.35e7, damping_ratio: -0.1"),
          "5:95: links[0].damping_ratio: damping_ratio is -0.1, but must be finite and not negative");
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, impact_velocity: 0"),
          R"(5:116: links[0].impact_velocity: takes a velocity > 0 such as "0.3 m/s"; "0" is outside)");
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, reduced_mass: 0 t"),
          R"(5:113: links[0].reduced_mass: takes a mass > 0 such as "100 t"; "0 t" is outside)");
}

TEST(LawInput, TakesEachParameterInItsUnit) {
  refused(law("hertz, stiffness: 93500 kN/m"),
          R"(5:65: links[0].stiffness: takes a Hertz stiffness such as "2.75e9 N/m^1.5"; "93500 kN/m" is a )"
          "stiffness");
  refused(law("kelvin_voigt, stiffness: 1e9 N/m^1.5, restitution: 0.5"),
          R"(5:72: links[0].stiffness: takes a stiffness such as "93500 kN/m"; "1e9 N/m^1.5" is a Hertz stiffness)");
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, reduced_mass: 5 kN"),
          R"(5:113: links[0].reduced_mass: takes a mass such as "100 t"; "5 kN" is a force)");
  refused(law("hertz_damped, stiffness: 2.75e9, restitution: 0.65, impact_velocity: 1 m"),
          R"(5:116: links[0].impact_velocity: takes a velocity such as "0.3 m/s"; "1 m" is a length)");
}

TEST(LinkInput, EstimatesTheStiffness) {
  refused(law("hertz, stiffness: {radius: 2 m, penetration: 5 mm}"),
          "5:66: links[0].stiffness.radius: has no part in an estimate by penetration; keep one of the two");
  refused(law("hertz, stiffness: {velocity: 1 m/s}"),
          "5:66: links[0].stiffness.velocity: belongs to penetration; type penetration: 5 mm beside it");
  refused(law("hertz, stiffness: {area: 3 m^2}"),
          "5:65: links[0].stiffness: key \"length\" is missing; type \"length: 9 m\"");
  refused(law("hertz, stiffness: {radius: [1 m, 2 m, 3 m]}"),
          "5:74: links[0].stiffness.radius: takes one value for both bodies, or two; a list of 3 was read");
  refused(law("hertz, stiffness: {young: 30 GPa}"),
          "5:66: links[0].stiffness: unknown key \"young\". Did you mean \"E\"?");
}

}  // namespace link_input_test
}  // namespace pounding
