// Laws of yielding storeys in the input: what is read, what the report of the resolved model says, and the errors.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <fmt/format.h>

#include <pounding/input/read_model.hpp>
#include <pounding/input/resolved.hpp>

#include "support/models.hpp"
#include "support/refusals.hpp"

namespace pounding {
namespace spring_input_test {

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
    EXPECT_DOUBLE_EQ(storeys[i].spring->stiffness(), k);
    EXPECT_DOUBLE_EQ(storeys[i].spring->yield_deformation(), fy / k);
    // Far beyond its yield deformation a storey carries its yield force and the hardening.
    const double far = 100 * fy / k;
    EXPECT_NEAR(k * far + storeys[i].spring->evaluate({far, 0}).force, 0.05 * k * far + 0.95 * fy, 1e-9 * fy);
  }
}

TEST(SpringInput, OfAnOscillatorGoesByItsPeriod) {
  const Model model = test::model_of(
      "analysis: {duration: 1}\nstructures: {a: {oscillator: {mass: 100 t, period: 0.5 s, damping: 5 %, spring: "
      "{bilinear: {yield_force: 100 kN}}}, "
      "initial_velocity: 1}}\n");
  const double k = 1e5 * std::pow(4 * M_PI, 2);
  EXPECT_DOUBLE_EQ(model.structures[0].yielding.at(0).spring->stiffness(), k);
}

TEST(SpringInput, StandsInTheResolvedModelWithItsDefaults) {
  const std::string text = resolved_yaml(
      test::model_of(building("spring: {menegotto_pinto: {yield_force: [600 kN, 400 kN], memory: last}}")));
  EXPECT_NE(text.find("spring:\n      menegotto_pinto:\n        yield_force: [600000, 400000]\n        hardening: [0, "
                      "0]\n        R0: [20, 20]"),
            text.npos)
      << text;
  EXPECT_NE(text.find("memory: last"), text.npos) << text;
}

TEST(SpringInput, ThatIsBilinearIsThatOfItsOwnKeys) {
  EXPECT_EQ(resolved_yaml(test::model_of(building("spring: {bilinear: {yield_force: 600 kN, hardening: 5 %}}"))),
            resolved_yaml(test::model_of(building("yield_force: 600 kN, hardening: 5 %"))));
}

TEST(SpringInput, SaysWhereItIsWrongAndWhatToType) {
  const auto refused = [](const std::string& spring, const std::string& place, const std::string& message) {
    test::refused(building(spring), "4:" + place + message);
  };
  refused("spring: bouc_wen", "86: structures.a.shear_building.",
          "spring: says the law alone; type spring: {bouc_wen: {yield_force: 2 MN}} with its numbers");
  refused("spring: {boucwen: {yield_force: 600 kN}}", "87: structures.a.shear_building.",
          "spring: unknown key \"boucwen\". Did you mean \"bouc_wen\"?");
  refused("spring: {law: bouc_wen, yield_force: 600 kN}", "87: structures.a.shear_building.",
          "spring: unknown key \"law\". Type \"bouc_wen: {yield_force: 150 kN}\" in its place.");
  refused("law: bouc_wen", "78: structures.a.shear_building",
          ": unknown key \"law\". Type \"isolator: {bouc_wen: {stiffness: 1e+07 N/m, yield_force: 150 kN}}\" or "
          "\"spring: {bouc_wen: {yield_force: 150 kN}}\" in its place.");
  refused("spring: {}", "86: structures.a.shear_building.",
          "spring: the law is missing; type spring: {bouc_wen: {yield_force: 2 MN}}");
  refused("spring: {bilinear: {yield_force: 1 MN}, bouc_wen: {yield_force: 1 MN}}", "118: structures.a.shear_building.",
          "spring.bouc_wen: a storey follows one law, and bilinear is given too; keep one of the two");
  refused("spring: {bouc_wen: {hardening: 5 %}}", "97: structures.a.shear_building.",
          "spring.bouc_wen: key \"yield_force\" is missing; type \"yield_force: 150 kN\"");
  refused("spring: {bouc_wen: {yield_force: [600 kN]}}", "111: structures.a.shear_building.",
          "spring.bouc_wen.yield_force: takes a force such as \"200 kN\" or a list of 2 from the ground up; a list of "
          "1 was read");
  refused("spring: {bouc_wen: {yield_force: 600 kN, stiffness: 1 MN/m}}", "119: structures.a.shear_building.",
          "spring.bouc_wen: unknown key \"stiffness\". Allowed: yield_force, hardening, exponent, gamma_share.");
  refused("spring: {bouc_wen: {yield_force: 600 mm}}", "111: structures.a.shear_building.",
          "spring.bouc_wen.yield_force: takes a force such as \"200 kN\"; \"600 mm\" is a length");
  refused("spring: {bouc_wen: {yield_force: [600 kN, -1 kN]}}", "111: structures.a.shear_building.",
          "spring.bouc_wen.yield_force: storey 2: yield_force is -1000, but must be finite and positive");
  refused(
      "spring: {bouc_wen: {yield_force: 600 kN, gamma_share: 0.6}}", "132: structures.a.shear_building.",
      "spring.bouc_wen.gamma_share: gamma_share is 0.6, but must be in [0, 0.5]: above it the law would create energy");
  refused("spring: {bouc_wen: {yield_force: 600 kN, hardening: 1}}", "130: structures.a.shear_building.",
          "spring.bouc_wen.hardening: hardening is 1, but must be in [0, 1)");
  refused("spring: {menegotto_pinto: {yield_force: 600 kN, memory: all}}", "134: structures.a.shear_building.",
          "spring.menegotto_pinto.memory: unknown memory \"all\". Allowed: nested, last.");
  refused("spring: {bouc_wen: {yield_force: 600 kN}}, yield_force: 600 kN", "121: structures.a.shear_building.",
          "yield_force: belongs to a bilinear storey, and a spring is given too; keep one of the two");
  refused("spring: {bouc_wen: {yield_force: 600 kN}}, hardening: 5 %", "121: structures.a.shear_building.",
          "hardening: belongs to a bilinear storey, and a spring is given too; keep one of the two");
  refused("spring: backfill", "86: structures.a.shear_building.",
          "spring: backfill is no law of storeys; pounding words spring lists them");
}

}  // namespace spring_input_test
}  // namespace pounding
