// Hysteretic laws of storeys in the input: reading, resolved model, errors.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <fmt/format.h>

#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>

#include "support/models.hpp"

namespace pounding {
namespace spring_input_test {

using test::at, test::mentions, test::refused;

std::string building(const std::string& more) {
  return "analysis: {duration: 1}\nstructures:\n  a:\n    shear_building: {storeys: 2, mass: 100 t, stiffness: [50 "
         "MN/m, 40 MN/m], " +
         more + "}\n    damping: 5 %\n    initial_velocity: 1 m/s\n";
}

TEST(SpringInput, GivesEachStoreyItsLawWithItsStiffness) {
  const Model model =
      test::model_of(building("spring: {bouc_wen: {yield_force: [600 kN, 400 kN], hardening: 5 %, exponent: 1.5}}"));
  const std::vector<YieldingPart>& storeys = model.structures[0].yielding;
  ASSERT_EQ(storeys.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const double k = i == 0 ? 50e6 : 40e6, fy = i == 0 ? 6e5 : 4e5;
    EXPECT_EQ(storeys[i].law, "bouc_wen");
    EXPECT_EQ(storeys[i].name, fmt::format("storey {}", i + 1));
    EXPECT_DOUBLE_EQ(storeys[i].stiffness(), k);
    EXPECT_DOUBLE_EQ(storeys[i].yield_deformation(), fy / k);
    // Far beyond its yield deformation a storey carries the yield force plus hardening.
    const double far = 100 * fy / k;
    EXPECT_NEAR(k * far + LoadedSpring(storeys[i].spring()).evaluate({far, 0}).force, 0.05 * k * far + 0.95 * fy,
                1e-9 * fy);
  }
}

TEST(SpringInput, OfAnOscillatorFollowsFromItsPeriod) {
  const Model model = test::model_of(
      "analysis: {duration: 1}\nstructures: {a: {oscillator: {mass: 100 t, period: 0.5 s, damping: 5 %, spring: "
      "{bilinear: {yield_force: 100 kN}}}, initial_velocity: 1}}\n");
  const double k = 1e5 * std::pow(4 * M_PI, 2);
  EXPECT_DOUBLE_EQ(model.structures[0].yielding.at(0).stiffness(), k);
}

TEST(SpringInput, IsInTheResolvedModelWithItsDefaults) {
  const std::string text = resolved_yaml(
      test::model_of(building("spring: {menegotto_pinto: {yield_force: [600 kN, 400 kN], memory: last}}")));
  EXPECT_NE(text.find("spring:\n      menegotto_pinto:\n        yield_force: [600000, 400000]\n        hardening: [0, "
                      "0]\n        R0: [20, 20]"),
            text.npos)
      << text;
  EXPECT_NE(text.find("memory: last"), text.npos) << text;
}

TEST(SpringInput, ThatIsBilinearAgreesWithYieldForce) {
  EXPECT_EQ(resolved_yaml(test::model_of(building("spring: {bilinear: {yield_force: 600 kN, hardening: 5 %}}"))),
            resolved_yaml(test::model_of(building("yield_force: 600 kN, hardening: 5 %"))));
}

TEST(SpringInput, ReportsErrorsWithTheirLocation) {
  refused(building("spring: bouc_wen"), at("4:86", "structures.a.shear_building.spring"),
          mentions({"spring: {bouc_wen: {yield_force: 2 MN}}"}));
  refused(building("spring: {boucwen: {yield_force: 600 kN}}"), at("4:87", "structures.a.shear_building.spring"),
          mentions({"boucwen", "bouc_wen"}));
  refused(building("spring: {law: bouc_wen, yield_force: 600 kN}"), at("4:87", "structures.a.shear_building.spring"),
          mentions({"law", "bouc_wen: {yield_force: 150 kN}"}));
  refused(building("law: bouc_wen"), at("4:78", "structures.a.shear_building"),
          mentions({"law", "isolator: {bouc_wen: {stiffness: 1e+07 N/m, yield_force: 150 kN}}",
                    "spring: {bouc_wen: {yield_force: 150 kN}}"}));
  refused(building("spring: {}"), at("4:86", "structures.a.shear_building.spring"),
          mentions({"spring: {bouc_wen: {yield_force: 2 MN, hardening: 5 %}}", "menegotto_pinto"}));
  refused(building("spring: {bilinear: {yield_force: 1 MN}, bouc_wen: {yield_force: 1 MN}}"),
          at("4:118", "structures.a.shear_building.spring.bouc_wen"));
  refused(building("spring: {bouc_wen: {hardening: 5 %}}"), at("4:97", "structures.a.shear_building.spring.bouc_wen"),
          mentions({"yield_force: 150 kN"}));
  refused(building("spring: {bouc_wen: {yield_force: [600 kN]}}"),
          at("4:111", "structures.a.shear_building.spring.bouc_wen.yield_force"), mentions({"200 kN", "2"}));
  refused(building("spring: {bouc_wen: {yield_force: 600 kN, stiffness: 1 MN/m}}"),
          at("4:119", "structures.a.shear_building.spring.bouc_wen"),
          mentions({"stiffness", "yield_force", "hardening", "exponent"}));
  refused(building("spring: {bouc_wen: {yield_force: 600 mm}}"),
          at("4:111", "structures.a.shear_building.spring.bouc_wen.yield_force"), mentions({"200 kN", "600 mm"}));
  refused(building("spring: {bouc_wen: {yield_force: [600 kN, -1 kN]}}"),
          at("4:111", "structures.a.shear_building.spring.bouc_wen.yield_force"),
          mentions({"yield_force", "2", "-1000"}));
  refused(building("spring: {bouc_wen: {yield_force: 600 kN, gamma_share: 0.6}}"),
          at("4:132", "structures.a.shear_building.spring.bouc_wen.gamma_share"),
          mentions({"[0, 0.5]", "gamma_share", "0.6"}));
  refused(building("spring: {bouc_wen: {yield_force: 600 kN, hardening: 1}}"),
          at("4:130", "structures.a.shear_building.spring.bouc_wen.hardening"), mentions({"[0, 1)", "hardening"}));
  refused(building("spring: {menegotto_pinto: {yield_force: 600 kN, memory: all}}"),
          at("4:134", "structures.a.shear_building.spring.menegotto_pinto.memory"),
          mentions({"all", "nested", "last"}));
  refused(building("spring: {bouc_wen: {yield_force: 600 kN}}, yield_force: 600 kN"),
          at("4:121", "structures.a.shear_building.yield_force"), mentions({"spring"}));
  refused(building("spring: {bouc_wen: {yield_force: 600 kN}}, hardening: 5 %"),
          at("4:121", "structures.a.shear_building.hardening"), mentions({"spring"}));
  refused(building("spring: backfill"), at("4:86", "structures.a.shear_building.spring"), mentions({"backfill"}));
}

}  // namespace spring_input_test
}  // namespace pounding
