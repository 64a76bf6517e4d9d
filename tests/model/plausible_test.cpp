// Numbers far from those of buildings are told with their likely cause, and what a model accepts is not.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include <pounding/elements.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/model/plausible.hpp>
#include "support/refusal.hpp"

namespace pounding {
namespace plausible_test {

using Texts = std::vector<std::string>;

Model model_of(const std::string& structures, const std::string& rest = "") {
  return read_model(Input::read_text("structures:\n" + structures + "analysis: {duration: 1}\n" + rest, "test.yaml"));
}

std::string frame(const std::string& changes = "", const std::string& column = "{rectangle: [0.4 m, 0.4 m]}", const std::string& young = "30 GPa",
                  const std::string& origin = "0 m", const std::string& name = "a") {
  return "  " + name + ": {frame: {origin: [" + origin + "], material: {E: " + young + "}, grid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: " +
         column + ", beams: {circle: 0.4 m}, floor_mass: 60 t}" + changes + "}, damping: 5 %}\n";
}

std::string oscillator(const std::string& what) { return "  a: {oscillator: {" + what + "}, damping: 5 %}\n"; }

TEST(Plausible, OrdinaryModelsAreNotDoubted) {
  EXPECT_EQ(implausible(model_of(frame())), Texts{});
  EXPECT_EQ(implausible(model_of(oscillator("mass: 100 t, period: 0.8"))), Texts{});
  EXPECT_EQ(implausible(model_of("  ball: {body: {mass: 1 kg}}\n  w: {wall: {}}\n")), Texts{}) << "a ball is no building";
}

TEST(Plausible, PeriodsAndFloorsAreThoseOfBuildings) {
  EXPECT_EQ(implausible(model_of(oscillator("mass: 100 t, stiffness: 90"))),
            Texts{"structure a: the first period is 209.4 s, and those of structures lie from 0.02 s to 20 s; are masses and stiffnesses in kg and N/m, or with "
                  "their units? (where it is meant: accept: [period])"});
  EXPECT_EQ(implausible(model_of(oscillator("mass: 100, period: 0.8"))),
            Texts{"structure a: floor 1 has 100 kg, under 1 t; a bare mass is in kg, type its unit, as in 250 t (where it is meant: accept: [mass])"});
  EXPECT_EQ(implausible(model_of(oscillator("mass: 100, stiffness: 90 MN/m"))).size(), 2u);
  EXPECT_EQ(implausible(model_of(oscillator("mass: 1 t, period: 0.021"))), Texts{});
  EXPECT_EQ(implausible(model_of(oscillator("mass: 1 t, period: 19.9"))), Texts{});
}

TEST(Plausible, MembersFitTheirFrame) {
  EXPECT_EQ(implausible(model_of(frame("", "{rectangle: [400, 400]}")))[1],
            "structure a: member column 1.0 is some 400 m deep, more than a storey of 3 m; a bare length is in m, type its unit, as in 400 mm (where it is "
            "meant: accept: [section])");
  EXPECT_EQ(implausible(model_of(frame("", "{rectangle: [0.3 m, 3.1 m]}"))).size(), 1u);
  EXPECT_EQ(implausible(model_of(frame("", "{rectangle: [0.3 m, 2.9 m]}"))), Texts{});
  const Texts soft = implausible(model_of(frame("", "{circle: 0.4}", "30000")));
  ASSERT_EQ(soft.size(), 2u) << "the period is doubted too";
  EXPECT_EQ(soft[1], "structure a: member column 1.0 has E = 30 kPa, under 1 MPa; a bare E is in Pa, type its unit, as in 30 GPa (where it is meant: accept: [E])");
}

TEST(Plausible, PartsYieldAtDeformationsThatCanBeSeen) {
  const auto storey = [](const std::string& force) { return oscillator("mass: 100 t, period: 0.8 s, yield_force: " + force + ", hardening: 2 %"); };
  EXPECT_EQ(implausible(model_of(storey("200 kN"))), Texts{});
  // k = 6.1685 MN/m
  EXPECT_EQ(implausible(model_of(storey("62"))), Texts{});
  EXPECT_EQ(implausible(model_of(storey("61"))),
            Texts{"structure a: storey 1 yields at 0.009889 mm, under 0.01 mm; a bare force is in N, type its unit, as in 900 kN (where it is meant: "
                  "accept: [yield])"});
  const auto hinges = [](const std::string& moment, const std::string& more = "") {
    return frame(", hinges: {beams: {at: both, yield_moment: " + moment + ", hardening: 2 %" + more + "}}");
  };
  EXPECT_EQ(implausible(model_of(hinges("250 kN m", ", ultimate_rotation: 0.03"))), Texts{});
  const Texts weak = implausible(model_of(hinges("250")));
  ASSERT_EQ(weak.size(), 1u) << "one line, and not one a hinge";
  EXPECT_TRUE(weak[0].starts_with("structure a: beam x 1.0 start yields at ")) << weak[0];
  EXPECT_TRUE(weak[0].ends_with("a bare moment is in N m, type its unit, as in 250 kN m (where it is meant: accept: [yield])")) << weak[0];
  EXPECT_EQ(implausible(model_of(hinges("250"), "accept: [yield]\n")), Texts{});
  EXPECT_EQ(implausible(model_of(hinges("250 kN m", ", ultimate_rotation: 30"))),
            Texts{"structure a: beam x 1.0 start has an ultimate rotation of 30 rad, above 0.5 rad; a bare rotation is in rad, as in 0.03 (where it is meant: "
                  "accept: [rotation])"});
}

TEST(Plausible, GapsAreNarrow) {
  const std::string pair = frame() + frame("", "{circle: 0.4}", "30 GPa", "18.02 m", "b");
  const std::string links = "links: [{between: [a, b], floors: all, law: hertz, stiffness: 2.75e9}]\n";
  const Model model = model_of(pair, links);
  EXPECT_EQ(model.links[0].gap, 12.02) << "the distance drawn";
  EXPECT_EQ(implausible(model), Texts{"link a.1-b.1: the gap is 12.02 m, above 2 m; a bare length is in m, type its unit, as in 20 mm, and look at the origins "
                                      "(where it is meant: accept: [gap])"});
  EXPECT_EQ(implausible(model_of(pair, links + "accept: [gap]\n")), Texts{});
}

TEST(Plausible, ABarePeakAccelerationIsDoubted) {
  const auto with_motion = [](const std::string& motion) {
    return implausible(model_of(oscillator("mass: 100 t, period: 0.8"), "ground_motion: " + motion + "\n"));
  };
  EXPECT_EQ(with_motion("{synthetic: {seed: 1, duration: 1 s, pga: 0.35}}"),
            Texts{"ground_motion.synthetic.pga: a bare 0.35 is in m/s^2, 0.0357 g; did you mean 0.35 g? Type its unit (where it is meant: accept: [pga])"});
  EXPECT_EQ(with_motion("{components: {x: {synthetic: {seed: 1, duration: 1 s, pga: 0.35}}}}").size(), 1u);
  for (const char* pga : {"0.35 g", "0.35 m/s^2", "3.5"})
    EXPECT_EQ(with_motion(std::string("{synthetic: {seed: 1, duration: 1 s, pga: ") + pga + "}}"), Texts{}) << pga;
}

TEST(Plausible, TolerancesAndPenetrationsAreSmall) {
  Model model = model_of(oscillator("mass: 100 t, period: 0.8") + "  w: {wall: {}}\n", "links: [{between: [a, w], gap: 20 mm, law: hertz, stiffness: 2.75e9}]\n");
  const double deep[] = {0.0621}, shallow[] = {0.05};
  EXPECT_EQ(implausible(model, true, deep), Texts{"link a-w: the bodies overlap by 62.1 mm, more than 50 mm; the contact is too soft, look at the unit of its stiffness "
                                            "(where it is meant: accept: [penetration])"});
  EXPECT_EQ(implausible(model, true, shallow), Texts{});
  EXPECT_EQ(implausible(model, true, {}), Texts{});
  EXPECT_EQ(implausible(model, false, {}), Texts{"nothing moved: the model has no ground motion, no forces and no initial motion; type one of ground_motion:, forces:, "
                                                 "initial_displacement: and initial_velocity: (where it is meant: accept: [motion])"});
  model.accept = {"penetration", "motion"};
  EXPECT_EQ(implausible(model, true, deep), Texts{});
  EXPECT_EQ(implausible(model, false, {}), Texts{});
  model.analysis.tolerance = 0.05;
  EXPECT_EQ(implausible(model), Texts{"analysis: a tolerance of 0.05 allows errors of 5 % in displacements and forces; 1e-4 is usual (where it is meant: "
                                      "accept: [tolerance])"});
}

// The intensity of 2 s at +-1 m/s^2 is even, so a cut at t takes 1 - t / 2 of it.
Samples even_record(double end = 2) {
  Samples samples;
  for (int i = 0; i <= 400; ++i) {
    samples.times.push_back(i * end / 400);
    samples.accelerations.push_back(i % 100 < 50 ? 1 : -1);
  }
  return samples;
}

Model shaken(const GroundComponents& components, double duration) {
  Model model;
  model.add("a", make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}));
  model.ground = components;
  model.analysis.duration = duration;
  return model;
}

Texts doubts_of(Model model) {
  model.complete();
  return implausible(model);
}

TEST(Plausible, RecordsAreNotCutByTheDuration) {
  const GroundMotion record(even_record());
  EXPECT_NEAR(arias_fraction_after(*record.samples(), 0.5), 0.75, 0.01);
  EXPECT_EQ(arias_fraction_after(*record.samples(), -1), 1);
  EXPECT_EQ(arias_fraction_after(*record.samples(), 2), 0);
  EXPECT_EQ(doubts_of(shaken({record}, 2)), Texts{});
  EXPECT_EQ(doubts_of(shaken({record}, 1.92)), Texts{}) << "4 % are lost";
  const Texts cut = doubts_of(shaken({record}, 1));
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_EQ(cut[0], "analysis: the duration of 1 s cuts 1 of 1 record, by more than 5 % of the Arias intensity and up to 50 %; type a duration of at least 1.9 s, "
                    "or leave it out (where it is meant: accept: [duration])");
  Model accepted = shaken({record}, 1);
  accepted.accept = {"duration"};
  EXPECT_EQ(doubts_of(std::move(accepted)), Texts{});
  EXPECT_EQ(doubts_of(shaken({record}, 0)), Texts{}) << "without a duration the run lasts as long as the record";
}

TEST(Plausible, RecordsCutByTheDurationAreCounted) {
  Model model = shaken({GroundMotion(even_record())}, 1.5);
  model.add("b", make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}), {.ground_motion = GroundComponents{GroundMotion(even_record(4))}});
  model.add("c", make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}), {.forces = {{.history = GroundMotion(even_record(1))}}});
  const Texts cut = doubts_of(std::move(model));
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_NE(cut[0].find("cuts 2 of 3 records, by more than 5 % of the Arias intensity and up to 62 %"), std::string::npos) << cut[0];
}

TEST(Plausible, ARecordIsCutWhereItArrivesLast) {
  Model model = shaken({GroundMotion(even_record())}, 2);
  model.add("late", make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}), {.delay = 0.5});
  const Texts cut = doubts_of(std::move(model));
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_NE(cut[0].find("cuts 1 of 1 record, by more than 5 % of the Arias intensity and up to 25 %; type a duration of at least 2.4 s"), std::string::npos) << cut[0];
}

TEST(Plausible, MotionsInClosedFormAreAsLongAsTheFileSays) {
  EXPECT_EQ(doubts_of(shaken({GroundMotion(Harmonic{.amplitude = 1, .period = 0.5, .duration = 9})}, 1)), Texts{});
}

TEST(Plausible, ByCodeUnknownNamesAreRefused) {
  Model model;
  model.add("a", make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}));
  model.analysis.duration = 1;
  model.accept = {"gpa"};
  EXPECT_EQ(test::refusal([&] { model.complete(); }), "unknown warning \"gpa\". Did you mean \"gap\"?");
  model.accept = {"gap"};
  model.complete();
}

TEST(Describe, HasALineAStructure) {
  const std::string text = describe(model_of(frame() + "  w: {wall: {}}\n  ball: {body: {mass: 3 t}}\n  o: {oscillator: {mass: 100 t, period: 0.8}, damping: 5 %}\n"));
  EXPECT_NE(text.find("structure a: frame, 2 floors, 120 t, first periods "), std::string::npos) << text;
  EXPECT_NE(text.find("structure w: wall\n"), std::string::npos) << text;
  EXPECT_NE(text.find("structure ball: body, 3 t\n"), std::string::npos) << text;
  EXPECT_NE(text.find("structure o: oscillator, 1 floor, 100 t, period 0.8 s\n"), std::string::npos) << text;
}

}  // namespace plausible_test
}  // namespace pounding
