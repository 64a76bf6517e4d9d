// Isolators in the input, and their errors.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/input/resolved.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/structures/isolators.hpp>
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace isolator_input_test {

using test::at, test::mentions, test::model_of, test::refused;

std::string building(const std::string& isolator,
                     const std::string& rest = "storeys: 3, mass: 200 t, stiffness: 300 MN/m") {
  return "ground_motion: {harmonic: {amplitude: 1, period: 1, duration: 1}}\nanalysis: {duration: 1}\nstructures:\n  "
         "a: {shear_building: {isolator: " +
         isolator + ", " + rest + "}, damping: 2 %}\n";
}

std::string frame(const std::string& feet, const std::string& more = "", bool in_space = false) {
  const std::string bays = in_space ? "[1, 1]" : "1",
                    corners =
                        in_space ? "{0.0.0: 20 t, 0.1.0: 20 t, 0.0.1: 20 t, 0.1.1: 20 t}" : "{0.0: 20 t, 0.1: 20 t}";
  return "ground_motion: {harmonic: {amplitude: 1, period: 1, duration: 1}}\nanalysis: {duration: 1}\nstructures:\n  "
         "a:\n    damping: 2 %\n    frame:\n      material: {E: 30 GPa}\n      masses: " +
         corners + "\n      grid: {storeys: 1, bays: " + bays +
         ", storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4]}, beams: {rectangle: [0.3, 0.5]}, "
         "floor_mass: 60 t}\n      supports:\n        feet: " +
         feet + "\n" + more;
}

// `message` is the text after the file name.
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
  EXPECT_TRUE(test::mentions(text, {"lead_rubber", "34.75 MN/m", "12 mm", "417 kN", "2.601 s", "300 mm"}));
  const std::string resolved = resolved_yaml(model);
  EXPECT_NE(resolved.find("isolators"), std::string::npos) << resolved;
  EXPECT_NE(resolved.find("isolated_period: 2.60"), std::string::npos) << resolved;
}

TEST(IsolatorInput, AllowsStoreysAboveToYield) {
  const Model model = model_of(building("{friction_pendulum: {radius: 2 m, friction: 6 %}}",
                                        "storeys: 3, mass: 200 t, stiffness: 300 MN/m, yield_force: [2 MN, 1 MN]"));
  ASSERT_EQ(model.structures[0].yielding.size(), 3u);
  EXPECT_EQ(model.structures[0].yielding[2].name, "storey 3");
}

TEST(IsolatorInput, IsUnderTheFeetOfAFrame) {
  const Model model =
      model_of(frame("{isolator: {friction_pendulum: {radius: 2 m, friction: 6 %}}}", "      gravity: true\n"));
  const Structure& s = model.structures[0];
  ASSERT_EQ(s.yielding.size(), 2u);
  EXPECT_EQ(s.yielding[1].name, "isolator 0.1");
  EXPECT_NEAR(isolated_period(s), 2 * M_PI * std::sqrt(2 / 9.80665), 1e-9);
  EXPECT_NE(describe(model).find("     2 isolators, friction_pendulum: stiffness "), std::string::npos)
      << describe(model);
}

TEST(IsolatorInput, TreatsTheAxesSeparatelyInSpace) {
  const Model model =
      model_of(frame("{isolator: {coupled: false, lead_rubber: {strength: 100 kN, yield_displacement: 10 mm, "
                     "post_yield_stiffness: 1 MN/m}}}",
                     "", true));
  ASSERT_EQ(model.structures[0].yielding.size(), 8u);
  EXPECT_EQ(model.structures[0].yielding[1].name, "isolator 0.0.0 y");
}

TEST(IsolatorInput, CouplesTheAxesInSpace) {
  const Model model =
      model_of(frame("{isolator: {friction_pendulum: {radius: 2 m, friction: [4 %, 8 %], rate: 60 s/m}}}",
                     "      gravity: true\n", true));
  const std::vector<YieldingPart>& parts = model.structures[0].yielding;
  ASSERT_EQ(parts.size(), 8u);
  EXPECT_EQ(parts[2].name, "isolator 0.1.0 x");
  EXPECT_EQ(parts[3].name, "isolator 0.1.0 y");
  EXPECT_EQ(parts[2].element, parts[3].element);
  EXPECT_NE(parts[1].element, parts[2].element);
  EXPECT_NEAR(parts[2].parameter("weight"), 35e3 * 9.80665, 1);
  EXPECT_NEAR(isolated_period(model.structures[0]), 2 * M_PI * std::sqrt(2 / 9.80665), 1e-9);
  EXPECT_TRUE(mentions(describe(model), {"4 isolators", "friction_pendulum, coupled along x and y"}));
  EXPECT_NE(resolved_yaml(model).find("coupled: true"), std::string::npos);
}

TEST(IsolatorInput, ReportsErrorsInAShearBuilding) {
  refused(building("lead_rubber"), at("4:34", "structures.a.shear_building.isolator"),
          mentions({"isolator: {friction_pendulum: {radius: 2 m, friction: 6 %}}"}));
  refused(building("{capacity: 300 mm}"), at("4:34", "structures.a.shear_building.isolator"),
          mentions({"isolator: {friction_pendulum: {radius: 2 m, friction: 6 %}}"}));
  refused(building("{friction_pendulum: {radius: 2 m}}"),
          at("4:54", "structures.a.shear_building.isolator.friction_pendulum"), mentions({"friction: 0.06"}));
  refused(building("{friction_pendulum: {radius: 2 m, friction: -6 %}}"),
          at("4:78", "structures.a.shear_building.isolator.friction_pendulum.friction"),
          mentions({"-0.06", "friction"}));
  refused(building("{friction_pendulum: {radius: 2 m, friction: 6 %}, coupled: false}"),
          at("4:84", "structures.a.shear_building.isolator.coupled"), mentions({"shear"}));
  refused(building("{friction_pendulum: {radius: 2 m, friction: 6 %}}",
                   "storeys: 3, mass: 200 t, stiffness: [1 MN/m, 300 MN/m, 300 MN/m]"),
          at("4:121", "structures.a.shear_building.stiffness"), mentions({"2", "3"}));
  refused(building("{friction_pendulum: {radius: 2 m, friction: 6 %}}", "storeys: 1, mass: 200 t, stiffness: 300 MN/m"),
          at("4:110", "structures.a.shear_building.stiffness"), mentions({"storeys: 2"}));
}

TEST(IsolatorInput, TakesVelocityDependentFriction) {
  const Model model = model_of(building("{friction_pendulum: {radius: 2 m, friction: [4 %, 8 %], rate: 60 s/m}}"));
  const YieldingPart& part = model.structures[0].yielding[0];
  EXPECT_NEAR(part.stiffness(), 600e3 * 9.80665 * (0.5 + 0.08 / 0.5e-3), 1e-3);
  EXPECT_NEAR(isolated_period(model.structures[0]), 2 * M_PI * std::sqrt(2 / 9.80665), 1e-9);
  refused(building("{friction_pendulum: {radius: 2 m, friction: [4 %, 8 %]}}"),
          at("4:78", "structures.a.shear_building.isolator.friction_pendulum.friction"), mentions({"rate: 60 s/m"}));
  refused(building("{friction_pendulum: {radius: 2 m, friction: 6 %, rate: 60 s/m}}"),
          at("4:83", "structures.a.shear_building.isolator.friction_pendulum.rate"),
          mentions({"friction: [4 %, 8 %]"}));
  refused(building("{friction_pendulum: {radius: 2 m, friction: [8 %, 4 %], rate: 60 s/m}}"),
          at("4:78", "structures.a.shear_building.isolator.friction_pendulum.friction"),
          mentions({"0.08", "0.04", "friction"}));
}

TEST(IsolatorInput, ReportsErrorsInAFrame) {
  const std::string law = "lead_rubber: {strength: 100 kN, yield_displacement: 10 mm, post_yield_stiffness: 1 MN/m}";
  refused(frame("{isolator: {friction_pendulum: {radius: 2 m, friction: 6 %}}}"),
          at("11:26", "structures.a.frame.supports.feet.isolator"),
          mentions({"gravity: true", "weight: 500 kN", "0.0"}));
  refused(frame("{isolator: {" + law + ", coupled: false}}"),
          at("11:117", "structures.a.frame.supports.feet.isolator.coupled"));
  refused(frame("{fix: [ux, uz], isolator: {" + law + "}}"), at("11:21", "structures.a.frame.supports.feet.fix"),
          mentions({"fix: [uz, ry]"}));
  for (const std::string other : {"peak_oriented: {stiffness: 10 MN/m, yield_force: 100 kN}",
                                  "menegotto_pinto: {stiffness: 10 MN/m, yield_force: "
                                  "100 kN}"})
    refused(frame("{isolator: {" + other + "}}", "", true), at("11:26", "structures.a.frame.supports.feet.isolator"),
            mentions({other.substr(0, other.find(':')), "coupled: false", "bilinear", "bouc_wen", "friction_pendulum",
                      "lead_rubber", "elastomeric"}));
  refused(
      frame("{isolator: {bilinear: {stiffness: 10 MN/m, yield_force: 100 kN, negative_yield_force: 50 kN}}}", "", true),
      at("11:26", "structures.a.frame.supports.feet.isolator"), mentions({"negative_yield_force", "coupled: false"}));
  refused(frame("{isolator: {" + law + ", coupled: yes please}}", "", true),
          at("11:126", "structures.a.frame.supports.feet.isolator.coupled"), mentions({"true", "false"}));
  refused(frame("{delay: 0.1 s, isolator: {" + law + "}}", "        \"0.1\": fixed\n"),
          at("11:40", "structures.a.frame.supports.feet.isolator"), mentions({"ground_motion", "0.0"}));
}

TEST(IsolatorInput, RejectsRayleighDamping) {
  std::string text = building("{friction_pendulum: {radius: 2 m, friction: 6 %}}");
  text.replace(text.find("damping: 2 %"), 12, "damping: {rayleigh: {ratio: 2 %}}");
  refused(text, at("4:142", "structures.a.damping.rayleigh"),
          mentions({"damping: {modal: {ratio: 2 %}}", "damping: 2 %"}));
}

}  // namespace isolator_input_test
}  // namespace pounding
