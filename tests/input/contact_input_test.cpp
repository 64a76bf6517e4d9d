// Links in the input: laws without restitution, zero restitution, preloads.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <pounding/input/resolved.hpp>
#include <pounding/reports/describe.hpp>
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace contact_input_test {

using test::at, test::mentions, test::model_of, test::refused;

std::string link(const std::string& keys) {
  return "structures:\n  left: {oscillator: {mass: 100 t, stiffness: 20 MN/m, damping: 5 %}}\n  right: {oscillator: "
         "{mass: 150 t, stiffness: 50 MN/m, damping: 5 %}}\nlinks:\n  - {between: [left, right], " +
         keys + "}\nanalysis: {duration: 1}\n";
}

double parameter(const Model& model, std::string_view name) {
  const auto& values = model.links.at(0).parameters;
  const auto found = std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.name == name; });
  return found == values.end() ? -1 : found->value;
}

TEST(ContactInput, TakesTheCoefficientOfADashpot) {
  for (const std::string law :
       {"kelvin_voigt", "kelvin_voigt_no_tension", "komodromos", "modified_linear_viscoelastic"}) {
    const Model model =
        model_of(link("gap: 1 mm, law: " + law + ", stiffness: 90 MN/m, damping_coefficient: 300 kN s/m"));
    EXPECT_EQ(parameter(model, "damping_coefficient"), 3e5) << law;
    EXPECT_DOUBLE_EQ(parameter(model, "damping_ratio"), 3e5 / (2 * std::sqrt(9e7 * 6e4))) << law;
  }
  refused(link("gap: 1 mm, law: kelvin_voigt, stiffness: 90 MN/m, damping_coefficient: 300 kN"),
          at("5:101", "links[0].damping_coefficient"), mentions({"200 kN s/m", "300 kN"}));
}

TEST(ContactInput, TakesTheTwoStiffnessesAndTheYieldOfABilinearContact) {
  const Model model =
      model_of(link("gap: 1 mm, law: bilinear_hertz, initial_stiffness: 1200 MN/m, secondary_stiffness: 150 MN/m, "
                    "yield_penetration: 0.9 mm"));
  EXPECT_EQ(model.links[0].parameters.size(), 3u);
  EXPECT_DOUBLE_EQ(parameter(model, "yield_penetration"), 9e-4);
  EXPECT_EQ(model.links[0].formula, "");
  refused(link("gap: 1 mm, law: bilinear_hertz, initial_stiffness: 1200 MN/m, yield_penetration: 0.9 mm"),
          at("5:46", "links[0].law"), mentions({"secondary_stiffness: 1.5e+08 N/m", "bilinear_hertz", "K2"}));
  refused(link("gap: 1 mm, law: bilinear_hertz, stiffness: 2.75e9, initial_stiffness: 1200 MN/m, secondary_stiffness: "
               "150 MN/m, yield_penetration: 0.9 mm"),
          at("5:73", "links[0].stiffness"), mentions({"initial_stiffness"}));
}

TEST(ContactInput, TakesAContactThatCrushes) {
  const Model model = model_of(link("gap: 1 mm, law: elastoplastic, stiffness: 2.75e9 N/m^1.5, restitution: 0.6"));
  EXPECT_DOUBLE_EQ(parameter(model, "indentation_ratio"), 1 - 0.36);
  refused(link("gap: 1 mm, law: elastoplastic, stiffness: 2.75e9, indentation_ratio: 1"),
          at("5:99", "links[0].indentation_ratio"), mentions({"[0, 1)", "indentation_ratio"}));
}

TEST(ContactInput, TakesAWallWithBackfill) {
  const std::string law = "gap: 1 mm, law: backfill, stiffness: 250 MN/m, failure_ratio: 0.75, strength: 6 MN";
  EXPECT_EQ(parameter(model_of(link(law + ", unloading: 500 MN/m")), "strength"), 6e6);
  refused(link(law), at("5:46", "links[0].law"), mentions({"unloading: 5e+08 N/m", "K_ur", "backfill"}));
  refused(link(law + ", unloading: 200 MN/m"), at("5:125", "links[0].unloading"),
          mentions({"2e+08", "2.5e+08", "unloading"}));
  const std::string soil =
      "gap: 1 mm, law: backfill, unloading: 500 MN/m, failure_ratio: 0.75, strength: 6 MN, stiffness: ";
  for (const std::string estimate : {"auto", "{E: 30 GPa, radius: 2 m}"})
    refused(link(soil + estimate), at("5:125", "links[0].stiffness"), mentions({"stiffness: 2.5e+08 N/m", "backfill"}));
}

TEST(ContactInput, TakesZeroRestitutionWhereTheBodiesStick) {
  EXPECT_EQ(model_of(link("gap: 1 mm, law: stereomechanical, restitution: 0")).links[0].contact->restitution(), 0);
  EXPECT_EQ(
      parameter(model_of(link("gap: 1 mm, law: kelvin_voigt, stiffness: 90 MN/m, restitution: 0 %")), "damping_ratio"),
      1);
  refused(link("gap: 1 mm, law: jankowski, stiffness: 2.75e9, restitution: 0"), at("5:89", "links[0].restitution"),
          mentions({"kelvin_voigt", "0", "stereomechanical", "restitution"}));
}

TEST(ContactInput, TakesAPreloadWithANegativeGap) {
  const Model model = model_of(link("gap: -2 mm, preload: true, law: linear_spring, stiffness: 93.5 MN/m"));
  EXPECT_EQ(model.links[0].gap, -2e-3);
  EXPECT_TRUE(model.links[0].preload);
  EXPECT_NE(resolved_yaml(model).find("preload: true"), std::string::npos);
  EXPECT_NE(describe(model).find("gap -2 mm, preloaded"), std::string::npos);
  EXPECT_FALSE(model_of(link("gap: 2 mm, preload: false, law: hertz, stiffness: 1e9")).links[0].preload);
  refused(link("gap: 2 mm, preload: true, law: hertz, stiffness: 1e9"), at("5:41", "links[0].preload"),
          mentions({"gap: -2 mm"}));
  refused(link("gap: -2 mm, preload: true, law: hertz_damped, stiffness: 2.75e9, restitution: 0.5"),
          at("5:51", "links[0].preload"), mentions({"impact_velocity", "linear_spring", "hertz"}));
}

}  // namespace contact_input_test
}  // namespace pounding
