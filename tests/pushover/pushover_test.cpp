// Pushover of complete buildings: loads on floors, measures of the curve, messages.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/input/pushover_input.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/pushover/pushover.hpp>
#include <pounding/structures/oscillators.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace pushover_test {

Structure building(double hardening, bool with_heights = true) {
  ShearBuildingOptions options{.storeys = 3,
                               .mass = std::vector<double>{100e3, 200e3, 150e3},
                               .stiffness = 100e6,
                               .yield_force = std::vector<double>{2e6, 1.9e6, 1e6},
                               .hardening = hardening};
  if (with_heights) options.height = std::vector<double>{4.0, 3.0, 3.0};
  return make_shear_building(options);
}

std::vector<double> shares(std::vector<double> forces) {
  double sum = 0;
  for (const double force : forces) sum += force;
  for (double& force : forces) force /= sum;
  return forces;
}

void expect_loads(const Pushover& found, const std::vector<double>& forces) {
  const std::vector<double> expected = shares(forces);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found.loads[i], expected[i], 1e-14);
}

TEST(Pushover, SharesTheLoadOutWithMassesAndHeights) {
  expect_loads(pushover(building(0.1), {.targets = {0.2}}), {100 * 4, 200 * 7, 150 * 10});
  expect_loads(pushover(building(0.1, false), {.targets = {0.2}}), {100 * 1, 200 * 2, 150 * 3});
  expect_loads(pushover(building(0.1), {.pattern = LoadPattern::uniform, .targets = {0.2}}), {100, 200, 150});
  expect_loads(pushover(building(0.1), {.pattern = LoadPattern::given, .forces = {1, 0, 3}, .targets = {0.2}}),
               {1, 0, 3});
}

TEST(Pushover, TakesTheFirstModeOfTwoEqualStoreys) {
  // 2 k at the ground, k above: modes of [3 -1; -1 1], shape 1 : 1 + sqrt 2.
  const Structure s = make_shear_building(
      {.storeys = 2, .mass = 1e5, .stiffness = std::vector<double>{200e6, 100e6}, .yield_force = 1e6});
  expect_loads(pushover(s, {.pattern = LoadPattern::mode1, .targets = {0.2}}), {1, 1 + std::sqrt(2)});
}

// A storey has two yield forces, one per direction; its ductility is the drift over the yield drift of its direction.
TEST(Pushover, CountsDuctilityByTheDirection) {
  const auto read = [](const std::string& target) {
    const Model model = test::model_of(
        "structures:\n  a: {shear_building: {storeys: 1, mass: 100 t, stiffness: 10 MN/m, height: 3, spring: "
        "{bilinear: {"
        "yield_force: 400 kN, negative_yield_force: 100 kN, hardening: 0.1}}}, damping: 0}\nanalysis: {duration: 1}\n");
    return pushover(model.structures[0], {.targets = {std::stod(target)}}).ductility(0);
  };
  EXPECT_NEAR(read("0.12"), 3, 1e-9);
  EXPECT_NEAR(read("-0.12"), 12, 1e-9);
  EXPECT_NEAR(read("0.05"), 1.25, 1e-9);
}

// A cantilever of length L with a tip load: the plastic rotation at the foot does not depend on the number of parts of
// the column.
TEST(Pushover, CountsDuctilityOfACutMemberAsOfTheWhole) {
  const auto ductility = [](int parts, double hardening) {
    const Model model = test::model_of(
        fmt::format("structures:\n  a: {{frame: {{material: {{E: 30 GPa}}, grid: {{storeys: 1, bays: 1, storey_height: "
                    "4, bay_width: 6, columns: {{rectangle: [0.5, 0.5]}}, "
                    "beams: {{rectangle: [0.3, 0.6]}}, floor_mass: 60 t}}, members: {{column 1.0: {{parts: {}}}}}, "
                    "hinges: {{columns: {{at: feet, yield_moment: 200 kN m, hardening: {}}}}}}}, damping: 0}}\n"
                    "analysis: {{duration: 1}}\n",
                    parts, hardening));
    const Pushover found = pushover(model.structures[0], {.targets = {0.2}});
    for (int part = 0; part < static_cast<int>(found.parts.size()); ++part)
      if (found.parts[part].name.starts_with("column 1.0")) return found.ductility(part);
    return 0.0;
  };
  for (const double hardening : {0.0, 0.05}) {
    const double whole = ductility(1, hardening);
    EXPECT_GT(whole, 5);
    for (const int parts : {2, 5})
      EXPECT_NEAR(ductility(parts, hardening), whole, 1e-6 * whole) << parts << " parts, hardening " << hardening;
  }
}

TEST(Pushover, MakesTwoLinesOfTheSameAreaAndAnOscillator) {
  const Pushover found = pushover(building(0), {.targets = {0.3}});
  ASSERT_TRUE(found.bilinear && found.equivalent);
  // All but the first storey stay elastic: the curve beyond V = 2 MN is a horizontal line.
  EXPECT_NEAR(found.bilinear->base_shear, 2e6, 1e-5);
  EXPECT_NEAR(found.bilinear->yield_displacement, found.path.points[*found.first_yield()].displacement, 1e-14);
  EXPECT_EQ(found.bilinear->displacement, 0.3);
  // phi = z/10: m* = 100 0.4 + 200 0.7 + 150, Gamma = m*/(100 0.16 + 200 0.49 + 150).
  test::Book book("oscillator of a pushover", "EN 1998-1, annex B, by hand", "rounding");
  book.near("mass [t]", found.equivalent->mass / 1e3, 330, 1e-9);
  book.near("participation [-]", found.equivalent->participation, 330.0 / 264, 1e-13);
  book.near("period [s]", found.equivalent->period,
            2 * M_PI * std::sqrt(330e3 * found.bilinear->yield_displacement / 2e6), 1e-12);
  EXPECT_EQ(found.overstrength(found.strongest()), 1);
}

TEST(Pushover, HasTwoLinesThatEndBeforeTheLoadFalls) {
  const BilinearCurve curve = bilinear_curve({0, 1, 2, 4}, {0, 2, 3, 1});
  EXPECT_EQ(curve.base_shear, 3);
  EXPECT_EQ(curve.displacement, 2);
  EXPECT_NEAR(curve.yield_displacement, 2 * (2 - 3.5 / 3), 1e-15);
}

TEST(Pushover, IsMirroredBelowZero) {
  const Pushover right = pushover(building(0.1), {.targets = {0.2}}),
                 left = pushover(building(0.1), {.targets = {-0.2}});
  EXPECT_NEAR(left.path.points.back().factor, -right.path.points.back().factor, 1e-6);
  EXPECT_NEAR(left.bilinear->yield_displacement, right.bilinear->yield_displacement, 1e-15);
  EXPECT_NEAR(left.bilinear->base_shear, right.bilinear->base_shear, 1e-6);
}

TEST(Pushover, FollowsTheFloors) {
  const Pushover found = pushover(building(0.1), {.targets = {0.2}});
  const auto last = found.floor_displacements.rows() - 1;
  EXPECT_NEAR(found.floor_displacements(last, 2), 0.2, 1e-15);
  for (int storey = 0; storey < 3; ++storey) {
    const double below = storey == 0 ? 0 : found.floor_displacements(last, storey - 1);
    EXPECT_NEAR(found.floor_displacements(last, storey) - below, found.path.points.back().deformations[storey], 1e-15);
    EXPECT_NEAR(found.plastic_deformation(storey) * found.parts[storey].stiffness,
                found.parts[storey].stiffness * found.path.points.back().deformations[storey] -
                    found.force(static_cast<int>(last), storey),
                1e-6);
  }
}

class PushoverWithDevices : public testing::Test {
 protected:
  // Two storeys of 100 MN/m with these keys of the first one and its devices.
  static Pushover pushed(const std::string& storeys, const std::string& devices, const std::string& cyclic = "") {
    const Model model = read_model(Input::read_text(
        "structures:\n  a: {shear_building: {storeys: 2, mass: 100 t, height: 3 m, " + storeys + devices +
            "}, damping: 5 %}\nground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\n"
            "analysis: {duration: 1}\n",
        "towers.yaml"));
    PushoverInput words{.structure = "a", .to = "100 mm"};
    words.cyclic = cyclic;
    return pushover(model, words);
  }
  static void expect_same_curve(const Pushover& found, const Pushover& expected) {
    ASSERT_EQ(found.path.points.size(), expected.path.points.size());
    for (std::size_t i = 0; i < expected.path.points.size(); ++i) {
      EXPECT_NEAR(found.path.points[i].displacement, expected.path.points[i].displacement, 1e-12) << i;
      EXPECT_NEAR(found.path.points[i].factor, expected.path.points[i].factor, 1e-6) << i;
    }
  }
};

// A storey of 100 MN/m with a brace of 50 MN/m that yields at 500 kN and 10 mm is a storey of 150 MN/m that yields at
// the same displacement and continues with 101 MN/m.
TEST_F(PushoverWithDevices, ABraceIsASpringBesideItsStorey) {
  const std::string brace =
      ", devices: {brace: {storey: 1, bilinear: {stiffness: 50 MN/m, yield_force: 500 kN, hardening: 2 %}}}";
  for (const std::string cyclic : {"", "40 mm, -60 mm"}) {
    const Pushover found = pushed("stiffness: 100 MN/m, yield_force: [1 GN, 1.2 MN], hardening: 10 %", brace, cyclic);
    const Pushover expected =
        pushed("stiffness: [150 MN/m, 100 MN/m], yield_force: [1.5 MN, 1.2 MN], hardening: [0.6733333333333333, 0.1]",
               "", cyclic);
    expect_same_curve(found, expected);
    ASSERT_EQ(found.parts.back().name, "brace");
    EXPECT_NEAR(found.ductility(2), expected.ductility(0), 1e-9);
    EXPECT_NEAR(found.parts.back().stiffness, 50e6, 1e-6);
    const int last = static_cast<int>(found.path.points.size()) - 1;
    EXPECT_NEAR(found.force(last, 0) + found.force(last, 2), expected.force(last, 0), 1e-5);
    EXPECT_NEAR(found.plastic_deformation(2), found.path.points.back().deformations[2] - found.force(last, 2) / 50e6,
                1e-12);
  }
}

TEST_F(PushoverWithDevices, ABarIsStiffnessAndADamperIsNothing) {
  const std::string storeys = "yield_force: [2 MN, 1.2 MN], hardening: 10 %, stiffness: ";
  const Pushover bare = pushed(storeys + "100 MN/m", "");
  for (const char* damper : {"coefficient: 200e3", "coefficient: 200e3, exponent: 0.35",
                             "coefficient: 200e3, exponent: 0.35, stiffness: 40 MN/m"})
    for (const std::string cyclic : {"", "40 mm, -60 mm"})
      expect_same_curve(
          pushed(storeys + "100 MN/m", std::string(", devices: {d: {storey: 1, damper: {") + damper + "}}}", cyclic),
          pushed(storeys + "100 MN/m", "", cyclic));
  // A bar in parallel with the storey, which still yields at 20 mm, adds 30 MN/m before and after yield.
  const Pushover found = pushed(storeys + "100 MN/m", ", devices: {bar: {storey: 1, bar: {stiffness: 30 MN/m}}}");
  expect_same_curve(
      found,
      pushed("yield_force: [2.6 MN, 1.2 MN], stiffness: [130 MN/m, 100 MN/m], hardening: [0.3076923076923077, 0.1]",
             ""));
  EXPECT_EQ(found.plastic_deformation(2), 0);
  EXPECT_NEAR(found.force(static_cast<int>(found.path.points.size()) - 1, 2),
              30e6 * found.path.points.back().deformations[2], 1e-6);
}

TEST(Pushover, IsOneObjectOfJson) {
  const Pushover found = pushover(building(0), {.targets = {0.3}});
  const auto all = nlohmann::json::parse(pushover_json(found));
  EXPECT_EQ(all["status"], "done");
  EXPECT_EQ(all["points"]["displacement"].size(), found.path.points.size());
  EXPECT_EQ(all["points"]["force"][1].size(), 3u);
  EXPECT_EQ(all["events"][0]["parts"][0], "storey 1");
  EXPECT_EQ(all["mechanism"]["point"], 1);
  EXPECT_FALSE(nlohmann::json::parse(pushover_json(found, false)).contains("points"));
}

TEST(Pushover, RefusesWhatCannotBePushed) {
  const auto text = [](const Structure& s, const PushoverOptions& options) {
    return test::refusal([&] { pushover(s, options); });
  };
  EXPECT_TRUE(test::mentions(text(building(0.1), {}), {"roof"}));
  EXPECT_TRUE(test::mentions(text(building(0.1), {.targets = {0.0}}), {"250 mm"}));
  EXPECT_TRUE(test::mentions(text(building(0.1), {.pattern = LoadPattern::given, .forces = {1, 2}, .targets = {0.2}}),
                             {"2", "3"}));
  EXPECT_TRUE(test::mentions(
      text(building(0.1), {.pattern = LoadPattern::given, .forces = {1, 0, -1}, .targets = {0.2}}), {"shear"}));
  EXPECT_NE(text(building(0.1), {.direction = 1, .targets = {0.2}}), "taken");
  const Structure elastic = make_shear_building({.storeys = 1, .mass = 1e5, .stiffness = 1e7});
  EXPECT_TRUE(test::mentions(text(elastic, {.targets = {0.2}}), {"yield_force", "shear_building"}));
  const Structure one = make_oscillator({.mass = 1e5, .stiffness = 1e7, .damping_ratio = 0.0, .yield_force = 1e5});
  EXPECT_TRUE(test::mentions(text(one, {.targets = {0.004}}), {"10 mm", "11 mm"}));
}

TEST(Pushover, RefusesIsolatorsThatCoupleTwoDirections) {
  const auto text = [](const std::string& coupled) {
    const Model model = read_model(Input::read_text(
        "ground_motion: {harmonic: {amplitude: 1, period: 1, duration: 1}}\nanalysis: {duration: 1}\nstructures:\n  a: "
        "{damping: 0, frame: {dimension: 3, material: {E: 30 GPa}, nodes: {a: [0, 0, 0]}, floors: [{nodes: [a], rigid: "
        "false}], "
        "masses: {a: "
        "100 t}, supports: {a: {isolator: {" +
            coupled + "lead_rubber: {strength: 50 kN, yield_displacement: 8 mm, post_yield_stiffness: 0.6 MN/m}}}}}}\n",
        "slab.yaml"));
    return test::refusal([&] { pushover(model.structures[0], {.pattern = LoadPattern::uniform, .targets = {0.2}}); });
  };
  EXPECT_TRUE(test::mentions(text(""), {"isolator a x", "coupled: false"})) << text("");
  EXPECT_FALSE(test::mentions(text("coupled: false, "), {"coupled"}));
}

class PushoverInputTest : public testing::Test {
 protected:
  std::string refusal(PushoverInput words) {
    return test::refusal<InputError>([&] { pushover(model_, words); });
  }
  Pushover found(const PushoverInput& words) const { return pushover(model_, words); }

  Model model_ = read_model(Input::read_text(R"(
structures:
  old: {shear_building: {storeys: 2, mass: 100 t, stiffness: 100 MN/m, yield_force: 1 MN, height: 3 m}, damping: 5 %}
  new: {oscillator: {mass: 100 t, period: 0.5, damping: 5 %, yield_force: 200 kN}}
  stiff: {oscillator: {mass: 100 t, period: 0.2, damping: 5 %}}
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}
analysis: {duration: 1}
)",
                                             "towers.yaml"));
};

TEST_F(PushoverInputTest, ReadsDisplacementsOfTheRoof) {
  EXPECT_NEAR(found({.structure = "old", .to = "2 % roof"}).options.targets.at(0), 0.12, 1e-15);
  EXPECT_NEAR(found({.structure = "old", .to = "-2%"}).options.targets.at(0), -0.12, 1e-15);
  EXPECT_NEAR(found({.structure = "old", .to = "25 cm roof"}).options.targets.at(0), 0.25, 1e-15);
  const std::vector<double> cycles =
      found({.structure = "old", .to = "3 %", .cyclic = "1 %, -1 %,150 mm"}).options.targets;
  ASSERT_EQ(cycles.size(), 4u);
  EXPECT_NEAR(cycles[1], -0.06, 1e-15);
  EXPECT_NEAR(cycles[3], 0.18, 1e-15);
}

TEST_F(PushoverInputTest, SaysWhatToType) {
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .to = "250"}), {"250 mm", "2 % roof", "--to"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .to = "0 mm"}), {"250 mm", "2 % roof", "--to"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "old"}), {"250 mm", "2 % roof", "--to"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .to = "20 kN"}), {"20 mm", "20 kN", "2 % roof", "--to"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .to = "much %"}), {"much %", "2 % roof", "--to"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .to = "7 m"}), {"7 m", "--to", "6 m"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "new", .to = "2 %"}), {"2 %", "250 mm", "--to"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .cyclic = "1 %,,2 %"}), {"250 mm", "2 % roof", "--cyclic"}));
  EXPECT_TRUE(test::mentions(refusal({.to = "2 %"}), {"--structure", "2"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "odl", .to = "2 %"}), {"odl", "old", "--structure"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "stiff", .to = "20 mm"}),
                             {"towers.yaml", "structures.stiff", "yield_force", "shear_building"}));
  EXPECT_TRUE(
      test::mentions(refusal({.structure = "old", .load = "unifrom", .to = "2 %"}), {"unifrom", "uniform", "--load"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .direction = "z", .to = "2 %", .mark = ""}), {"z"}));
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .to = "1 mm"}),
                             {"towers.yaml", "structures.old", "16.67 mm", "18 mm"}));
}

TEST_F(PushoverInputTest, ReadsForcesFromAFile) {
  const std::string path = testing::TempDir() + "forces.txt";
  std::ofstream(path) << "# from the ground up\n1\n3  # roof\n";
  EXPECT_NEAR(found({.structure = "old", .load = path, .to = "2 %"}).loads[1], 0.75, 1e-15);
  std::ofstream(path) << "1, 2, 3\n";
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .load = path, .to = "2 %"}), {"--load", path, "3", "2"}));
  std::ofstream(path) << "1\ntwo\n";
  EXPECT_TRUE(test::mentions(refusal({.structure = "old", .load = path, .to = "2 %"}), {"--load", path, "two", "2"}));
  std::filesystem::remove(path);
}

TEST(Pushover, OfAFrameOfTheInputMeetsItsCurve) {
  const Model model = read_model(Input::read_text(R"(
structures:
  frame:
    frame:
      material: {E: 30 GPa}
      grid: {storeys: 3, bays: 1, storey_height: 3.2 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4], shear: false},
             beams: {rectangle: [0.3, 0.5], shear: false}, floor_mass: 40 t}
      hinges:
        beams: {at: both, bilinear: {yield_moment: 180 kN m, spring_hardening: 0.003}}
        columns: {at: feet, bilinear: {yield_moment: 250 kN m, spring_hardening: 0.003}}
    damping: 5 %
ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}
analysis: {duration: 1}
)",
                                                  "frame.yaml"));
  const Pushover found = pushover(model, {.to = "250 mm"});
  ASSERT_EQ(found.path.points.size(), 6u);
  const double roof[] = {22.21674, 27.09875, 40.13070, 71.95633, 250},
               shear[] = {154.1540, 173.3743, 200.2638, 224.0691, 281.0893};
  test::Book book("pushover of a frame with hinges, from its input",
                  "event to event on another assembly of the stiffness, in Python (numpy)",
                  "half a unit of the last printed digit");
  for (int i = 0; i < 5; ++i) {
    book.near("displacement of the roof [mm]", 1e3 * found.path.points[i + 1].displacement, roof[i], 5.1e-6);
    book.near("base shear [kN]", found.path.points[i + 1].factor / 1e3, shear[i], 5.1e-5);
  }
  const auto yields = [&](int point) {
    std::vector<std::string> names;
    for (const PushEvent& event : found.path.events)
      if (event.point == point) names.push_back(found.parts[event.part].name);
    return names;
  };
  EXPECT_EQ(yields(1), (std::vector<std::string>{"beam x 1.0 start", "beam x 1.0 end"}));
  EXPECT_EQ(yields(3), (std::vector<std::string>{"column 1.0 start", "column 1.1 start"}));
  EXPECT_EQ(found.path.mechanism, 4);
}

}  // namespace pushover_test
}  // namespace pounding
