// Values far from those of buildings are reported with their likely cause; ordinary values are not.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <pounding/elements.hpp>
#include <pounding/ground/record.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/reports/plausible.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace plausible_test {

using Texts = std::vector<std::string>;

Model model_of(const std::string& structures, const std::string& rest = "") {
  return read_model(Input::read_text("structures:\n" + structures + "analysis: {duration: 1}\n" + rest, "test.yaml"));
}

std::string frame(const std::string& changes = "", const std::string& column = "{rectangle: [0.4 m, 0.4 m]}",
                  const std::string& young = "30 GPa", const std::string& origin = "0 m",
                  const std::string& name = "a") {
  return "  " + name + ": {frame: {origin: [" + origin + "], material: {E: " + young +
         "}, grid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: " + column +
         ", beams: {circle: 0.4 m}, floor_mass: 60 t}" + changes + "}, damping: 5 %}\n";
}

std::string oscillator(const std::string& what) { return "  a: {oscillator: {" + what + "}, damping: 5 %}\n"; }

TEST(Plausible, OrdinaryModelsAreNotDoubted) {
  EXPECT_EQ(implausible(model_of(frame())), Texts{});
  EXPECT_EQ(implausible(model_of(oscillator("mass: 100 t, period: 0.8"))), Texts{});
  EXPECT_EQ(implausible(model_of("  ball: {body: {mass: 1 kg}}\n  w: {wall: {}}\n")), Texts{})
      << "a ball is not a building";
}

TEST(Plausible, PeriodsAndFloorsAreThoseOfBuildings) {
  EXPECT_TRUE(test::mentions(test::only(implausible(model_of(oscillator("mass: 100 t, stiffness: 90")))),
                             {"accept: [period]", "209.4 s", "0.02 s", "20 s", "a"}));
  EXPECT_TRUE(test::mentions(test::only(implausible(model_of(oscillator("mass: 100, period: 0.8")))),
                             {"accept: [mass]", "100 kg", "1 t", "250 t", "a"}));
  EXPECT_EQ(implausible(model_of(oscillator("mass: 100, stiffness: 90 MN/m"))).size(), 2u);
  EXPECT_EQ(implausible(model_of(oscillator("mass: 1 t, period: 0.021"))), Texts{});
  EXPECT_EQ(implausible(model_of(oscillator("mass: 1 t, period: 19.9"))), Texts{});
}

TEST(Plausible, MembersFitTheirFrame) {
  EXPECT_TRUE(test::mentions(implausible(model_of(frame("", "{rectangle: [400, 400]}")))[1],
                             {"accept: [section]", "400 m", "3 m", "400 mm", "1.0", "a"}));
  EXPECT_EQ(implausible(model_of(frame("", "{rectangle: [0.3 m, 3.1 m]}"))).size(), 1u);
  EXPECT_EQ(implausible(model_of(frame("", "{rectangle: [0.3 m, 2.9 m]}"))), Texts{});
  const Texts soft = implausible(model_of(frame("", "{circle: 0.4}", "30000")));
  ASSERT_EQ(soft.size(), 2u) << "the period is also implausible";
  EXPECT_TRUE(test::mentions(soft[1], {"accept: [E]", "30 kPa", "100 MPa", "30 GPa", "1.0", "a"}));
}

// Lambda of the papers is lambda theta_p of the older ones.
TEST(Plausible, EnergyCapacitiesAreNotLambda) {
  const auto storey = [](const std::string& capacity) {
    return oscillator(
        "mass: 100 t, period: 0.8 s, spring: {imk_bilinear: {yield_force: 200 kN, dp: 40 mm, dpc: 0.2 m, "
        "Lambda_K: " +
        capacity + "}}");
  };
  EXPECT_EQ(implausible(model_of(storey("1.5 m"))), Texts{});
  EXPECT_TRUE(test::mentions(test::only(implausible(model_of(storey("50 m")))),
                             {"accept: [Lambda]", "Lambda_K = 50", "lambda dp", "0.04", "Lambda_K: 2 m", "20", "a"}));
  const auto hinges = [](const std::string& capacity) {
    return frame(
        ", hinges: {beams: {at: both, imk_peak_oriented: {yield_moment: 250 kN m, theta_p: 0.025, theta_pc: 0.15, "
        "FmaxFy: 1.08, FresFy: 0.2, Lambda_S: " +
        capacity + "}}}");
  };
  EXPECT_EQ(implausible(model_of(hinges("0.8"))), Texts{});
  EXPECT_TRUE(test::mentions(test::only(implausible(model_of(hinges("100")))),
                             {"accept: [Lambda]", "Lambda_S = 100", "theta_p", "0.025", "Lambda_S: 2.5"}));
}

TEST(Plausible, SupersededLawsNameTheirReplacements) {
  const std::string storey =
      "mass: 100 t, period: 0.8 s, spring: {bilin: {yield_force: 200 kN, dp: 40 mm, dpc: 0.2 m, Lambda_S: 1.5 m}}";
  EXPECT_TRUE(test::mentions(
      test::only(implausible(model_of(oscillator(storey)))),
      {"accept: [superseded]", "structure a", "bilin,", "OpenSees issue 537", "imk_bilinear", "twice Lambda_K"}));
  EXPECT_EQ(implausible(model_of(oscillator(storey) + "accept: [superseded]\n")), Texts{});
  const std::string hinges =
      ", hinges: {beams: {at: both, mod_imk_pinching: {yield_moment: [250 kN m, -200 kN m], theta_p: 0.025, "
      "theta_p_neg: "
      "0.03, theta_pc: 0.15, FmaxFy: 1.08, FprPos: 0.4, A_pinch: 0.6}}}";
  EXPECT_TRUE(test::mentions(test::only(implausible(model_of(frame(hinges)))), {"mod_imk_pinching", "imk_pinching"}))
      << "one line, not one per hinge";
}

TEST(Plausible, PartsYieldAtDeformationsThatCanBeSeen) {
  const auto storey = [](const std::string& force) {
    return oscillator("mass: 100 t, period: 0.8 s, yield_force: " + force + ", hardening: 2 %");
  };
  EXPECT_EQ(implausible(model_of(storey("200 kN"))), Texts{});
  // k = 6.1685 MN/m
  EXPECT_EQ(implausible(model_of(storey("62"))), Texts{});
  EXPECT_TRUE(test::mentions(test::only(implausible(model_of(storey("61")))),
                             {"accept: [yield]", "0.009889 mm", "0.01 mm", "900 kN", "1", "a"}));
  const auto hinges = [](const std::string& moment, const std::string& more = "") {
    return frame(", hinges: {beams: {at: both, yield_moment: " + moment + ", hardening: 2 %" + more + "}}");
  };
  EXPECT_EQ(implausible(model_of(hinges("250 kN m", ", ultimate_rotation: 0.03"))), Texts{});
  const Texts weak = implausible(model_of(hinges("250")));
  ASSERT_EQ(weak.size(), 1u) << "one line, not one per hinge";
  EXPECT_TRUE(test::mentions(weak[0], {"1.0", "N m", "250 kN m", "accept: [yield]"}));
  EXPECT_EQ(implausible(model_of(hinges("250"), "accept: [yield]\n")), Texts{});
  EXPECT_TRUE(test::mentions(test::only(implausible(model_of(hinges("250 kN m", ", ultimate_rotation: 30")))),
                             {"accept: [rotation]", "30 rad", "0.5 rad", "1.0", "0.03", "a"}));
}

TEST(Plausible, GapsAreNarrow) {
  const std::string pair = frame() + frame("", "{circle: 0.4}", "30 GPa", "18.02 m", "b");
  const std::string links = "links: [{between: [a, b], floors: all, law: hertz, stiffness: 2.75e9}]\n";
  const Model model = model_of(pair, links);
  EXPECT_EQ(model.links[0].gap, 12.02) << "the distance in the drawing";
  EXPECT_TRUE(test::mentions(test::only(implausible(model)), {"accept: [gap]", "12.02 m", "2 m", "20 mm", "a.1-b.1"}));
  EXPECT_EQ(implausible(model_of(pair, links + "accept: [gap]\n")), Texts{});
}

// The first warning about a model with one change; it must be the only one unless `count` says otherwise.
void expect_warning(const Model& model, const std::string& name, const test::Facts& facts, std::size_t count = 1) {
  const Texts found = implausible(model);
  ASSERT_EQ(found.size(), count);
  EXPECT_TRUE(test::mentions(found[0], facts));
  EXPECT_NE(found[0].find("accept: [" + name + "]"), std::string::npos) << found[0];
  Model accepted = read_model(Input::read_text(model.source_text, "test.yaml"));
  accepted.accept = {name};
  EXPECT_EQ(implausible(accepted).size(), count - 1) << name;
}

std::string dense_frame(const std::string& floor_mass = "60 t", const std::string& density = "2500",
                        const std::string& factor = "0.7",
                        const std::string& heights = "storey_height: 3 m, bay_width: 6 m") {
  return "  a: {frame: {material: {E: 30 GPa, density: " + density +
         "}, sections: {C: {rectangle: [0.4 m, 0.4 m], stiffness: " + factor + "}}, grid: {storeys: 2, bays: 1, " +
         heights + ", columns: C, beams: C, floor_mass: " + floor_mass + "}}, damping: 5 %}\n";
}

TEST(Plausible, NumbersAsTheyAreTypedAreThoseOfBuildings) {
  EXPECT_EQ(implausible(model_of(dense_frame())), Texts{});
  // The members alone give floors of more than 1 t.
  expect_warning(model_of(dense_frame("90")), "mass", {"structures.a.frame.grid.floor_mass", "1 t", "90 t"});
  expect_warning(model_of(dense_frame("[90, 80]")), "mass",
                 {"[0]", "structures.a.frame.grid.floor_mass", "1 t", "90 t"});
  expect_warning(model_of(dense_frame("60 t", "2.5")), "density",
                 {"structures.a.frame.material.density", "100 kg/m^3", "2.5"});
  expect_warning(model_of(dense_frame("60 t", "25000")), "density",
                 {"structures.a.frame.material.density", "1.5e+04 kg/m^3", "25000"});
  expect_warning(model_of(dense_frame("60 t", "2500", "35")), "stiffness",
                 {"structures.a.frame.sections.C.stiffness", "35", "2"});
  expect_warning(model_of(dense_frame("60 t", "2500", "0.35 %")), "stiffness",
                 {"structures.a.frame.sections.C.stiffness", "0.35 %", "0.02"});
  expect_warning(model_of(dense_frame("60 t", "2500", "0.7", "storey_height: 3 m, bay_width: 6000")), "height",
                 {"structures.a.frame.grid.bay_width", "300 m", "6000"});
  for (const char* left_out : {"0", "0 t"}) EXPECT_EQ(implausible(model_of(dense_frame(left_out))), Texts{});
  EXPECT_EQ(implausible(model_of(dense_frame("60 t", "0"))), Texts{});
}

TEST(Plausible, AFloorMassThatIsTheWholeFloorIsDoubtedOnce) {
  const Texts found = implausible(model_of(dense_frame("90", "0")));
  EXPECT_EQ(std::ranges::count_if(
                found, [](const std::string& text) { return text.find("accept: [mass]") != std::string::npos; }),
            1);
}

TEST(Plausible, DampingRatiosAreThoseOfBuildings) {
  const auto damped = [](const std::string& damping) {
    return model_of("  a: {oscillator: {mass: 100 t, period: 0.8}, damping: " + damping + "}\n");
  };
  for (const char* usual : {"5 %", "0", "0.5 %", "0.1 %", "30 %", "{rayleigh: {ratio: 2 %}}"})
    EXPECT_EQ(implausible(damped(usual)), Texts{}) << usual;
  expect_warning(damped("0.05 %"), "damping", {"structures.a.damping", "0.05 %", "5 %", "0.001"});
  expect_warning(damped("0.5"), "damping", {"structures.a.damping", "5 %", "0.5", "0.4"});
  expect_warning(damped("{modal: {ratio: 0.05 %}}"), "damping",
                 {"structures.a.damping.modal.ratio", "0.05 %", "0.001"});
  expect_warning(model_of("  a: {oscillator: {mass: 100 t, period: 0.8, damping: 0.0005}}\n"), "damping",
                 {"structures.a.oscillator.damping", "0.0005"});
}

TEST(Plausible, IsolatorsBearTheirWeight) {
  const auto isolated = [](const std::string& isolator) {
    return model_of("  a: {shear_building: {storeys: 2, mass: 300 t, stiffness: 500 MN/m, isolator: {" + isolator +
                    "}}, damping: 2 %}\n");
  };
  const std::string rubber =
      "lead_rubber: {strength: 300 kN, yield_displacement: 10 mm, post_yield_stiffness: 8.5 MN/m}";
  EXPECT_EQ(implausible(isolated(rubber + ", capacity: 350 mm")), Texts{});
  EXPECT_EQ(implausible(isolated("friction_pendulum: {radius: 2 m, friction: 6 %}")), Texts{});
  expect_warning(isolated(rubber + ", capacity: 350"), "isolator",
                 {"structures.a.shear_building.isolator.capacity", "3 m", "350"});
  expect_warning(isolated(rubber + ", capacity: 0.35 mm"), "isolator",
                 {"structures.a.shear_building.isolator.capacity", "0.35 mm", "10 mm"});
  expect_warning(isolated("lead_rubber: {strength: 300, yield_displacement: 10 mm, post_yield_stiffness: 8.5 MN/m}"),
                 "isolator", {"300 N", "0.0051 %", "5.884 MN", "2 %", "15 %", "a"});
  expect_warning(isolated("lead_rubber: {strength: 300 MN, yield_displacement: 10 mm, post_yield_stiffness: 8.5 MN/m}"),
                 "isolator", {"a"});
  expect_warning(isolated("friction_pendulum: {radius: 2000, friction: 6 %}"), "isolator",
                 {"structures.a.shear_building.isolator.friction_pendulum.radius", "2000"});
}

TEST(Plausible, HeightsGapsAndStartsAreThoseOfBuildings) {
  const auto building = [](const std::string& more, const std::string& rest = "") {
    return model_of("  a: {shear_building: {storeys: 2, mass: 100 t, stiffness: 100 MN/m" + more +
                        "}, damping: 5 %}\n  w: {wall: {}}\n",
                    rest);
  };
  EXPECT_EQ(implausible(building(", height: 3.2 m")), Texts{});
  expect_warning(building(", height: 3200"), "height", {"structures.a.shear_building.height", "50 m", "3200"});
  expect_warning(building(", height: 3.2 mm"), "height", {"structures.a.shear_building.height", "3.2 mm", "300 mm"});
  expect_warning(building(", initial_displacement: 20"), "initial", {"20 m", "2 m", "a"});
  expect_warning(building(", initial_velocity: 300"), "initial", {"300 m/s", "10 m/s", "a"});
  EXPECT_EQ(implausible(model_of("  ball: {body: {mass: 1 kg}, initial_velocity: 30 m/s}\n  w: {wall: {}}\n")), Texts{})
      << "a high velocity of a body is plausible";
  const auto gap = [&](const std::string& width) {
    return building("", "links: [{between: [a.2, w], gap: " + width + ", law: hertz, stiffness: 2.75e9}]\n");
  };
  EXPECT_EQ(implausible(gap("0")), Texts{});
  EXPECT_EQ(implausible(gap("0.1 mm")), Texts{});
  expect_warning(gap("0.02 mm"), "gap", {"0.02 mm", "0.05 mm", "a.2-w"});
  expect_warning(gap("20"), "gap", {"20 m", "2 m", "a.2-w"});
}

TEST(Plausible, GroundMotionsAreThoseOfEarthquakes) {
  const auto shaken = [](const std::string& motion) {
    return model_of(oscillator("mass: 100 t, period: 0.8"), "ground_motion: " + motion + "\n");
  };
  EXPECT_EQ(implausible(shaken("{harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}")), Texts{});
  expect_warning(shaken("{harmonic: {amplitude: 300, period: 0.6, duration: 3.0}}"), "scale", {"30.59 g", "10 g"});
  expect_warning(shaken("{pulse: {shape: sine, amplitude: 0.3, duration: 0.5}}"), "pga",
                 {"ground_motion.pulse.amplitude", "0.0306 g", "0.3 g", "m/s^2"});
  expect_warning(shaken("{displacement: {harmonic: {amplitude: 20, period: 0.5 s, duration: 10 s}}}"), "amplitude",
                 {"ground_motion.displacement.harmonic.amplitude", "5 m", "20"}, 2);
}

TEST(Plausible, DriftsOfMoreThanATenthOfTheStoreyAreDoubted) {
  Model model = model_of(
      "  a: {shear_building: {storeys: 2, mass: 100 t, stiffness: 100 MN/m, height: 3 m}, damping: 5 %}\n"
      "  b: {shear_building: {storeys: 1, mass: 100 t, stiffness: 100 MN/m}, damping: 5 %}\n");
  const std::vector<std::vector<double>> small{{0.29, 0.3}, {9}}, large{{0.31, 0.45}, {9}};
  EXPECT_EQ(implausible_drifts(model, small), Texts{}) << "b has no heights";
  EXPECT_TRUE(
      test::mentions(test::only(implausible_drifts(model, large)),
                     {"analysis: {collapse_drift: 10 %}", "accept: [drift]", "450 mm", "15 %", "3 m", "2", "a"}));
  model.accept = {"drift"};
  EXPECT_EQ(implausible_drifts(model, large), Texts{});
}

TEST(Plausible, ABarePeakAccelerationIsDoubted) {
  const auto with_motion = [](const std::string& motion) {
    return implausible(model_of(oscillator("mass: 100 t, period: 0.8"), "ground_motion: " + motion + "\n"));
  };
  EXPECT_TRUE(test::mentions(test::only(with_motion("{synthetic: {seed: 1, duration: 1 s, pga: 0.35}}")),
                             {"accept: [pga]", "ground_motion.synthetic.pga", "0.0357 g", "0.35 g", "m/s^2"}));
  EXPECT_EQ(with_motion("{components: {x: {synthetic: {seed: 1, duration: 1 s, pga: 0.35}}}}").size(), 1u);
  for (const char* pga : {"0.35 g", "0.35 m/s^2", "3.5"})
    EXPECT_EQ(with_motion(std::string("{synthetic: {seed: 1, duration: 1 s, pga: ") + pga + "}}"), Texts{}) << pga;
}

TEST(Plausible, TolerancesAndPenetrationsAreSmall) {
  Model model = model_of(oscillator("mass: 100 t, period: 0.8") + "  w: {wall: {}}\n",
                         "links: [{between: [a, w], gap: 20 mm, law: hertz, stiffness: 2.75e9}]\n");
  const double deep[] = {0.0621}, shallow[] = {0.05};
  EXPECT_TRUE(
      test::mentions(test::only(implausible(model, true, deep)), {"accept: [penetration]", "62.1 mm", "50 mm", "a-w"}));
  EXPECT_EQ(implausible(model, true, shallow), Texts{});
  EXPECT_EQ(implausible(model, true, {}), Texts{});
  EXPECT_TRUE(test::mentions(test::only(implausible(model, false, {})),
                             {"accept: [motion]", "ground_motion", "initial_displacement", "initial_velocity"}));
  model.accept = {"penetration", "motion"};
  EXPECT_EQ(implausible(model, true, deep), Texts{});
  EXPECT_EQ(implausible(model, false, {}), Texts{});
  model.analysis.tolerance = 0.05;
  EXPECT_TRUE(test::mentions(test::only(implausible(model)), {"accept: [tolerance]", "5 %", "0.05", "1e-4"}));
}

// The intensity of 2 s at +-1 m/s^2 is uniform, so a cut at t removes the fraction 1 - t / 2.
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

Texts warnings_of(Model model) {
  model.complete();
  return implausible(model);
}

TEST(Plausible, RecordsAreNotCutByTheDuration) {
  const GroundMotion record(even_record());
  EXPECT_NEAR(arias_fraction_after(*record.samples(), 0.5), 0.75, 0.01);
  EXPECT_EQ(arias_fraction_after(*record.samples(), -1), 1);
  EXPECT_EQ(arias_fraction_after(*record.samples(), 2), 0);
  EXPECT_EQ(warnings_of(shaken({record}, 2)), Texts{});
  EXPECT_EQ(warnings_of(shaken({record}, 1.92)), Texts{}) << "4 % are lost";
  const Texts cut = warnings_of(shaken({record}, 1));
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_TRUE(test::mentions(cut[0], {"accept: [duration]", "1 s", "5 %", "50 %", "1.9 s"}));
  Model accepted = shaken({record}, 1);
  accepted.accept = {"duration"};
  EXPECT_EQ(warnings_of(std::move(accepted)), Texts{});
  EXPECT_EQ(warnings_of(shaken({record}, 0)), Texts{}) << "without `duration` the run lasts as long as the record";
}

TEST(Plausible, RecordsCutByTheDurationAreCounted) {
  Model model = shaken({GroundMotion(even_record())}, 1.5);
  model.add("b", make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}),
            {.ground_motion = GroundComponents{GroundMotion(even_record(4))}});
  model.add("c", make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}),
            {.forces = {{.history = GroundMotion(even_record(1))}}});
  const Texts cut = warnings_of(std::move(model));
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_TRUE(test::mentions(cut[0], {"5 %", "62 %", "2", "3"}));
}

TEST(Plausible, ARecordIsCutWhereItArrivesLast) {
  Model model = shaken({GroundMotion(even_record())}, 2);
  model.add("late", make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}), {.delay = 0.5});
  const Texts cut = warnings_of(std::move(model));
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_TRUE(test::mentions(cut[0], {"5 %", "25 %", "2.4 s"}));
}

TEST(Plausible, MotionsInClosedFormAreAsLongAsTheFileSays) {
  EXPECT_EQ(warnings_of(shaken({GroundMotion(Harmonic{.amplitude = 1, .period = 0.5, .duration = 9})}, 1)), Texts{});
}

TEST(Plausible, ByCodeUnknownNamesAreRefused) {
  Model model;
  model.add("a", make_oscillator({.mass = 1e5, .period = 0.5, .damping_ratio = 0.05}));
  model.analysis.duration = 1;
  model.accept = {"gpa"};
  EXPECT_TRUE(test::mentions(test::refusal([&] { model.complete(); }), {"gpa", "gap"}));
  model.accept = {"gap"};
  model.complete();
}

TEST(Describe, HasALineAStructure) {
  const std::string text = describe(model_of(
      frame() +
      "  w: {wall: {}}\n  ball: {body: {mass: 3 t}}\n  o: {oscillator: {mass: 100 t, period: 0.8}, damping: 5 %}\n"));
  EXPECT_TRUE(test::mentions(text, {"120 t", "2", "a"}));
  EXPECT_NE(text.find("structure w: wall\n"), std::string::npos) << text;
  EXPECT_NE(text.find("structure ball: body, 3 t\n"), std::string::npos) << text;
  EXPECT_TRUE(test::mentions(text, {"100 t", "0.8 s", "o"}));
}

}  // namespace plausible_test
}  // namespace pounding
