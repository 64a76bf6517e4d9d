// Laws without a restitution, restitution 0, and links that press from the start, as an input names them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <pounding/input/resolved.hpp>
#include <pounding/model/describe.hpp>
#include "support/models.hpp"
#include "support/refusals.hpp"

namespace pounding {
namespace contact_input_test {

using test::model_of;
using test::refused;

std::string link(const std::string& keys) {
  return "structures:\n"
         "  left: {oscillator: {mass: 100 t, stiffness: 20 MN/m, damping: 5 %}}\n"
         "  right: {oscillator: {mass: 150 t, stiffness: 50 MN/m, damping: 5 %}}\n"
         "links:\n  - {between: [left, right], " +
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
  refused(
      link("gap: 1 mm, law: kelvin_voigt, stiffness: 90 MN/m, damping_coefficient: 300 kN"),
      R"(5:101: links[0].damping_coefficient: takes a damping coefficient such as "200 kN s/m"; "300 kN" is a force)");
}

TEST(ContactInput, TakesTheTwoStiffnessesAndTheYieldOfABilinearContact) {
  const Model model =
      model_of(link("gap: 1 mm, law: bilinear_hertz, initial_stiffness: 1200 MN/m, secondary_stiffness: 150 MN/m, "
                    "yield_penetration: 0.9 mm"));
  EXPECT_EQ(model.links[0].parameters.size(), 3u);
  EXPECT_DOUBLE_EQ(parameter(model, "yield_penetration"), 9e-4);
  EXPECT_EQ(model.links[0].formula, "");
  refused(link("gap: 1 mm, law: bilinear_hertz, initial_stiffness: 1200 MN/m, yield_penetration: 0.9 mm"),
          "5:46: links[0].law: bilinear_hertz needs secondary_stiffness (stiffness K2 beyond the yield); type "
          "secondary_stiffness: "
          "1.5e+08 N/m");
  refused(link("gap: 1 mm, law: bilinear_hertz, stiffness: 2.75e9, initial_stiffness: 1200 MN/m, secondary_stiffness: "
               "150 MN/m, "
               "yield_penetration: 0.9 mm"),
          "5:73: links[0].stiffness: stiffness has no effect beside initial_stiffness; leave one of them out");
}

TEST(ContactInput, TakesAContactThatCrushes) {
  const Model model = model_of(link("gap: 1 mm, law: elastoplastic, stiffness: 2.75e9 N/m^1.5, restitution: 0.6"));
  EXPECT_DOUBLE_EQ(parameter(model, "indentation_ratio"), 1 - 0.36);
  refused(link("gap: 1 mm, law: elastoplastic, stiffness: 2.75e9, indentation_ratio: 1"),
          "5:99: links[0].indentation_ratio: indentation_ratio is 1, but must be in [0, 1)");
}

TEST(ContactInput, TakesAWallWithBackfill) {
  const std::string law = "gap: 1 mm, law: backfill, stiffness: 250 MN/m, failure_ratio: 0.75, strength: 6 MN";
  EXPECT_EQ(parameter(model_of(link(law + ", unloading: 500 MN/m")), "strength"), 6e6);
  refused(link(law),
          "5:46: links[0].law: backfill needs unloading (stiffness of unloading and reloading K_ur); type unloading: "
          "5e+08 N/m");
  refused(link(law + ", unloading: 200 MN/m"),
          "5:125: links[0].unloading: unloading is 2e+08, but must be finite and at least stiffness, 2.5e+08: flatter "
          "unloading would create energy");
  const std::string soil =
      "gap: 1 mm, law: backfill, unloading: 500 MN/m, failure_ratio: 0.75, strength: 6 MN, stiffness: ";
  for (const std::string estimate : {"auto", "{E: 30 GPa, radius: 2 m}"})
    refused(link(soil + estimate),
            "5:125: links[0].stiffness: is estimated from two solid bodies, and backfill presses soil; type stiffness: "
            "2.5e+08 N/m");
}

TEST(ContactInput, TakesZeroRestitutionWhereTheBodiesStick) {
  EXPECT_EQ(model_of(link("gap: 1 mm, law: stereomechanical, restitution: 0")).links[0].contact->restitution(), 0);
  EXPECT_EQ(
      parameter(model_of(link("gap: 1 mm, law: kelvin_voigt, stiffness: 90 MN/m, restitution: 0 %")), "damping_ratio"),
      1);
  refused(link("gap: 1 mm, law: jankowski, stiffness: 2.75e9, restitution: 0"),
          "5:89: links[0].restitution: restitution is 0, but must be in (0, 1]: no damping of this law stops the "
          "bodies; with "
          "stereomechanical and kelvin_voigt they stick at 0");
}

TEST(ContactInput, TakesAPreloadWithANegativeGap) {
  const Model model = model_of(link("gap: -2 mm, preload: true, law: linear_spring, stiffness: 93.5 MN/m"));
  EXPECT_EQ(model.links[0].gap, -2e-3);
  EXPECT_TRUE(model.links[0].preload);
  EXPECT_NE(resolved_yaml(model).find("preload: true"), std::string::npos);
  EXPECT_NE(describe(model).find("gap -2 mm, preloaded"), std::string::npos);
  EXPECT_FALSE(model_of(link("gap: 2 mm, preload: false, law: hertz, stiffness: 1e9")).links[0].preload);
  refused(link("gap: 2 mm, preload: true, law: hertz, stiffness: 1e9"),
          "5:41: links[0].preload: needs a negative gap, the overlap of the two ends undeformed, as in gap: -2 mm; "
          "leave it out");
  refused(link("gap: -2 mm, preload: true, law: hertz_damped, stiffness: 2.75e9, restitution: 0.5"),
          "5:51: links[0].preload: left-right: a contact that presses from the start has no closing speed to find its "
          "force by; give "
          "an impact_velocity, or a law that needs none, such as linear_spring or hertz");
}

}  // namespace contact_input_test
}  // namespace pounding
