// Every mistake in structures, ground motion and analysis: where it is, what was read, what is allowed, what to type.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/input/read_model.hpp>

#include "support/refusals.hpp"

namespace pounding {
namespace read_model_test {

using test::refused;

const std::string two_oscillators =
    "structures:\n"
    "  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n"
    "  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}\n";
const std::string analysis = "analysis: {duration: 1}\n";

std::string whole(const std::string& rest) { return two_oscillators + rest + "\n"; }
std::string file(const std::string& text) { return text; }
std::string structure(const std::string& text) { return "structures:\n  a: " + text + "\n" + analysis; }
std::string building(const std::string& rest) {
  return structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m}, " + rest + "}");
}
std::string ground(const std::string& text) { return "ground_motion: " + text + "\n" + two_oscillators + analysis; }

TEST(ModelInput, KnowsItsKeys) {
  refused(whole("analysis: {duration: 1}\nanalyse: 3"), R"(5:1: unknown key "analyse". Did you mean "analysis"?)");
  refused(whole("link: []\nanalysis: {duration: 1}\n"), R"(4:1: unknown key "link". Did you mean "links"?)");
  refused(whole("ground_motions: {}\nanalysis: {duration: 1}\n"),
          R"(4:1: unknown key "ground_motions". Did you mean "ground_motion"?)");
  refused(whole("analysis: {duration: 1}\ncompare: yes"),
          R"(5:10: compare: unknown comparison "yes". Allowed: no_pounding.)");
  refused(whole("analysis: {duration: 1}\ntitle: [a]"), "5:8: title: takes a text; a list was read");
}

TEST(ModelInput, IsAMapWithStructures) {
  refused(file(""), "1:1: the file is empty");
  refused(file("a: [b"), "1:1: this is not YAML: end of sequence flow not found; a \"[\" lacks its \"]\"");
  refused(file("- 1\n"), "1:1: takes keys with values such as {key: value}; a list was read");
  refused(file("title: x\n"),
          R"(1:1: key "structures" is missing; type "structures: {left: {oscillator: {mass: 100 t, period: 0.8, )"
          R"(damping: 5 %}}}")");
  refused(file("structures: {}\nanalysis: {duration: 1}\n"),
          "1:13: structures: no structure that can move; add a body, an oscillator, a shear_building or a frame");
  refused(file("structures:\nanalysis: {duration: 1}\n"),
          "1:1: structures: takes keys with values such as {left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 "
          "%}}}; nothing was read");
  refused(file("structures: []\nanalysis: {duration: 1}\n"),
          "1:13: structures: takes keys with values such as {left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 "
          "%}}}; a list was read");
  refused(file("structures: {a: {wall: {}}}\nanalysis: {duration: 1}\n"),
          "1:13: structures: no structure that can move; add a body, an oscillator, a shear_building or a frame");
  refused(file("structures:\n  a: {body: {mass: 1}}\n  a: {body: {mass: 1}}\nanalysis: {duration: 1}\n"),
          R"(3:3: structures: key "a" is given twice; keep one of them)");
}

TEST(StructureInput, HasANameThatFilesCanHold) {
  refused(file("structures: {a.b: {body: {mass: 1}}}\nanalysis: {duration: 1}\n"),
          R"(1:14: structures.a.b: a name must not be empty or contain "." or "/"; type a name such as )"
          "left_building");
  refused(file("structures: {a/b: {body: {mass: 1}}}\nanalysis: {duration: 1}\n"),
          R"(1:14: structures.a/b: a name must not be empty or contain "." or "/"; type a name such as )"
          "left_building");
  refused(file("structures: {\"\": {body: {mass: 1}}}\nanalysis: {duration: 1}\n"),
          R"(1:14: structures.: a name must not be empty or contain "." or "/"; type a name such as left_building)");
}

TEST(StructureInput, HasOneKnownKind) {
  refused(structure("{}"),
          "2:6: structures.a: the kind of the structure is missing; it is one of body, oscillator, "
          "shear_building, frame, wall");
  refused(structure(""), "2:3: structures.a: takes keys with values such as {key: value}; nothing was read");
  refused(structure("wall"), "2:6: structures.a: a wall is written as {wall: {}}");
  refused(structure("{oscilator: {mass: 1}}"),
          R"(2:7: structures.a: unknown key "oscilator". Did you mean "oscillator"?)");
  refused(structure("{wall: {}, body: {mass: 1}}"),
          "2:7: structures.a.wall: a structure has one kind, and a body is given too; keep one of the two");
  refused(structure("{body: {mass: 1}, mass: 3}"),
          R"(2:24: structures.a: unknown key "mass". Allowed: damping, initial_velocity, initial_displacement, face, )"
          "delay, ground_motion, forces, reduction, body, oscillator, shear_building, frame, wall.");
}

TEST(StructureInput, OfAWallHasNothingElse) {
  refused(structure("{wall: {mass: 1}}"), "2:14: structures.a.wall.mass: a wall has no parameters; type wall: {}");
  refused(structure("{wall: 3}"), "2:13: structures.a.wall: a wall has no parameters; type wall: {}");
  refused(structure("{wall: {}, initial_velocity: 1}"),
          "2:17: structures.a.initial_velocity: a wall moves with the ground; leave it out");
  refused(structure("{wall: {}, initial_displacement: 1}"),
          "2:17: structures.a.initial_displacement: a wall moves with the ground; leave it out");
  refused(structure("{wall: {}, damping: 5 %}"),
          "2:17: structures.a.damping: a wall has no damping of its own; leave it out");
}

TEST(StructureInput, OfABodyHasAMass) {
  refused(structure("{body: {}}"), R"(2:13: structures.a.body: key "mass" is missing; type "mass: 100 t")");
  refused(structure("{body: 5}"),
          "2:13: structures.a.body: takes keys with values such as {mass: 60 t}; a single value was read");
  refused(structure("{body: {mass: 0}}"),
          R"(2:20: structures.a.body.mass: takes a mass > 0 such as "100 t"; "0" is outside)");
  refused(structure("{body: {mass: -5 t}}"),
          R"(2:20: structures.a.body.mass: takes a mass > 0 such as "100 t"; "-5 t" is outside)");
  refused(structure("{body: {mass: 5 kN}}"),
          R"(2:20: structures.a.body.mass: takes a mass such as "100 t"; "5 kN" is a force)");
  refused(structure("{body: {mass: .nan}}"),
          R"(2:20: structures.a.body.mass: takes a mass such as "100 t"; ".nan" is not a finite number)");
  refused(
      structure("{body: {mass: 5 t, period: 1}}"),
      R"(2:25: structures.a.body: unknown key "period". Allowed: mass, gravity, initial_velocity, initial_displacement.)");
  refused(structure("{body: {mass: 5 t}, damping: 5 %}"),
          "2:26: structures.a.damping: a body has no damping of its own; leave it out");
}

TEST(StructureInput, OfAnOscillatorHasAPeriodOrAStiffness) {
  refused(structure("{oscillator: {period: 5}}"),
          R"(2:19: structures.a.oscillator: key "mass" is missing; type "mass: 100 t")");
  refused(structure("{oscillator: {mass: 5 t, damping: 0}}"),
          "2:19: structures.a.oscillator: the stiffness is missing; type period: 0.8 s, or stiffness: 6.2 MN/m");
  refused(structure("{oscillator: {mass: 5 t, period: 1, stiffness: 1, damping: 0}}"),
          "2:42: structures.a.oscillator.stiffness: give the period or the stiffness, not both");
  refused(structure("{oscillator: {mass: 5 t, period: 0, damping: 0}}"),
          R"(2:39: structures.a.oscillator.period: takes a time > 0 such as "0.5 s"; "0" is outside)");
  refused(structure("{oscillator: {mass: 5 t, period: -1, damping: 0}}"),
          R"(2:39: structures.a.oscillator.period: takes a time > 0 such as "0.5 s"; "-1" is outside)");
  refused(structure("{oscillator: {mass: 5 t, period: 1 m, damping: 0}}"),
          R"(2:39: structures.a.oscillator.period: takes a time such as "0.5 s"; "1 m" is a length)");
  refused(structure("{oscillator: {mass: 5 t, stiffness: -1, damping: 0}}"),
          R"(2:42: structures.a.oscillator.stiffness: takes a stiffness > 0 such as "93500 kN/m"; "-1" is outside)");
  refused(structure("{oscillator: {mass: 5 t, period: .inf, damping: 0}}"),
          R"(2:39: structures.a.oscillator.period: takes a time such as "0.5 s"; ".inf" is not a finite number)");
}

TEST(StructureInput, OfAShearBuildingHasAValueAStorey) {
  refused(structure("{shear_building: {mass: 5 t, stiffness: 1 MN/m}, damping: 0}"),
          R"(2:23: structures.a.shear_building: key "storeys" is missing; type "storeys: 5")");
  refused(structure("{shear_building: {storeys: 0, mass: 5 t, stiffness: 1 MN/m}, damping: 0}"),
          R"(2:33: structures.a.shear_building.storeys: takes an integer from 1 to 1000; "0" is outside)");
  refused(structure("{shear_building: {storeys: 2.5, mass: 5 t, stiffness: 1 MN/m}, damping: 0}"),
          R"(2:33: structures.a.shear_building.storeys: takes an integer from 1 to 1000; "2.5" is not one)");
  refused(structure("{shear_building: {storeys: 3, stiffness: 1 MN/m}, damping: 0}"),
          R"(2:23: structures.a.shear_building: key "mass" is missing; type "mass: 250 t")");
  refused(structure("{shear_building: {storeys: 3, mass: [5 t, 6 t], stiffness: 1 MN/m}, damping: 0}"),
          R"(2:42: structures.a.shear_building.mass: takes a mass > 0 such as "100 t" or a list of 3 from the )"
          "ground up; a list of 2 was read");
  refused(structure("{shear_building: {storeys: 2, mass: 5 t}, damping: 0}"),
          R"(2:23: structures.a.shear_building: key "stiffness" is missing; type "stiffness: 350 MN/m")");
  refused(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: [1 MN/m, 0]}, damping: 0}"),
          R"(2:67: structures.a.shear_building.stiffness[1]: takes a stiffness > 0 such as "93500 kN/m"; "0" is )"
          "outside");
  refused(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m, height: 0}, damping: 0}"),
          R"(2:74: structures.a.shear_building.height: takes a length > 0 such as "20 mm"; "0" is outside)");
  refused(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m, hieght: 3}, damping: 0}"),
          R"(2:66: structures.a.shear_building: unknown key "hieght". Did you mean "height"?)");
}

TEST(DampingInput, HasNoDefault) {
  refused(structure("{oscillator: {mass: 5 t, period: 1}}"),
          "2:19: structures.a.oscillator: damping is missing; type damping: 5 %, or damping: 0 for none");
  refused(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m}}"),
          "2:23: structures.a.shear_building: damping is missing; type damping: 5 %, or damping: 0 for none");
  refused(structure("{oscillator: {mass: 5 t, period: 1, damping: 5 %}, damping: 5 %}"),
          R"(2:57: structures.a.damping: "damping" is given twice; keep one of the two)");
}

TEST(DampingInput, IsARatioFromZeroToBelowOne) {
  refused(building("damping: 5"),
          R"(2:76: structures.a.damping: takes a number in [0, 1) such as "5 %"; "5" is outside)");
  refused(building("damping: -5 %"),
          R"(2:76: structures.a.damping: takes a number in [0, 1) such as "5 %"; "-5 %" is outside)");
  refused(building("damping: .nan"),
          R"(2:76: structures.a.damping: takes a number such as "5 %"; ".nan" is not a finite number)");
  refused(building("damping: 5 kg"), R"(2:76: structures.a.damping: takes a number such as "5 %"; "5 kg" is a mass)");
  refused(building("damping: [5 %, 5 %]"),
          R"(2:76: structures.a.damping: takes a number in [0, 1) such as "5 %"; a list was read)");
}

TEST(DampingInput, IsRayleighOrModal) {
  refused(building("damping: {}"),
          "2:76: structures.a.damping: takes one of rayleigh and modal; type damping: {rayleigh: {ratio: 5 %, "
          "modes: [1, 2]}}");
  refused(building("damping: {modal: {ratio: 5 %}, rayleigh: {ratio: 5 %}}"),
          "2:76: structures.a.damping: takes one of rayleigh and modal; type damping: {rayleigh: {ratio: 5 %, "
          "modes: [1, 2]}}");
  refused(building("damping: {rayliegh: {ratio: 5 %}}"),
          R"(2:77: structures.a.damping: unknown key "rayliegh". Did you mean "rayleigh"?)");
  refused(building("damping: {modal: {}}"),
          R"(2:84: structures.a.damping.modal: key "ratio" is missing; type "ratio: 5 %")");
  refused(building("damping: {modal: 5 %}"),
          "2:84: structures.a.damping.modal: takes keys with values such as {ratio: 5 %}; a single value was read");
  refused(building("damping: {rayleigh: {modes: [1, 2]}}"),
          R"(2:87: structures.a.damping.rayleigh: key "ratio" is missing; type "ratio: 5 %")");
  refused(building("damping: {modal: {ratio: 5 %, modes: [1, 2]}}"),
          R"(2:97: structures.a.damping.modal: unknown key "modes". Allowed: ratio.)");
}

TEST(DampingInput, TakesTwoModesOrTwoPeriods) {
  refused(building("damping: {rayleigh: {ratio: 5 %, modes: [1, 3]}}"),
          R"(2:111: structures.a.damping.rayleigh.modes[1]: takes an integer from 1 to 2; "3" is outside)");
  refused(building("damping: {rayleigh: {ratio: 5 %, modes: [1]}}"),
          "2:107: structures.a.damping.rayleigh.modes: takes two mode numbers; type modes: [1, 2]");
  refused(building("damping: {rayleigh: {ratio: 5 %, modes: 1}}"),
          "2:107: structures.a.damping.rayleigh.modes: takes two mode numbers; type modes: [1, 2]");
  refused(building("damping: {rayleigh: {ratio: 5 %, modes: [1, 2], periods: [1, 2]}}"),
          "2:115: structures.a.damping.rayleigh.periods: give modes or periods, not both");
  refused(building("damping: {rayleigh: {ratio: 5 %, periods: [1, 0]}}"),
          R"(2:113: structures.a.damping.rayleigh.periods[1]: takes a time > 0 such as "0.5 s"; "0" is outside)");
  refused(building("damping: {rayleigh: {ratio: 5 %, periods: [1 s, 2 s, 3 s]}}"),
          R"(2:109: structures.a.damping.rayleigh.periods: takes a time > 0 such as "0.5 s" or a list of 2 from )"
          "the ground up; a list of 3 was read");
}

TEST(InitialMotionInput, IsAVelocityOrADisplacementAFloor) {
  refused(building("damping: 0, initial_velocity: 1 m"),
          R"(2:97: structures.a.initial_velocity: takes a velocity such as "0.3 m/s"; "1 m" is a length)");
  refused(building("damping: 0, initial_velocity: [1, 2, 3]"),
          R"(2:97: structures.a.initial_velocity: takes a velocity such as "0.3 m/s" or a list of 2 from the )"
          "ground up; a list of 3 was read");
  refused(building("damping: 0, initial_displacement: 1 s"),
          R"(2:101: structures.a.initial_displacement: takes a length such as "20 mm"; "1 s" is a time)");
  refused(building("damping: 0, initial_displacement: [1 mm, .nan]"),
          R"(2:108: structures.a.initial_displacement[1]: takes a length such as "20 mm"; ".nan" is not a finite )"
          "number");
}

TEST(AnalysisInput, HasADurationUnlessTheGroundMotionHasOne) {
  refused(whole(""), "1:1: the duration is missing; type analysis: {duration: 10 s}");
  refused(whole("analysis: {tolerance: 1e-5}"),
          "4:11: analysis: the duration is missing; type analysis: {duration: 10 s}");
  refused(whole("analysis: {duration: 0}"),
          R"(4:22: analysis.duration: takes a time > 0 such as "0.5 s"; "0" is outside)");
  refused(whole("analysis: {duration: -1 s}"),
          R"(4:22: analysis.duration: takes a time > 0 such as "0.5 s"; "-1 s" is outside)");
  refused(whole("analysis: {duration: 5 m}"),
          R"(4:22: analysis.duration: takes a time such as "0.5 s"; "5 m" is a length)");
}

TEST(AnalysisInput, TakesWhatTheIntegratorCanDo) {
  refused(whole("analysis: {duration: 1, tolerance: 0}"),
          R"(4:36: analysis.tolerance: takes a number in [1e-10, 0.1] such as "5 %"; "0" is outside)");
  refused(whole("analysis: {duration: 1, tolerance: 0.5}"),
          R"(4:36: analysis.tolerance: takes a number in [1e-10, 0.1] such as "5 %"; "0.5" is outside)");
  refused(whole("analysis: {duration: 1, tolerance: 1e-12}"),
          R"(4:36: analysis.tolerance: takes a number in [1e-10, 0.1] such as "5 %"; "1e-12" is outside)");
  refused(whole("analysis: {duration: 1, tolerance: 1 mm}"),
          R"(4:36: analysis.tolerance: takes a number such as "5 %"; "1 mm" is a length)");
  refused(whole("analysis: {duration: 1, integrator: newmark}"),
          R"(4:37: analysis.integrator: unknown integrator "newmark". Allowed: generalized_alpha, esdirk4.)");
  refused(whole("analysis: {duration: 1, integrator: generalized_alpha, spectral_radius: 2}"),
          R"(4:73: analysis.spectral_radius: takes a number in [0, 1] such as "5 %"; "2" is outside)");
  refused(
      whole("analysis: {duration: 1, spectral_radius: 0.8}"),
      R"(4:42: analysis.spectral_radius: belongs to generalized_alpha; type integrator: generalized_alpha beside it)");
  refused(whole("analysis: {duration: 1, integrator: esdirk4, spectral_radius: 0.8}"),
          R"(4:63: analysis.spectral_radius: belongs to generalized_alpha; leave it out with integrator: esdirk4)");
  refused(whole("analysis: {duration: 1, output_step: 0}"),
          R"(4:38: analysis.output_step: takes a time in (0, 1] such as "0.5 s"; "0" is outside)");
  refused(whole("analysis: {duration: 1, output_step: 5 s}"),
          R"(4:38: analysis.output_step: takes a time in (0, 1] such as "0.5 s"; "5 s" is outside)");
  refused(whole("analysis: {duration: 1, max_step: 0}"),
          R"(4:35: analysis.max_step: takes a time > 0 such as "0.5 s"; "0" is outside)");
  refused(whole("analysis: {duraton: 1}"), R"(4:12: analysis: unknown key "duraton". Did you mean "duration"?)");
  refused(whole("analysis: 5"),
          "4:11: analysis: takes keys with values such as {duration: 10 s}; a single value was read");
}

TEST(GroundMotionInput, IsOneKindInItsUnits) {
  refused(ground("{}"),
          "1:16: ground_motion: takes one of record, harmonic, sum, pulse, synthetic, displacement; for a still ground "
          "leave "
          R"("ground_motion" out)");
  refused(ground("{harmonc: {amplitude: 3}}"),
          R"(1:17: ground_motion: unknown key "harmonc". Did you mean "harmonic"?)");
  refused(ground("{harmonic: {amplitude: 3}}"),
          R"(1:27: ground_motion.harmonic: key "period" is missing; type "period: 0.5 s")");
  refused(ground("{harmonic: {amplitude: 3 m, period: 0.5, duration: 1}}"),
          R"(1:39: ground_motion.harmonic.amplitude: takes an acceleration such as "0.35 g"; "3 m" is a length)");
  refused(ground("{harmonic: {amplitude: 3, period: 0.5, duration: 1}, pulse: {}}"),
          R"(1:69: ground_motion.pulse: "harmonic" and "pulse" are both given; keep one of them)");
  refused(ground("{synthetic: {seed: 1, duration: 10, soil: firm}}"),
          R"(1:28: ground_motion.synthetic: key "pga" is missing; type "pga: 0.35 g")");
}

TEST(GroundMotionInput, SaysThatARecordIsMissing) {
  refused(ground("{record: nothere.at2}"),
          R"(1:25: ground_motion.record: record "nothere.at2" was not found at nothere.at2)");
}

TEST(GroundMotionInput, SaysWhereARecordIsBroken) {
  const std::string path = testing::TempDir() + "broken_record.csv";
  std::ofstream(path) << "0, 1\n0.1, abc\n0.2, 3\n";
  refused(ground("{record: " + path + "}"),
          "1:25: ground_motion.record: " + path + ":2: \"abc\" is not a finite number");
  std::remove(path.c_str());
}

TEST(ModelInput, IsTakenWhenNothingIsWrong) {
  EXPECT_NO_THROW(test::model_of(whole("title: good\nlinks: []\ncompare: no_pounding\n" + analysis)));
  EXPECT_NO_THROW(
      test::model_of(structure("{shear_building: {storeys: 2, mass: 5 t, stiffness: 1 MN/m, damping: 5 %}}")));
}

TEST(ModelInput, IsReadAgainWithOtherValuesAndAnotherGround) {
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
    ADD_FAILURE() << "a period of -1 s was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("structures.left.oscillator.period: takes a time > 0"), std::string::npos)
        << error.what();
  }
  EXPECT_THROW(input.at("structures").rewrite("1"), InputError);
}

}  // namespace read_model_test
}  // namespace pounding
