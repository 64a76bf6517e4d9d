// Isolators in the input: their meaning, and the report of each mistake in them.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/model/describe.hpp>
#include <pounding/structures/isolators.hpp>
#include "support/models.hpp"

namespace pounding {
namespace isolator_input_test {

using test::model_of;

std::string building(const std::string& isolator,
                     const std::string& rest = "storeys: 3, mass: 200 t, stiffness: 300 MN/m") {
  return "ground_motion: {harmonic: {amplitude: 1, period: 1, duration: 1}}\nanalysis: {duration: 1}\nstructures:\n"
         "  a: {shear_building: {isolator: " +
         isolator + ", " + rest + "}, damping: 2 %}\n";
}

std::string frame(const std::string& feet, const std::string& more = "", bool in_space = false) {
  const std::string bays = in_space ? "[1, 1]" : "1",
                    corners =
                        in_space ? "{0.0.0: 20 t, 0.1.0: 20 t, 0.0.1: 20 t, 0.1.1: 20 t}" : "{0.0: 20 t, 0.1: 20 t}";
  return "ground_motion: {harmonic: {amplitude: 1, period: 1, duration: 1}}\nanalysis: {duration: 1}\nstructures:\n"
         "  a:\n    damping: 2 %\n    frame:\n      material: {E: 30 GPa}\n      masses: " +
         corners + "\n      grid: {storeys: 1, bays: " + bays +
         ", storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4]}, beams: {rectangle: [0.3, 0.5]}, "
         "floor_mass: 60 t}\n"
         "      supports:\n        feet: " +
         feet + "\n" + more;
}

// `message` is the whole text after the name of the file.
void refused(const std::string& yaml, const std::string& message) {
  try {
    model_of(yaml);
    ADD_FAILURE() << "this was taken: " << yaml << "\nnot refused: " << message;
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.substr(text.find(':') + 1), message) << yaml;
  }
}

TEST(IsolatorInput, IsTheLowestStoreyOfAShearBuilding) {
  const Model model =
      model_of(building("{lead_rubber: {strength: 375 kN, yield_displacement: 12 mm, post_yield_stiffness: 3.5 MN/m}, "
                        "capacity: 300 mm}"));
  const Structure& s = model.structures[0];
  ASSERT_EQ(s.yielding.size(), 1u);
  EXPECT_NEAR(s.storey_stiffness[0], 3.5e6 + 375e3 / 0.012, 1e-6);
  EXPECT_EQ(s.storey_stiffness[2], 300e6);
  EXPECT_EQ(s.yielding[0].parameter("capacity"), 0.3);
  const std::string text = describe(model);
  EXPECT_NE(text.find("     isolators, lead_rubber: stiffness 34.75 MN/m, yield displacement 12 mm at 417 kN, isolated "
                      "period 2.601 s, capacity 300 mm\n"),
            std::string::npos)
      << text;
  const std::string resolved = resolved_yaml(model);
  EXPECT_NE(resolved.find("isolators"), std::string::npos) << resolved;
  EXPECT_NE(resolved.find("isolated_period: 2.60"), std::string::npos) << resolved;
}

TEST(IsolatorInput, LetsTheStoreysAboveItYield) {
  const Model model = model_of(building("{friction_pendulum: {radius: 2 m, friction: 6 %}}",
                                        "storeys: 3, mass: 200 t, stiffness: 300 MN/m, yield_force: [2 MN, 1 MN]"));
  ASSERT_EQ(model.structures[0].yielding.size(), 3u);
  EXPECT_EQ(model.structures[0].yielding[2].name, "storey 3");
}

TEST(IsolatorInput, StandsUnderTheFeetOfAFrame) {
  const Model model =
      model_of(frame("{isolator: {friction_pendulum: {radius: 2 m, friction: 6 %}}}", "      gravity: true\n"));
  const Structure& s = model.structures[0];
  ASSERT_EQ(s.yielding.size(), 2u);
  EXPECT_EQ(s.yielding[1].name, "isolator 0.1");
  EXPECT_NEAR(isolated_period(s), 2 * M_PI * std::sqrt(2 / 9.80665), 1e-9);
  EXPECT_NE(describe(model).find("     2 isolators, friction_pendulum: stiffness "), std::string::npos)
      << describe(model);
}

TEST(IsolatorInput, TakesEachAxisByItselfInSpace) {
  const Model model =
      model_of(frame("{isolator: {coupled: false, lead_rubber: {strength: 100 kN, yield_displacement: 10 mm, "
                     "post_yield_stiffness: 1 MN/m}}}",
                     "", true));
  ASSERT_EQ(model.structures[0].yielding.size(), 8u);
  EXPECT_EQ(model.structures[0].yielding[1].name, "isolator 0.0.0 y");
}

TEST(IsolatorInput, SaysWhatIsWrongInAShearBuilding) {
  refused(building("lead_rubber"),
          "4:34: structures.a.shear_building.isolator: takes a law with its numbers; type isolator: "
          "{friction_pendulum: {radius: 2 m, friction: 6 %}}");
  refused(building("{capacity: 300 mm}"),
          "4:34: structures.a.shear_building.isolator: the law is missing; type isolator: {friction_pendulum: {radius: "
          "2 m, friction: 6 %}}");
  refused(
      building("{friction_pendulum: {radius: 2 m}}"),
      R"(4:54: structures.a.shear_building.isolator.friction_pendulum: key "friction" is missing; type "friction: 0.06")");
  refused(building("{friction_pendulum: {radius: 2 m, friction: -6 %}}"),
          "4:78: structures.a.shear_building.isolator.friction_pendulum.friction: friction is -0.06, but must be "
          "finite and positive");
  refused(building("{friction_pendulum: {radius: 2 m, friction: 6 %}, coupled: false}"),
          "4:84: structures.a.shear_building.isolator.coupled: is for frames in space; a shear building moves along x "
          "only, so leave it out");
  refused(building("{friction_pendulum: {radius: 2 m, friction: 6 %}}",
                   "storeys: 3, mass: 200 t, stiffness: [1 MN/m, 300 MN/m, 300 MN/m]"),
          "4:121: structures.a.shear_building.stiffness: takes one value, or a list of 2, of the storeys above the "
          "isolators, whose law has their "
          "stiffness; a list of 3 was read");
  refused(building("{friction_pendulum: {radius: 2 m, friction: 6 %}}", "storeys: 1, mass: 200 t, stiffness: 300 MN/m"),
          "4:110: structures.a.shear_building.stiffness: is that of storeys above the isolators, and there are none; "
          "type storeys: 2, or leave it out");
}

TEST(IsolatorInput, TakesFrictionThatGrowsWithTheVelocity) {
  const Model model = model_of(building("{friction_pendulum: {radius: 2 m, friction: [4 %, 8 %], rate: 60 s/m}}"));
  const YieldingPart& part = model.structures[0].yielding[0];
  EXPECT_NEAR(part.spring->stiffness(), 600e3 * 9.80665 * (0.5 + 0.08 / 0.5e-3), 1e-3);
  EXPECT_NEAR(isolated_period(model.structures[0]), 2 * M_PI * std::sqrt(2 / 9.80665), 1e-9);
  refused(building("{friction_pendulum: {radius: 2 m, friction: [4 %, 8 %]}}"),
          "4:78: structures.a.shear_building.isolator.friction_pendulum.friction: depends on the velocity, and says "
          "not how fast; type rate: 60 s/m "
          "beside it");
  refused(building("{friction_pendulum: {radius: 2 m, friction: 6 %, rate: 60 s/m}}"),
          "4:83: structures.a.shear_building.isolator.friction_pendulum.rate: is that between two coefficients; type "
          "friction: [4 %, 8 %] beside it, "
          "those of slow and of fast sliding");
  refused(building("{friction_pendulum: {radius: 2 m, friction: [8 %, 4 %], rate: 60 s/m}}"),
          "4:78: structures.a.shear_building.isolator.friction_pendulum.friction: friction is 0.08, but must be "
          "positive and, the first of two, at most "
          "the second, 0.04");
}

TEST(IsolatorInput, SaysWhatIsWrongInAFrame) {
  const std::string law = "lead_rubber: {strength: 100 kN, yield_displacement: 10 mm, post_yield_stiffness: 1 MN/m}";
  refused(frame("{isolator: {friction_pendulum: {radius: 2 m, friction: 6 %}}}"),
          "11:26: structures.a.frame.supports.feet.isolator: isolator 0.0: the weight on it is the load at rest, and "
          "no gravity acts; type gravity: "
          "true, or weight: 500 kN in its law");
  refused(frame("{isolator: {" + law + ", coupled: false}}"),
          "11:117: structures.a.frame.supports.feet.isolator.coupled: is for frames in space; a plane one moves along "
          "x only, so leave it out");
  refused(frame("{fix: [ux, uz], isolator: {" + law + "}}"),
          "11:21: structures.a.frame.supports.feet.fix: holds what the isolator lets go; type fix: [uz, ry], or leave "
          "fix out");
  refused(frame("{isolator: {" + law + "}}", "", true),
          "11:26: structures.a.frame.supports.feet.isolator: moves along x and y at once in space, and no law couples "
          "the two yet; type coupled: false "
          "for each axis by itself, which carries up to 1.41 times too much along a diagonal");
  refused(frame("{delay: 0.1 s, isolator: {" + law + "}}", "        \"0.1\": fixed\n"),
          "11:40: structures.a.frame.supports.feet.isolator: isolator 0.0: in a frame on isolators all supports move "
          "alike; leave out their delay and "
          "ground_motion, or the isolators");
}

TEST(IsolatorInput, IsNotBrakedByRayleighDamping) {
  std::string text = building("{friction_pendulum: {radius: 2 m, friction: 6 %}}");
  text.replace(text.find("damping: 2 %"), 12, "damping: {rayleigh: {ratio: 2 %}}");
  refused(text,
          "4:142: structures.a.damping.rayleigh: would brake what the isolators do; type damping: 2 %, which is in "
          "proportion to the stiffness above "
          "them, or damping: {modal: {ratio: 2 %}}");
}

}  // namespace isolator_input_test
}  // namespace pounding
