// Errors of new users: tabs, decimal commas, spelled-out units, names from other programs and papers.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/model/warning_names.hpp>
#include <pounding/reports/plausible.hpp>
#include "support/models.hpp"

namespace pounding {
namespace newcomer_test {

using test::at, test::mentions, test::refused;

const std::string analysis = "analysis: {duration: 1}\n";
const std::string oscillators =
    "structures:\n  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n  right: {oscillator: {mass: 150 t, "
    "period: 0.4, damping: 5 %}}\n";

// Two oscillators with these keys of their link on line 5, followed by `rest`.
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
         "}\n      nodes: {foot: [0, 0], top: [0, 3 m]}\n      members: {c: {between: [foot, top], section: {circle: "
         "0.4}}}\n      supports: {foot: " +
         support + "}\n      masses: {top: 10 t}\n    damping: 5 %\n" + analysis;
}

TEST(Newcomer, IndentsByTabs) {
  refused("structures:\n\tleft: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n", at("2:1"),
          mentions({"YAML"}));
  refused("structures:\n  left:\n\toscillator: {mass: 100 t, period: 0.8, damping: 5 %}\n", at("3:1"),
          mentions({"YAML"}));
  refused("title: a\nstructures:\n  left:\n  \toscillator: {mass: 100 t, period: 0.8, damping: 5 %}\n" + analysis,
          at("4:3"), mentions({"YAML"}));
  refused(oscillators + "links:\n\t- {between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9}\n" + analysis,
          at("5:1"), mentions({"YAML"}));
}

TEST(Newcomer, WritesDecimalCommas) {
  refused(link("gap: 20,5 mm, law: hertz, stiffness: 2.75e9"), at("5:38", "links[0]"),
          mentions({"20,5 mm", "20.5 mm"}));
  refused(link("gap: 3,0, law: hertz, stiffness: 2.75e9"), at("5:37", "links[0]"), mentions({"3,0", "3.0"}));
  refused(link("gap: \"3,0\", law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"),
          mentions({"20 mm", "3,0", "3.0"}));
  refused(one("mass: 100,5 t, period: 0.8, damping: 5 %"), at("2:30", "structures.a.oscillator"),
          mentions({"100,5 t", "100.5 t"}));
  refused(one("mass: 100 t, period: 0,8, damping: 5 %"), at("2:43", "structures.a.oscillator"),
          mentions({"0,8", "0.8"}));
  refused(one("mass: 100 t, period: 0.8, damping: 2,5 %"), at("2:57", "structures.a.oscillator"),
          mentions({"2,5 %", "2.5 %"}));
  refused(block("100,5 t"), at("4:13", "structures.a.oscillator.mass"), mentions({"100 t", "100,5 t", "100.5 t"}));
  refused(block("93,500 kg"), at("4:13", "structures.a.oscillator.mass"),
          mentions({"100 t", "93,500 kg", "93500 kg", "93.500 kg"}));
  refused(block("1,000,000 kg"), at("4:13", "structures.a.oscillator.mass"),
          mentions({"100 t", "1,000,000 kg", "1000000 kg"}));
  refused(rest("analysis:\n  duration: 1,5\n"), at("7:13", "analysis.duration"), mentions({"0.5 s", "1,5", "1.5"}));
  refused(rest("analysis: {duration: 1,5}\n"), at("6:24", "analysis"), mentions({"1,5", "1.5"}));
  refused(ground("{harmonic: {amplitude: 3,0, period: 0.6, duration: 3}}"), at("1:41", "ground_motion.harmonic"),
          mentions({"3,0", "3.0"}));
  refused(law("hertz_damped, stiffness: 2,75e9, restitution: 0.65"), at("5:74", "links[0]"),
          mentions({"2,75e9", "2.75e9"}));
  refused(damped("restitution: 0,65"), at("5:95", "links[0]"), mentions({"0,65", "0.65"}));
}

TEST(Newcomer, SpellsOutUnits) {
  refused(one("mass: 100 t, period: 0.8, damping: 5 percent"), at("2:55", "structures.a.oscillator.damping"),
          mentions({"5 %", "percent"}));
  refused(one("mass: 100 t, period: 0.8, damping: 5 pct"), at("2:55", "structures.a.oscillator.damping"),
          mentions({"5 %", "pct"}));
  refused(one("mass: 100 tons, period: 0.8, damping: 5 %"), at("2:26", "structures.a.oscillator.mass"),
          mentions({"100 t", "tons"}));
  refused(one("mass: 100 tonnes, period: 0.8, damping: 5 %"), at("2:26", "structures.a.oscillator.mass"),
          mentions({"100 t", "tonnes"}));
  refused(one("mass: 100 t, period: 0.8 seconds, damping: 5 %"), at("2:41", "structures.a.oscillator.period"),
          mentions({"0.5 s", "seconds"}));
  refused(one("mass: 100 t, stiffness: 6 MN/metre, damping: 5 %"), at("2:44", "structures.a.oscillator.stiffness"),
          mentions({"93500 kN/m", "metre"}));
  refused(one("mass: 100 T, period: 0.8, damping: 5 %"), at("2:26", "structures.a.oscillator.mass"),
          mentions({"100 t", "T"}));
  refused(one("mass: 100 Kg, period: 0.8, damping: 5 %"), at("2:26", "structures.a.oscillator.mass"),
          mentions({"100 t", "Kg", "kg"}));
  refused(one("mass: 1000 kN, period: 0.8, damping: 5 %"), at("2:26", "structures.a.oscillator.mass"),
          mentions({"100 t", "1000 kN"}));
  refused(link("gap: 20 millimetres, law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"),
          mentions({"20 mm", "millimetres"}));
  refused(link("gap: 20mm., law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"), mentions({"20 mm", "mm."}));
  refused(link("gap: 1 inch, law: hertz, stiffness: 2.75e9"), at("5:35", "links[0].gap"),
          mentions({"20 mm", "inch", "in"}));
  refused(ground("{harmonic: {amplitude: 0.3 G, period: 0.6, duration: 3}}"),
          at("1:39", "ground_motion.harmonic.amplitude"), mentions({"0.35 g", "G"}));
  refused(ground("{harmonic: {amplitude: 0.3 g, period: 2 Hz, duration: 3}}"),
          at("1:54", "ground_motion.harmonic.period"), mentions({"0.5 s", "2 Hz"}));
  refused(ground("{synthetic: {seed: 1, duration: 10 s, pga: 35 %, soil: firm}}"),
          at("1:59", "ground_motion.synthetic.pga"), mentions({"0.35 g", "35 %"}));
  refused(mast("E: 30 GPA"), at("4:21", "structures.a.frame.material.E"), mentions({"30 GPa", "GPA"}));
  refused(mast("E: 30 kN/mm2, density: 25 kN/m^3"), at("4:41", "structures.a.frame.material.density"),
          mentions({"2400 kg/m^3", "25 kN/m^3", "N/m^3"}));
}

TEST(Newcomer, TypesImpossibleRestitutions) {
  refused(damped("restitution: 0"), at("5:93", "links[0].restitution"),
          mentions({"kelvin_voigt", "0", "stereomechanical", "restitution"}));
  refused(damped("restitution: 0 %"), at("5:93", "links[0].restitution"),
          mentions({"kelvin_voigt", "0", "stereomechanical", "restitution"}));
  refused(damped("restitution: 1.2"), at("5:93", "links[0].restitution"), mentions({"1.2", "0.65"}));
  refused(damped("restitution: 65"), at("5:93", "links[0].restitution"), mentions({"65 %", "0.65"}));
  refused(damped("restitution: 120 %"), at("5:93", "links[0].restitution"), mentions({"120 %", "0.65"}));
  refused(damped("restitution: -0.65"), at("5:93", "links[0].restitution"), mentions({"-0.65"}));
  refused(damped("restitution: plastic"), at("5:93", "links[0].restitution"), mentions({"5 %", "plastic"}));
  refused(law("stereomechanical, restitution: -0.1"), at("5:78", "links[0].restitution"),
          mentions({"-0.1", "[0, 1]", "0.65"}));
}

TEST(Newcomer, NamesTheLawsOfOtherPrograms) {
  const auto meant = [](const std::string& spec, const std::string& name) {
    refused(law(spec + ", stiffness: 2.75e9, restitution: 0.65"), at("5:47", "links[0].law"),
            mentions({spec, ". Did you mean", name}));
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
  const auto meant = [](const std::string& spec, const std::string& formula, const std::string& laws) {
    refused(law(spec + ", stiffness: 2.75e9, restitution: 0.65"), at("5:47", "links[0].law"),
            mentions({spec, ".", formula, "damping", laws}));
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
  refused(damped("cor: 0.65"), at("5:80", "links[0]"), mentions({"cor", "restitution"}));
  refused(damped("COR: 0.65"), at("5:80", "links[0]"), mentions({"COR", "restitution"}));
  refused(damped("e: 0.65"), at("5:80", "links[0]"), mentions({"e", "restitution"}));
  refused(damped("coefficient_of_restitution: 0.65"), at("5:80", "links[0]"),
          mentions({"coefficient_of_restitution", "restitution"}));
  refused(law("hertz_damped, k: 2.75e9, restitution: 0.65"), at("5:61", "links[0]"), mentions({"k", "stiffness"}));
  refused(damped("n: 1.5, restitution: 0.65"), at("5:80", "links[0]"), mentions({"n", "exponent"}));
  refused(damped("mu: 0.3, restitution: 0.65"), at("5:80", "links[0]"), mentions({"mu", "friction"}));
  refused(one("m: 100 t, period: 0.8, damping: 5 %"), at("2:20", "structures.a.oscillator"), mentions({"m", "mass"}));
  refused(one("mass: 100 t, T: 0.8, damping: 5 %"), at("2:33", "structures.a.oscillator"), mentions({"T", "period"}));
  refused(one("mass: 100 t, period: 0.8, zeta: 5 %"), at("2:46", "structures.a.oscillator"),
          mentions({"zeta", "damping"}));
  refused(one("mass: 100 t, period: 0.8, xi: 5 %"), at("2:46", "structures.a.oscillator"), mentions({"xi", "damping"}));
  refused(mast("E: 30 GPa, nu: 0.2"), at("4:29", "structures.a.frame.material"), mentions({"nu", "poisson"}));
  refused(mast("E: 30 GPa, rho: 2500 kg/m^3"), at("4:29", "structures.a.frame.material"), mentions({"rho", "density"}));
  refused(mast("young: 30 GPa"), at("4:18", "structures.a.frame.material"), mentions({"young", "E"}));
}

TEST(Newcomer, AcceptsWarningsByTheirNames) {
  refused(rest(analysis + "accept: [gpa]\n"), at("7:10", "accept[0]"), mentions({"gpa", "gap"}));
  refused(rest(analysis + "accept: [everything]\n"),
          fmt::format("7:10: accept[0]: unknown warning \"everything\". Allowed: {}.", fmt::join(warning_names, ", ")));
  refused(rest(analysis + "accept: gap\n"), at("7:9", "accept"), mentions({"[a, b]"}));
  refused(rest(analysis + "accept: {gap: true}\n"), at("7:9", "accept"), mentions({"[a, b]"}));
}

TEST(Newcomer, LeavesOutTheUnitOfASpring) {
  refused(mast("E: 30 GPa", "{fix: [uz, ry], springs: {ux: 1.8e-7}}"), at("5:21", "structures.a.frame.nodes.foot"),
          mentions({"springs: {ux: 20 MN/m, ry: 100 MN m}", "1.8e-07 N/m", "foot"}));
  refused(mast("E: 30 GPa", "{fix: [ux, uz], springs: {ry: 1e-7}}"), at("5:34", "structures.a.frame.nodes.top"),
          mentions({"springs: {ux: 20 MN/m, ry: 100 MN m}", "1e-07 N m", "top"}));
  EXPECT_NO_THROW(test::model_of(mast("E: 30 GPa", "{fix: [uz, ry], springs: {ux: 1.8}}")))
      << "a warning reports its period";
}

TEST(Newcomer, TypesAKeyOfAnotherLanguageInsteadOfARequiredOne) {
  refused(link("spalt: 20 mm, law: hertz, stiffness: 2.75e9"), at("5:30", "links[0]"),
          mentions({"unknown key \"spalt\"", "gap", "stiffness"}));
  refused(one("masse: 100 t, period: 0.8"), at("2:20", "structures.a.oscillator"), mentions({"masse", "mass"}));
  refused(rest("analysis: {dauer: 1}\n"), at("6:12", "analysis"), mentions({"dauer", "duration"}));
}

TEST(Newcomer, TypesDecimalCommasInALists) {
  const auto building = [](const std::string& heights) {
    return "structures:\n  a: {shear_building: {storeys: 2, mass: 1 t, stiffness: 1 MN/m, height: " + heights +
           "}, damping: 5 %}\n" + analysis;
  };
  refused(building("[3,5 m, 3,2 m]"), "2:", mentions({"3,5 m", "3.5 m", "comma"}));
  refused(building("[0,5 m]"), "2:", mentions({"0,5 m", "0.5 m", "comma"}));
  refused(building("[3.5 m, 3.2 m, 3 m]"), "2:", mentions({"2", "3"}));
  EXPECT_EQ(test::refusal<InputError>([&] { test::model_of(building("[3.5 m, 3.2 m, 3 m]")); }).find("comma"),
            std::string::npos);
}

TEST(Newcomer, MistypesTheFileOfARecord) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "mistyped_records";
  std::filesystem::create_directories(folder / "inside");
  std::ofstream(folder / "elcentro.csv") << "t (s),a (m/s^2)\n0,0\n1,1\n";
  const auto message = [&](const std::string& record) {
    const std::string text = "ground_motion: {record: " + record + "}\n" + rest(analysis);
    return test::refusal<InputError>([&] { read_model(Input::read_text(text, (folder / "model.yaml").string())); });
  };
  EXPECT_TRUE(
      mentions(message("elcentrp.csv"), {"model.yaml:1:25", "elcentrp.csv", "\"elcentro.csv\"", folder.string()}));
  EXPECT_TRUE(mentions(message("other.AT2"), {"model.yaml:1:25", "elcentro.csv"}));
  EXPECT_TRUE(mentions(message("nowhere/other.AT2"), {"model.yaml:1:25", "nowhere"}));
  EXPECT_TRUE(mentions(message("inside"), {"model.yaml:1:25", "inside/record.AT2"}));
  std::filesystem::remove_all(folder);
}

}  // namespace newcomer_test
}  // namespace pounding
