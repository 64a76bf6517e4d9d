// Errors in structures, ground motion and analysis: location, text that was read, allowed values, text to type.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/input/read_model.hpp>
#include "support/models.hpp"

namespace pounding {
namespace read_model_test {

using test::at, test::mentions, test::refused;

const std::string two_oscillators =
    "structures:\n  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n  right: {oscillator: {mass: 150 t, "
    "period: 0.4, damping: 5 %}}\n";
const std::string analysis = "analysis: {duration: 1}\n";

std::string whole(const std::string& rest) { return two_oscillators + rest + "\n"; }
std::string file(const std::string& text) { return text; }
std::string structure(const std::string& text) { return "structures:\n  a: " + text + "\n" + analysis; }
std::string building(const std::string& rest) {
  return structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m}, " + rest + "}");
}
std::string ground(const std::string& text) { return "ground_motion: " + text + "\n" + two_oscillators + analysis; }

TEST(ModelInput, KnowsItsKeys) {
  refused(whole("analysis: {duration: 1}\nanalyse: 3"), at("5:1"), mentions({"analyse", "analysis"}));
  refused(whole("link: []\nanalysis: {duration: 1}\n"), at("4:1"), mentions({"link", "links"}));
  refused(whole("ground_motions: {}\nanalysis: {duration: 1}\n"), at("4:1"),
          mentions({"ground_motions", "ground_motion"}));
  refused(whole("analysis: {duration: 1}\ncompare: yes"), at("5:10", "compare"), mentions({"yes", "no_pounding"}));
  refused(whole("analysis: {duration: 1}\ntitle: [a]"), at("5:8", "title"));
}

TEST(ModelInput, IsAMapWithStructures) {
  refused(file(""), at("1:1"));
  refused(file("a: [b"), at("1:1"), mentions({"[", "]", "YAML"}));
  refused(file("- 1\n"), at("1:1"), mentions({"{key: value}"}));
  refused(file("title: x\n"), at("1:1"),
          mentions({"structures: {left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}}"}));
  refused(file("structures: {}\nanalysis: {duration: 1}\n"), at("1:13", "structures"), mentions({"shear_building"}));
  refused(file("structures:\nanalysis: {duration: 1}\n"), at("1:1", "structures"),
          mentions({"left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}"}));
  refused(file("structures: []\nanalysis: {duration: 1}\n"), at("1:13", "structures"),
          mentions({"left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}"}));
  refused(file("structures: {a: {wall: {}}}\nanalysis: {duration: 1}\n"), at("1:13", "structures"),
          mentions({"shear_building"}));
  refused(file("structures:\n  a: {body: {mass: 1}}\n  a: {body: {mass: 1}}\nanalysis: {duration: 1}\n"),
          at("3:3", "structures"), mentions({"a"}));
}

TEST(StructureInput, HasANameThatFilesAllow) {
  refused(file("structures: {a.b: {body: {mass: 1}}}\nanalysis: {duration: 1}\n"), at("1:14", "structures.a.b"),
          mentions({".", "/", "left_building"}));
  refused(file("structures: {a/b: {body: {mass: 1}}}\nanalysis: {duration: 1}\n"), at("1:14"),
          mentions({"/", "structures.a", "left_building"}));
  refused(file("structures: {\"\": {body: {mass: 1}}}\nanalysis: {duration: 1}\n"), at("1:14"),
          mentions({".", "/", "left_building"}));
}

TEST(StructureInput, HasOneKnownKind) {
  refused(structure("{}"), at("2:6", "structures.a"), mentions({"shear_building"}));
  refused(structure(""), at("2:3", "structures.a"), mentions({"{key: value}"}));
  refused(structure("wall"), at("2:6", "structures.a"), mentions({"wall: {}"}));
  refused(structure("{oscilator: {mass: 1}}"), at("2:7", "structures.a"), mentions({"oscilator", "oscillator"}));
  refused(structure("{wall: {}, body: {mass: 1}}"), at("2:7", "structures.a.wall"));
  refused(structure("{body: {mass: 1}, mass: 3}"), at("2:24", "structures.a"),
          mentions({"mass", "damping", "initial_velocity", "initial_displacement"}));
}

TEST(StructureInput, OfAWallHasNoKeys) {
  refused(structure("{wall: {mass: 1}}"), at("2:14", "structures.a.wall.mass"), mentions({"wall: {}"}));
  refused(structure("{wall: 3}"), at("2:13", "structures.a.wall"), mentions({"wall: {}"}));
  refused(structure("{wall: {}, initial_velocity: 1}"), at("2:17", "structures.a.initial_velocity"),
          mentions({"wall", "ground"}));
  refused(structure("{wall: {}, initial_displacement: 1}"), at("2:17", "structures.a.initial_displacement"),
          mentions({"wall", "ground"}));
  refused(structure("{wall: {}, damping: 5 %}"), at("2:17", "structures.a.damping"), mentions({"damping", "wall"}));
}

TEST(StructureInput, OfABodyHasAMass) {
  refused(structure("{body: {}}"), at("2:13", "structures.a.body"), mentions({"mass: 100 t"}));
  refused(structure("{body: 5}"), at("2:13", "structures.a.body"), mentions({"{mass: 60 t}"}));
  refused(structure("{body: {mass: 0}}"), at("2:20", "structures.a.body.mass"), mentions({"100 t", "0"}));
  refused(structure("{body: {mass: -5 t}}"), at("2:20", "structures.a.body.mass"), mentions({"100 t", "-5 t"}));
  refused(structure("{body: {mass: 5 kN}}"), at("2:20", "structures.a.body.mass"), mentions({"100 t", "5 kN"}));
  refused(structure("{body: {mass: .nan}}"), at("2:20", "structures.a.body.mass"), mentions({"100 t", ".nan"}));
  refused(structure("{body: {mass: 5 t, period: 1}}"), at("2:25", "structures.a.body"),
          mentions({"period", "mass", "gravity", "initial_velocity"}));
  refused(structure("{body: {mass: 5 t}, damping: 5 %}"), at("2:26", "structures.a.damping"), mentions({"damping"}));
}

TEST(StructureInput, OfAnOscillatorHasAPeriodOrAStiffness) {
  refused(structure("{oscillator: {period: 5}}"), at("2:19", "structures.a.oscillator"), mentions({"mass: 100 t"}));
  refused(structure("{oscillator: {mass: 5 t, damping: 0}}"), at("2:19", "structures.a.oscillator"),
          mentions({"period: 0.8 s", "stiffness: 6.2 MN/m"}));
  refused(structure("{oscillator: {mass: 5 t, period: 1, stiffness: 1, damping: 0}}"),
          at("2:42", "structures.a.oscillator.stiffness"), mentions({"stiffness"}));
  refused(structure("{oscillator: {mass: 5 t, period: 0, damping: 0}}"), at("2:39", "structures.a.oscillator.period"),
          mentions({"0.5 s"}));
  refused(structure("{oscillator: {mass: 5 t, period: -1, damping: 0}}"), at("2:39", "structures.a.oscillator.period"),
          mentions({"0.5 s", "-1"}));
  refused(structure("{oscillator: {mass: 5 t, period: 1 m, damping: 0}}"), at("2:39", "structures.a.oscillator.period"),
          mentions({"0.5 s", "1 m"}));
  refused(structure("{oscillator: {mass: 5 t, stiffness: -1, damping: 0}}"),
          at("2:42", "structures.a.oscillator.stiffness"), mentions({"93500 kN/m", "-1"}));
  refused(structure("{oscillator: {mass: 5 t, period: .inf, damping: 0}}"),
          at("2:39", "structures.a.oscillator.period"), mentions({"0.5 s", ".inf"}));
}

TEST(StructureInput, OfAShearBuildingHasOneValuePerStorey) {
  refused(structure("{shear_building: {mass: 5 t, stiffness: 1 MN/m}, damping: 0}"),
          at("2:23", "structures.a.shear_building"), mentions({"storeys: 5"}));
  refused(structure("{shear_building: {storeys: 0, mass: 5 t, stiffness: 1 MN/m}, damping: 0}"),
          at("2:33", "structures.a.shear_building.storeys"), mentions({"0", "1000"}));
  refused(structure("{shear_building: {storeys: 2.5, mass: 5 t, stiffness: 1 MN/m}, damping: 0}"),
          at("2:33", "structures.a.shear_building.storeys"), mentions({"2.5", "1000"}));
  refused(structure("{shear_building: {storeys: 3, stiffness: 1 MN/m}, damping: 0}"),
          at("2:23", "structures.a.shear_building"), mentions({"mass: 250 t"}));
  refused(structure("{shear_building: {storeys: 3, mass: [5 t, 6 t], stiffness: 1 MN/m}, damping: 0}"),
          at("2:42", "structures.a.shear_building.mass"), mentions({"100 t", "3", "2"}));
  refused(structure("{shear_building: {storeys: 2, mass: 5 t}, damping: 0}"), at("2:23", "structures.a.shear_building"),
          mentions({"stiffness: 350 MN/m"}));
  refused(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: [1 MN/m, 0]}, damping: 0}"),
          at("2:67", "structures.a.shear_building.stiffness[1]"), mentions({"93500 kN/m", "0"}));
  refused(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m, height: 0}, damping: 0}"),
          at("2:74", "structures.a.shear_building.height"), mentions({"20 mm", "0"}));
  refused(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m, hieght: 3}, damping: 0}"),
          at("2:66", "structures.a.shear_building"), mentions({"hieght", "height"}));
}

TEST(DampingInput, HasNoDefault) {
  refused(structure("{oscillator: {mass: 5 t, period: 1}}"), at("2:19", "structures.a.oscillator"),
          mentions({"damping: 5 %", "damping: 0"}));
  refused(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m}}"),
          at("2:23", "structures.a.shear_building"), mentions({"damping: 5 %", "damping: 0"}));
  refused(structure("{oscillator: {mass: 5 t, period: 1, damping: 5 %}, damping: 5 %}"),
          at("2:57", "structures.a.damping"), mentions({"damping"}));
}

TEST(DampingInput, IsARatioFromZeroToBelowOne) {
  refused(building("damping: 5"), at("2:76", "structures.a.damping"), mentions({"5 %", "[0, 1)"}));
  refused(building("damping: -5 %"), at("2:76", "structures.a.damping"), mentions({"-5 %", "[0, 1)"}));
  refused(building("damping: .nan"), at("2:76", "structures.a.damping"), mentions({"5 %", ".nan"}));
  refused(building("damping: 5 kg"), at("2:76", "structures.a.damping"), mentions({"5 %", "5 kg"}));
  refused(building("damping: [5 %, 5 %]"), at("2:76", "structures.a.damping"), mentions({"5 %", "[0, 1)"}));
}

TEST(DampingInput, IsRayleighOrModal) {
  refused(building("damping: {}"), at("2:76", "structures.a.damping"),
          mentions({"damping: {rayleigh: {ratio: 5 %, modes: [1, 2]}}", "modal"}));
  refused(building("damping: {modal: {ratio: 5 %}, rayleigh: {ratio: 5 %}}"), at("2:77", "structures.a.damping.modal"),
          mentions({"rayleigh", "modal"}));
  refused(building("damping: {rayliegh: {ratio: 5 %}}"), at("2:77", "structures.a.damping"),
          mentions({"rayliegh", "rayleigh"}));
  refused(building("damping: {modal: {}}"), at("2:84", "structures.a.damping.modal"), mentions({"ratio: 5 %"}));
  refused(building("damping: {modal: 5 %}"), at("2:84", "structures.a.damping.modal"), mentions({"{ratio: 5 %}"}));
  refused(building("damping: {rayleigh: {modes: [1, 2]}}"), at("2:87", "structures.a.damping.rayleigh"),
          mentions({"ratio: 5 %"}));
  refused(building("damping: {modal: {ratio: 5 %, modes: [1, 2]}}"), at("2:97", "structures.a.damping.modal"),
          mentions({"modes", "ratio"}));
}

TEST(DampingInput, TakesTwoModesOrTwoPeriods) {
  refused(building("damping: {rayleigh: {ratio: 5 %, modes: [1, 3]}}"),
          at("2:111", "structures.a.damping.rayleigh.modes[1]"), mentions({"3", "2"}));
  refused(building("damping: {rayleigh: {ratio: 5 %, modes: [1]}}"), at("2:107", "structures.a.damping.rayleigh.modes"),
          mentions({"modes: [1, 2]"}));
  refused(building("damping: {rayleigh: {ratio: 5 %, modes: 1}}"), at("2:107", "structures.a.damping.rayleigh.modes"),
          mentions({"modes: [1, 2]"}));
  refused(building("damping: {rayleigh: {ratio: 5 %, modes: [1, 2], periods: [1, 2]}}"),
          at("2:115", "structures.a.damping.rayleigh.periods"), mentions({"modes"}));
  refused(building("damping: {rayleigh: {ratio: 5 %, periods: [1, 0]}}"),
          at("2:113", "structures.a.damping.rayleigh.periods[1]"), mentions({"0.5 s"}));
  refused(building("damping: {rayleigh: {ratio: 5 %, periods: [1 s, 2 s, 3 s]}}"),
          at("2:109", "structures.a.damping.rayleigh.periods"), mentions({"0.5 s", "2", "3"}));
}

TEST(InitialMotionInput, IsAVelocityOrADisplacementPerFloor) {
  refused(building("damping: 0, initial_velocity: 1 m"), at("2:97", "structures.a.initial_velocity"),
          mentions({"0.3 m/s", "1 m"}));
  refused(building("damping: 0, initial_velocity: [1, 2, 3]"), at("2:97", "structures.a.initial_velocity"),
          mentions({"0.3 m/s", "2"}));
  refused(building("damping: 0, initial_displacement: 1 s"), at("2:101", "structures.a.initial_displacement"),
          mentions({"20 mm", "1 s"}));
  refused(building("damping: 0, initial_displacement: [1 mm, .nan]"),
          at("2:108", "structures.a.initial_displacement[1]"), mentions({"20 mm", ".nan"}));
}

TEST(AnalysisInput, HasADurationUnlessTheGroundMotionHasOne) {
  refused(whole(""), at("1:1"), mentions({"analysis: {duration: 10 s}"}));
  refused(whole("analysis: {tolerance: 1e-5}"), at("4:11", "analysis"), mentions({"analysis: {duration: 10 s}"}));
  refused(whole("analysis: {duration: 0}"), at("4:22", "analysis.duration"), mentions({"0.5 s"}));
  refused(whole("analysis: {duration: -1 s}"), at("4:22", "analysis.duration"), mentions({"0.5 s", "-1 s"}));
  refused(whole("analysis: {duration: 5 m}"), at("4:22", "analysis.duration"), mentions({"0.5 s", "5 m"}));
}

TEST(AnalysisInput, TakesOptionsOfTheIntegrator) {
  refused(whole("analysis: {duration: 1, tolerance: 0}"), at("4:36", "analysis.tolerance"),
          mentions({"5 %", "[1e-10, 0.1]"}));
  refused(whole("analysis: {duration: 1, tolerance: 0.5}"), at("4:36", "analysis.tolerance"),
          mentions({"5 %", "0.5", "[1e-10, 0.1]"}));
  refused(whole("analysis: {duration: 1, tolerance: 1e-12}"), at("4:36", "analysis.tolerance"),
          mentions({"5 %", "1e-12", "[1e-10, 0.1]"}));
  refused(whole("analysis: {duration: 1, tolerance: 1 mm}"), at("4:36", "analysis.tolerance"),
          mentions({"5 %", "1 mm"}));
  refused(whole("analysis: {duration: 1, integrator: newmark}"), at("4:37", "analysis.integrator"),
          mentions({"newmark", "generalized_alpha", "esdirk4"}));
  refused(whole("analysis: {duration: 1, integrator: generalized_alpha, spectral_radius: 2}"),
          at("4:73", "analysis.spectral_radius"), mentions({"5 %", "2", "[0, 1]"}));
  refused(whole("analysis: {duration: 1, spectral_radius: 0.8}"), at("4:42", "analysis.spectral_radius"),
          mentions({"integrator: generalized_alpha"}));
  refused(whole("analysis: {duration: 1, integrator: esdirk4, spectral_radius: 0.8}"),
          at("4:63", "analysis.spectral_radius"), mentions({"generalized_alpha", "esdirk4"}));
  refused(whole("analysis: {duration: 1, output_step: 0}"), at("4:38", "analysis.output_step"), mentions({"0.5 s"}));
  refused(whole("analysis: {duration: 1, output_step: 5 s}"), at("4:38", "analysis.output_step"), mentions({"0.5 s"}));
  refused(whole("analysis: {duration: 1, max_step: 0}"), at("4:35", "analysis.max_step"), mentions({"0.5 s"}));
  refused(whole("analysis: {duraton: 1}"), at("4:12", "analysis"), mentions({"duraton", "duration"}));
  refused(whole("analysis: 5"), at("4:11", "analysis"), mentions({"{duration: 10 s}"}));
}

TEST(GroundMotionInput, IsOneKindInItsUnits) {
  refused(ground("{}"), at("1:16", "ground_motion"),
          mentions({"ground_motion", "record", "harmonic", "sum", "pulse", "synthetic", "displacement"}));
  refused(ground("{harmonc: {amplitude: 3}}"), at("1:17", "ground_motion"), mentions({"harmonc", "harmonic"}));
  refused(ground("{harmonic: {amplitude: 3}}"), at("1:27", "ground_motion.harmonic"), mentions({"period: 0.5 s"}));
  refused(ground("{harmonic: {amplitude: 3 m, period: 0.5, duration: 1}}"),
          at("1:39", "ground_motion.harmonic.amplitude"), mentions({"0.35 g", "3 m"}));
  refused(ground("{harmonic: {amplitude: 3, period: 0.5, duration: 1}, pulse: {}}"), at("1:69", "ground_motion.pulse"),
          mentions({"harmonic", "pulse"}));
  refused(ground("{synthetic: {seed: 1, duration: 10, soil: firm}}"), at("1:28", "ground_motion.synthetic"),
          mentions({"pga: 0.35 g"}));
}

TEST(GroundMotionInput, ReportsAMissingRecord) {
  refused(ground("{record: nothere.at2}"), at("1:25", "ground_motion.record"), mentions({"nothere.at2"}));
}

TEST(GroundMotionInput, ReportsErrorsInARecord) {
  const std::string path = testing::TempDir() + "broken_record.csv";
  std::ofstream(path) << "0, 1\n0.1, abc\n0.2, 3\n";
  refused(ground("{record: " + path + "}"), at("1:25", "ground_motion.record"), mentions({path, "abc", "2"}));
  std::remove(path.c_str());
}

TEST(ModelInput, RefusesTheFilesOfManyRuns) {
  refused(whole("records: {files: a.csv}\n" + analysis), at("4:10", "records"), mentions({"pounding suite"}));
  refused(whole("study: {factors: {}}\n" + analysis), at("4:8", "study"), mentions({"pounding study"}));
}

TEST(ModelInput, IsAcceptedIfValid) {
  EXPECT_NO_THROW(test::model_of(whole("title: good\nlinks: []\ncompare: no_pounding\n" + analysis)));
  EXPECT_NO_THROW(
      test::model_of(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m, damping: 5 %}}")));
}

TEST(ModelInput, CanBeReadAgainWithOtherValuesAndGroundMotion) {
  const Input input = Input::read_text(ground("{record: nothere.at2}"), "row.yaml");
  const GroundSection given(Harmonic{.amplitude = 1, .period = 0.5, .duration = 2});
  Input period = input.at("structures").at("left").at("oscillator").at("period");
  const auto stiffness = [&] { return read_model(input, dense_modes, 1, &given).structures[0].stiffness.coeff(0, 0); };
  const double before = stiffness();
  period.rewrite("1.6 s");
  EXPECT_DOUBLE_EQ(stiffness(), before / 4);
  EXPECT_EQ(read_model(input, dense_modes, 1, &given).ground.components[0].duration(), 2);
  period.rewrite("-1 s");
  try {
    stiffness();
    ADD_FAILURE() << "a period of -1 s was accepted";
  } catch (const InputError& error) {
    EXPECT_TRUE(mentions(error.what(), {"structures.left.oscillator.period"}));
  }
  EXPECT_THROW(input.at("structures").rewrite("1"), InputError);
}

}  // namespace read_model_test
}  // namespace pounding
