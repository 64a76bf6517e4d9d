// Mistakes of a first hour: tabs, decimal commas, units in words, names that other programs and papers use.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "support/refusals.hpp"

namespace pounding {
namespace {

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
  return "structures:\n  a:\n    frame:\n      material: {" + material + "}\n      nodes: {foot: [0, 0], top: [0, 3 m]}\n"
         "      members: {c: {between: [foot, top], section: {circle: 0.4}}}\n      supports: {foot: " + support +
         "}\n      masses: {top: 10 t}\n    damping: 5 %\n" + analysis;
}

TEST(Newcomer, IndentsByTabs) {
  refused("structures:\n\tleft: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n", "@");
  refused("structures:\n  left:\n\toscillator: {mass: 100 t, period: 0.8, damping: 5 %}\n", "@");
  refused("title: a\nstructures:\n  left:\n  \toscillator: {mass: 100 t, period: 0.8, damping: 5 %}\n" + analysis, "@");
  refused(oscillators + "links:\n\t- {between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9}\n" + analysis, "@");
}

TEST(Newcomer, WritesDecimalCommas) {
  refused(link("gap: 20,5 mm, law: hertz, stiffness: 2.75e9"), "@");
  refused(link("gap: 3,0, law: hertz, stiffness: 2.75e9"), "@");
  refused(link("gap: \"3,0\", law: hertz, stiffness: 2.75e9"), "@");
  refused(one("mass: 100,5 t, period: 0.8, damping: 5 %"), "@");
  refused(one("mass: 100 t, period: 0,8, damping: 5 %"), "@");
  refused(one("mass: 100 t, period: 0.8, damping: 2,5 %"), "@");
  refused(block("100,5 t"), "@");
  refused(block("93,500 kg"), "@");
  refused(block("1,000,000 kg"), "@");
  refused(rest("analysis:\n  duration: 1,5\n"), "@");
  refused(rest("analysis: {duration: 1,5}\n"), "@");
  refused(ground("{harmonic: {amplitude: 3,0, period: 0.6, duration: 3}}"), "@");
  refused(law("hertz_damped, stiffness: 2,75e9, restitution: 0.65"), "@");
  refused(damped("restitution: 0,65"), "@");
}

TEST(Newcomer, WritesUnitsAsWords) {
  refused(one("mass: 100 t, period: 0.8, damping: 5 percent"), "@");
  refused(one("mass: 100 t, period: 0.8, damping: 5 pct"), "@");
  refused(one("mass: 100 tons, period: 0.8, damping: 5 %"), "@");
  refused(one("mass: 100 tonnes, period: 0.8, damping: 5 %"), "@");
  refused(one("mass: 100 t, period: 0.8 sec, damping: 5 %"), "@");
  refused(one("mass: 100 t, period: 0.8 seconds, damping: 5 %"), "@");
  refused(one("mass: 100 t, stiffness: 6 MN/metre, damping: 5 %"), "@");
  refused(one("mass: 100 T, period: 0.8, damping: 5 %"), "@");
  refused(one("mass: 100 Kg, period: 0.8, damping: 5 %"), "@");
  refused(one("mass: 1000 kN, period: 0.8, damping: 5 %"), "@");
  refused(link("gap: 20 millimetres, law: hertz, stiffness: 2.75e9"), "@");
  refused(link("gap: 20mm., law: hertz, stiffness: 2.75e9"), "@");
  refused(link("gap: 1 inch, law: hertz, stiffness: 2.75e9"), "@");
  refused(ground("{harmonic: {amplitude: 0.3 G, period: 0.6, duration: 3}}"), "@");
  refused(ground("{harmonic: {amplitude: 0.3 g, period: 2 Hz, duration: 3}}"), "@");
  refused(ground("{synthetic: {seed: 1, duration: 10 s, pga: 35 %, soil: firm}}"), "@");
  refused(mast("E: 30 GPA"), "@");
  refused(mast("E: 30 kN/mm2, density: 25 kN/m^3"), "@");
}

TEST(Newcomer, AsksForRestitutionsThatCannotBe) {
  refused(damped("restitution: 0"), "@");
  refused(damped("restitution: 0 %"), "@");
  refused(damped("restitution: 1.2"), "@");
  refused(damped("restitution: 65"), "@");
  refused(damped("restitution: 120 %"), "@");
  refused(damped("restitution: -0.65"), "@");
  refused(damped("restitution: plastic"), "@");
  refused(law("stereomechanical, restitution: 0"), "@");
}

TEST(Newcomer, NamesTheLawsOfOtherPrograms) {
  const auto meant = [](const std::string& word, const std::string& name) {
    refused(law(word + ", stiffness: 2.75e9, restitution: 0.65"), "5:47: links[0].law: unknown law \"" + word + "\". Did you mean \"" + name + "\"?");
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
    refused(law(word + ", stiffness: 2.75e9, restitution: 0.65"), "5:47: links[0].law: unknown law \"" + word + "\". \"" + formula +
                                                                      "\" is a formula for the damping of a law; type law: " + laws + ", formula: " + formula + ".");
  };
  meant("lankarani_nikravesh", "lankarani_nikravesh", "hertz_damped");
  meant("Lankarani-Nikravesh", "lankarani_nikravesh", "hertz_damped");
  meant("lankarani", "lankarani_nikravesh", "hertz_damped");
  meant("hunt_crosley", "hunt_crossley", "hertz_damped");
  meant("ye", "ye_2009", "hertz_damped");
  meant("ye_2009_linear", "ye_2009_linear", "modified_kelvin");
  meant("gonthier", "gonthier", "hertz_damped");
  meant("naderpour", "naderpour_2015_eq38", "modified_linear_viscoelastic or jankowski");
  meant("naderpour_2015_eq38", "naderpour_2015_eq38", "modified_linear_viscoelastic or jankowski");
  meant("jankowski_2006", "jankowski_2006", "jankowski");
  meant("muthukumar_desroches", "muthukumar_desroches", "bilinear_hertz");
  meant("anagnostopoulos", "anagnostopoulos", "kelvin_voigt or kelvin_voigt_no_tension or komodromos");
}

TEST(Newcomer, WritesTheLettersOfPapersForKeys) {
  refused(damped("cor: 0.65"), "@");
  refused(damped("COR: 0.65"), "@");
  refused(damped("e: 0.65"), "@");
  refused(damped("coefficient_of_restitution: 0.65"), "@");
  refused(law("hertz_damped, k: 2.75e9, restitution: 0.65"), "@");
  refused(damped("n: 1.5, restitution: 0.65"), "@");
  refused(damped("mu: 0.3, restitution: 0.65"), "@");
  refused(one("m: 100 t, period: 0.8, damping: 5 %"), "@");
  refused(one("mass: 100 t, T: 0.8, damping: 5 %"), "@");
  refused(one("mass: 100 t, period: 0.8, zeta: 5 %"), "@");
  refused(one("mass: 100 t, period: 0.8, xi: 5 %"), "@");
  refused(mast("E: 30 GPa, nu: 0.2"), "@");
  refused(mast("E: 30 GPa, rho: 2500 kg/m^3"), "@");
  refused(mast("young: 30 GPa"), "@");
}

TEST(Newcomer, AcceptsWarningsByTheirNames) {
  refused(rest(analysis + "accept: [gpa]\n"), "@");
  refused(rest(analysis + "accept: [everything]\n"), "@");
  refused(rest(analysis + "accept: gap\n"), "@");
  refused(rest(analysis + "accept: {gap: true}\n"), "@");
}

TEST(Newcomer, LeavesOutTheUnitOfASpring) {
  refused(mast("E: 30 GPa", "{fix: [uz, ry], springs: {ux: 1.8e-7}}"), "@");
  refused(mast("E: 30 GPa", "{fix: [ux, uz], springs: {ry: 1e-7}}"), "@");
  EXPECT_NO_THROW(test::model_of(mast("E: 30 GPa", "{fix: [uz, ry], springs: {ux: 1.8}}"))) << "a warning tells of its period";
}

}  // namespace
}  // namespace pounding
