// Mistakes of a first hour: tabs, decimal commas, units in words, names that other programs and papers use.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/model/doubt_names.hpp>

#include "support/refusals.hpp"

namespace pounding {
namespace newcomer_test {

using test::refused;

const std::string analysis = "analysis: {duration: 1}\n";
const std::string oscillators =
    "structures:\n"
    "  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n"
    "  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}\n";

// Two oscillators with these keys of their link, which stands in line 5, and this rest.
std::string link(const std::string& keys, const std::string& rest = analysis) {
  return oscillators + "links:\n  - {between: [left, right], " + keys + "}\n" + rest;
}
std::string law(const std::string& keys) { return link("gap: 20 mm, law: " + keys); }
std::string damped(const std::string& keys) { return law("hertz_damped, stiffness: 2.75e9, " + keys); }
std::string rest(const std::string& text) { return link("gap: 20 mm, law: hertz, stiffness: 2.75e9", text); }
// One oscillator with these keys.
std::string one(const std::string& keys) { return "structures:\n  a: {oscillator: {" + keys + "}}\n" + analysis; }
// A mass in a block, without braces.
std::string block(const std::string& mass) {
  return "structures:\n  a:\n    oscillator:\n      mass: " + mass + "\n      period: 0.8\n    damping: 0\n" + analysis;
}
std::string ground(const std::string& text) { return "ground_motion: " + text + "\n" + rest(analysis); }
// A mast with this material and these supports.
std::string mast(const std::string& material, const std::string& support = "fixed") {
  return "structures:\n  a:\n    frame:\n      material: {" + material +
         "}\n      nodes: {foot: [0, 0], top: [0, 3 m]}\n"
         "      members: {c: {between: [foot, top], section: {circle: 0.4}}}\n      supports: {foot: " +
         support + "}\n      masses: {top: 10 t}\n    damping: 5 %\n" + analysis;
}

TEST(Newcomer, IndentsByTabs) {
  refused("structures:\n\tleft: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n",
          "2:1: a tab indents this line, and YAML takes blanks only; replace it by two blanks, and set the editor to "
          "do so");
  refused("structures:\n  left:\n\toscillator: {mass: 100 t, period: 0.8, damping: 5 %}\n",
          "3:1: a tab indents this line, and YAML takes blanks only; replace it by two blanks, and set the editor to "
          "do so");
  refused("title: a\nstructures:\n  left:\n  \toscillator: {mass: 100 t, period: 0.8, damping: 5 %}\n" + analysis,
          "4:3: a tab indents this line, and YAML takes blanks only; replace it by two blanks, and set the editor to "
          "do so");
  refused(oscillators + "links:\n\t- {between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9}\n" + analysis,
          "5:1: a tab indents this line, and YAML takes blanks only; replace it by two blanks, and set the editor to "
          "do so");
}

TEST(Newcomer, WritesDecimalCommas) {
  refused(
      link("gap: 20,5 mm, law: hertz, stiffness: 2.75e9"),
      R"(5:38: links[0]: "20,5 mm" is read as two entries, since commas part them; a number takes a decimal point: gap: 20.5 mm)");
  refused(
      link("gap: 3,0, law: hertz, stiffness: 2.75e9"),
      R"(5:37: links[0]: "3,0" is read as two entries, since commas part them; a number takes a decimal point: gap: 3.0)");
  refused(link("gap: \"3,0\", law: hertz, stiffness: 2.75e9"),
          R"(5:35: links[0].gap: takes a length such as "20 mm"; "3,0" needs a decimal point, not a comma; type 3.0)");
  refused(
      one("mass: 100,5 t, period: 0.8, damping: 5 %"),
      R"(2:30: structures.a.oscillator: "100,5 t" is read as two entries, since commas part them; a number takes a decimal point: )"
      "mass: 100.5 t");
  refused(
      one("mass: 100 t, period: 0,8, damping: 5 %"),
      R"(2:43: structures.a.oscillator: "0,8" is read as two entries, since commas part them; a number takes a decimal point: period: )"
      "0.8");
  refused(
      one("mass: 100 t, period: 0.8, damping: 2,5 %"),
      R"(2:57: structures.a.oscillator: "2,5 %" is read as two entries, since commas part them; a number takes a decimal point: )"
      "damping: 2.5 %");
  refused(
      block("100,5 t"),
      R"(4:13: structures.a.oscillator.mass: takes a mass such as "100 t"; "100,5 t" needs a decimal point, not a comma; type 100.5 t)");
  refused(
      block("93,500 kg"),
      R"(4:13: structures.a.oscillator.mass: takes a mass such as "100 t"; "93,500 kg" needs a decimal point, not a comma; type 93500 )"
      "kg or 93.500 kg");
  refused(
      block("1,000,000 kg"),
      R"(4:13: structures.a.oscillator.mass: takes a mass such as "100 t"; "1,000,000 kg" needs a decimal point, not a comma; type )"
      "1000000 kg");
  refused(
      rest("analysis:\n  duration: 1,5\n"),
      R"(7:13: analysis.duration: takes a time such as "0.5 s"; "1,5" needs a decimal point, not a comma; type 1.5)");
  refused(
      rest("analysis: {duration: 1,5}\n"),
      R"(6:24: analysis: "1,5" is read as two entries, since commas part them; a number takes a decimal point: duration: 1.5)");
  refused(
      ground("{harmonic: {amplitude: 3,0, period: 0.6, duration: 3}}"),
      R"(1:41: ground_motion.harmonic: "3,0" is read as two entries, since commas part them; a number takes a decimal point: )"
      "amplitude: 3.0");
  refused(
      law("hertz_damped, stiffness: 2,75e9, restitution: 0.65"),
      R"(5:74: links[0]: "2,75e9" is read as two entries, since commas part them; a number takes a decimal point: stiffness: 2.75e9)");
  refused(
      damped("restitution: 0,65"),
      R"(5:95: links[0]: "0,65" is read as two entries, since commas part them; a number takes a decimal point: restitution: 0.65)");
}

TEST(Newcomer, WritesUnitsAsWords) {
  refused(
      one("mass: 100 t, period: 0.8, damping: 5 percent"),
      R"(2:55: structures.a.oscillator.damping: takes a number such as "5 %"; unknown unit "percent". Did you mean "%"?)");
  refused(
      one("mass: 100 t, period: 0.8, damping: 5 pct"),
      R"(2:55: structures.a.oscillator.damping: takes a number such as "5 %"; unknown unit "pct". Did you mean "%"?)");
  refused(
      one("mass: 100 tons, period: 0.8, damping: 5 %"),
      R"(2:26: structures.a.oscillator.mass: takes a mass such as "100 t"; unknown unit "tons". Did you mean "t"?)");
  refused(
      one("mass: 100 tonnes, period: 0.8, damping: 5 %"),
      R"(2:26: structures.a.oscillator.mass: takes a mass such as "100 t"; unknown unit "tonnes". Did you mean "t"?)");
  refused(
      one("mass: 100 t, period: 0.8 seconds, damping: 5 %"),
      R"(2:41: structures.a.oscillator.period: takes a time such as "0.5 s"; unknown unit "seconds". Did you mean "s"?)");
  refused(
      one("mass: 100 t, stiffness: 6 MN/metre, damping: 5 %"),
      R"(2:44: structures.a.oscillator.stiffness: takes a stiffness such as "93500 kN/m"; unknown unit "metre". Did you mean "m"?)");
  refused(one("mass: 100 T, period: 0.8, damping: 5 %"),
          R"(2:26: structures.a.oscillator.mass: takes a mass such as "100 t"; unknown unit "T". Did you mean "t"?)");
  refused(one("mass: 100 Kg, period: 0.8, damping: 5 %"),
          R"(2:26: structures.a.oscillator.mass: takes a mass such as "100 t"; unknown unit "Kg". Did you mean "kg"?)");
  refused(one("mass: 1000 kN, period: 0.8, damping: 5 %"),
          R"(2:26: structures.a.oscillator.mass: takes a mass such as "100 t"; "1000 kN" is a force)");
  refused(link("gap: 20 millimetres, law: hertz, stiffness: 2.75e9"),
          R"(5:35: links[0].gap: takes a length such as "20 mm"; unknown unit "millimetres". Did you mean "mm"?)");
  refused(link("gap: 20mm., law: hertz, stiffness: 2.75e9"),
          R"(5:35: links[0].gap: takes a length such as "20 mm"; cannot read "." in unit "mm.")");
  refused(link("gap: 1 inch, law: hertz, stiffness: 2.75e9"),
          R"(5:35: links[0].gap: takes a length such as "20 mm"; unknown unit "inch". Did you mean "in"?)");
  refused(
      ground("{harmonic: {amplitude: 0.3 G, period: 0.6, duration: 3}}"),
      R"(1:39: ground_motion.harmonic.amplitude: takes an acceleration such as "0.35 g"; unknown unit "G". Did you mean "g"?)");
  refused(ground("{harmonic: {amplitude: 0.3 g, period: 2 Hz, duration: 3}}"),
          R"(1:54: ground_motion.harmonic.period: takes a time such as "0.5 s"; "2 Hz" is a frequency)");
  refused(ground("{synthetic: {seed: 1, duration: 10 s, pga: 35 %, soil: firm}}"),
          R"(1:59: ground_motion.synthetic.pga: takes an acceleration such as "0.35 g"; "35 %" is a number)");
  refused(
      mast("E: 30 GPA"),
      R"(4:21: structures.a.frame.material.E: takes a stress such as "30 GPa"; unknown unit "GPA". Did you mean "GPa"?)");
  refused(
      mast("E: 30 kN/mm2, density: 25 kN/m^3"),
      R"(4:41: structures.a.frame.material.density: takes a density such as "2400 kg/m^3"; "25 kN/m^3" is a quantity in N/m^3)");
}

TEST(Newcomer, AsksForRestitutionsThatCannotBe) {
  refused(
      damped("restitution: 0"),
      "5:93: links[0].restitution: restitution is 0, but must be in (0, 1]: no damping of this law stops the bodies; "
      "with stereomechanical and kelvin_voigt they stick at 0");
  refused(
      damped("restitution: 0 %"),
      "5:93: links[0].restitution: restitution is 0, but must be in (0, 1]: no damping of this law stops the bodies; "
      "with stereomechanical and kelvin_voigt they stick at 0");
  refused(
      damped("restitution: 1.2"),
      R"(5:93: links[0].restitution: takes a number in (0, 1] such as 0.65, the speed after an impact over that before it; "1.2" )"
      "would gain energy at each impact; 1 loses none");
  refused(damped("restitution: 65"),
          "5:93: links[0].restitution: takes a number in (0, 1] such as 0.65, the speed after an impact over that "
          "before it; did you "
          R"(mean "65 %"?)");
  refused(
      damped("restitution: 120 %"),
      R"(5:93: links[0].restitution: takes a number in (0, 1] such as 0.65, the speed after an impact over that before it; "120 %" )"
      "would gain energy at each impact; 1 loses none");
  refused(
      damped("restitution: -0.65"),
      R"(5:93: links[0].restitution: takes a number in (0, 1] such as 0.65, the speed after an impact over that before it; "-0.65" is )"
      "outside");
  refused(damped("restitution: plastic"),
          R"(5:93: links[0].restitution: takes a number such as "5 %"; "plastic" is not a finite number)");
  refused(law("stereomechanical, restitution: -0.1"),
          "5:78: links[0].restitution: takes a number in [0, 1] such as 0.65, the speed after an impact over that "
          "before it; \"-0.1\" is outside");
}

TEST(Newcomer, NamesTheLawsOfOtherPrograms) {
  const auto meant = [](const std::string& word, const std::string& name) {
    refused(law(word + ", stiffness: 2.75e9, restitution: 0.65"),
            "5:47: links[0].law: unknown law \"" + word + "\". Did you mean \"" + name + "\"?");
  };
  meant("JankowskiImpact", "jankowski");
  meant("Jankowski", "jankowski");
  meant("ImpactMaterial", "bilinear_hertz");
  meant("ViscoelasticGap", "kelvin_voigt");
  meant("Hertzdamp", "hertz_damped");
  meant("ElasticPPGap", "linear_spring");
  meant("Gap", "linear_spring");
  meant("kelvin", "kelvin_voigt");
  meant("Kelvin-Voigt", "kelvin_voigt");
  meant("linear", "linear_spring");
  meant("linear_viscoelastic", "kelvin_voigt");
  meant("newton", "stereomechanical");
}

TEST(Newcomer, GivesAFormulaForALaw) {
  const auto meant = [](const std::string& word, const std::string& formula, const std::string& laws) {
    refused(law(word + ", stiffness: 2.75e9, restitution: 0.65"),
            "5:47: links[0].law: unknown law \"" + word + "\". \"" + formula +
                "\" is a formula for the damping of a law; type law: " + laws + ", formula: " + formula + ".");
  };
  meant("lankarani_nikravesh", "lankarani_nikravesh", "hertz_damped");
  meant("Lankarani-Nikravesh", "lankarani_nikravesh", "hertz_damped");
  meant("lankarani", "lankarani_nikravesh", "hertz_damped");
  meant("hunt_crosley", "hunt_crossley", "hertz_damped");
  meant("ye", "ye_2009", "hertz_damped");
  meant("ye_2009_linear", "ye_2009_linear", "modified_kelvin");
  meant("gonthier", "gonthier", "hertz_damped");
  meant("naderpour", "naderpour_2015", "hertz_damped");
  meant("naderpour_2015_eq38", "naderpour_2015_eq38", "modified_linear_viscoelastic or jankowski");
  meant("jankowski_2006", "jankowski_2006", "jankowski");
  meant("muthukumar_desroches", "muthukumar_desroches", "bilinear_hertz");
  meant("anagnostopoulos", "anagnostopoulos", "kelvin_voigt or kelvin_voigt_no_tension or komodromos");
}

TEST(Newcomer, WritesTheLettersOfPapersForKeys) {
  refused(damped("cor: 0.65"), R"(5:80: links[0]: unknown key "cor". Did you mean "restitution"?)");
  refused(damped("COR: 0.65"), R"(5:80: links[0]: unknown key "COR". Did you mean "restitution"?)");
  refused(damped("e: 0.65"), R"(5:80: links[0]: unknown key "e". Did you mean "restitution"?)");
  refused(damped("coefficient_of_restitution: 0.65"),
          R"(5:80: links[0]: unknown key "coefficient_of_restitution". Did you mean "restitution"?)");
  refused(law("hertz_damped, k: 2.75e9, restitution: 0.65"),
          R"(5:61: links[0]: unknown key "k". Did you mean "stiffness"?)");
  refused(damped("n: 1.5, restitution: 0.65"), R"(5:80: links[0]: unknown key "n". Did you mean "exponent"?)");
  refused(damped("mu: 0.3, restitution: 0.65"), R"(5:80: links[0]: unknown key "mu". Did you mean "friction"?)");
  refused(one("m: 100 t, period: 0.8, damping: 5 %"),
          R"(2:20: structures.a.oscillator: unknown key "m". Did you mean "mass"?)");
  refused(one("mass: 100 t, T: 0.8, damping: 5 %"),
          R"(2:33: structures.a.oscillator: unknown key "T". Did you mean "period"?)");
  refused(one("mass: 100 t, period: 0.8, zeta: 5 %"),
          R"(2:46: structures.a.oscillator: unknown key "zeta". Did you mean "damping"?)");
  refused(one("mass: 100 t, period: 0.8, xi: 5 %"),
          R"(2:46: structures.a.oscillator: unknown key "xi". Did you mean "damping"?)");
  refused(mast("E: 30 GPa, nu: 0.2"),
          R"(4:29: structures.a.frame.material: unknown key "nu". Did you mean "poisson"?)");
  refused(mast("E: 30 GPa, rho: 2500 kg/m^3"),
          R"(4:29: structures.a.frame.material: unknown key "rho". Did you mean "density"?)");
  refused(mast("young: 30 GPa"), R"(4:18: structures.a.frame.material: unknown key "young". Did you mean "E"?)");
}

TEST(Newcomer, AcceptsWarningsByTheirNames) {
  refused(rest(analysis + "accept: [gpa]\n"), R"(7:10: accept[0]: unknown warning "gpa". Did you mean "gap"?)");
  refused(rest(analysis + "accept: [everything]\n"),
          fmt::format("7:10: accept[0]: unknown warning \"everything\". Allowed: {}.", fmt::join(doubt_names, ", ")));
  refused(rest(analysis + "accept: gap\n"), "7:9: accept: takes a list such as [a, b]");
  refused(rest(analysis + "accept: {gap: true}\n"), "7:9: accept: takes a list such as [a, b]");
}

TEST(Newcomer, LeavesOutTheUnitOfASpring) {
  refused(mast("E: 30 GPa", "{fix: [uz, ry], springs: {ux: 1.8e-7}}"),
          "5:21: structures.a.frame.nodes.foot: node foot: ux: a spring of 1.8e-07 N/m alone holds the frame against "
          "this displacement, "
          "so weak beside the members that it is lost in their rounding; type its unit, as in springs: {ux: 20 MN/m, "
          "ry: 100 MN m}, or "
          "fix the displacement");
  refused(mast("E: 30 GPa", "{fix: [ux, uz], springs: {ry: 1e-7}}"),
          "5:34: structures.a.frame.nodes.top: node top: ux: a spring of 1e-07 N m alone holds the frame against this "
          "displacement, so "
          "weak beside the members that it is lost in their rounding; type its unit, as in springs: {ux: 20 MN/m, ry: "
          "100 MN m}, or fix "
          "the displacement");
  EXPECT_NO_THROW(test::model_of(mast("E: 30 GPa", "{fix: [uz, ry], springs: {ux: 1.8}}")))
      << "a warning tells of its period";
}

}  // namespace newcomer_test
}  // namespace pounding
