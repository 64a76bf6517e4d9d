// Frames whose hinges soften under gravity before they yield: the initial state of the run.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>

#include "support/runs.hpp"

namespace pounding {
namespace rest_test {

constexpr const char* schemes[] = {"esdirk4", "generalized_alpha"};

// A beam of 6 m between two walls under 10 kN/m, qL^2/12 = 30 kN m. Both ends rotate by t in their hinges: the moment
// of the law is qL^2/12 - 2EI t/L, and the deflection at midspan qL^4/(384 EI) + t L/8.
TEST(FramesAtRest, GiveWayAsTheLawsOfTheirHingesSay) {
  constexpr double length = 6, load = 10e3, bending = 30e9 * 0.4 * 0.4 * 0.4 * 0.4 / 12,
                   fixed = load * length * length / 12;
  const std::vector<std::pair<std::string, hysteresis::Settings>> laws{
      {"bouc_wen: {yield_moment: 17 kN m, spring_hardening: 0.02, stiffness: 20 MN m, exponent: 2}",
       {.law = "bouc_wen",
        .values = {{"yield_force", 17e3}, {"hardening", 0.02}, {"stiffness", 20e6}, {"exponent", 2}}}},
      {"menegotto_pinto: {yield_moment: 15 kN m, spring_hardening: 0.02, stiffness: 20 MN m, R0: 14}",
       {.law = "menegotto_pinto",
        .values = {{"yield_force", 15e3}, {"hardening", 0.02}, {"stiffness", 20e6}, {"R0", 14}}}}};
  for (const auto& [words, settings] : laws) {
    const double turn = std::visit(
        []<class L>(const L& law) {
          const auto moment = [&](double t) { return law.respond({}, t).force; };
          double low = 0, high = fixed * length / (2 * bending);
          for (int i = 0; i < 200; ++i) {
            const double middle = 0.5 * (low + high);
            (moment(middle) < fixed - 2 * bending * middle / length ? low : high) = middle;
          }
          return low;
        },
        hysteresis::make_law(settings));
    const double moment = fixed - 2 * bending * turn / length;
    ASSERT_GT(20e6 * turn, 1.02 * moment) << "the law must be nonlinear at rest";
    for (const char* scheme : schemes) {
      const Outcome run = test::run_text(fmt::format(
          "structures:\n  beam:\n    frame:\n      material: {{E: 30 GPa}}\n      nodes: {{l: [0, 0], m: [3 m, 0], r: "
          "[6 m, 0]}}\n"
          "      members:\n"
          "        one: {{between: [l, m], section: {{rectangle: [0.4, 0.4], shear: false}}, load: [0, -10 kN/m]}}\n"
          "        two: {{between: [m, r], section: {{rectangle: [0.4, 0.4], shear: false}}, load: [0, -10 kN/m]}}\n"
          "      masses: {{m: 10 t}}\n      supports: {{l: fixed, r: fixed}}\n"
          "      hinges: {{one: {{at: start, {0}}}, two: {{at: end, {0}}}}}\n      gravity: false\n    damping: 0\n"
          "analysis: {{duration: 0.5 s, tolerance: 1e-6, output_step: 10 ms, integrator: {1}}}\n",
          words, scheme));
      const SpringHistory& hinges = run.results.structures[0].springs;
      ASSERT_EQ(hinges.size(), 2u);
      for (std::size_t i = 0; i < hinges.force.size(); ++i) {
        ASSERT_NEAR(std::abs(hinges.force[i]), moment, 1e-9 * moment)
            << words << ", " << scheme << ", output " << i / 2;
        ASSERT_NEAR(std::abs(hinges.deformation[i]), turn, 1e-9 * turn);
      }
      EXPECT_NEAR(run.summary.energy.hysteretic, 0, 1e-9) << "no motion";
    }
  }
}

// A frame with all elements that deform under gravity. Without excitation it stays at rest, and a device that is
// installed afterwards stays without force.
TEST(FramesAtRest, StayThere) {
  for (const char* law : {"bouc_wen: {yield_moment: 120 kN m, hardening: 0.02, stiffness_factor: 10, exponent: 1.5}",
                          "menegotto_pinto: {yield_moment: 120 kN m, hardening: 0.02, stiffness_factor: 10, R0: 14}",
                          "bilinear: {yield_moment: 120 kN m, hardening: 0.02}"})
    for (const char* scheme : schemes) {
      const Outcome run = test::run_text(fmt::format(
          "structures:\n  a:\n    frame:\n      material: {{E: 30 GPa, density: 2500 kg/m^3}}\n      gravity: true\n"
          "      grid: {{storeys: 2, bays: 2, storey_height: 3.2 m, bay_width: [5 m, 7 m], columns: {{rectangle: [0.4, "
          "0.4]}}, "
          "beams: {{rectangle: [0.3, 0.5]}}, floor_mass: 40 t}}\n"
          "      members: {{beams: {{load: [0, -20 kN/m]}}}}\n"
          "      hinges: {{beams: {{at: both, {0}}}, columns: {{at: feet, {0}}}}}\n"
          "      devices: {{brace: {{between: [\"0.0\", \"1.1\"], bilinear: {{stiffness: 80 MN/m, yield_force: 600 kN, "
          "hardening: 0.02}}}}}}\n"
          "    damping: 5 %\n"
          "analysis: {{duration: 0.5 s, tolerance: 1e-6, output_step: 10 ms, integrator: {1}}}\n",
          law, scheme));
      const StructureHistory& a = run.results.structures[0];
      const auto largest = [](const std::vector<double>& values) {
        double maximum = 0;
        for (const double value : values) maximum = std::max(maximum, std::abs(value));
        return maximum;
      };
      const SpringHistory& hinges = a.springs;
      const double moment = largest(hinges.force);
      EXPECT_GT(moment, 20e3);
      EXPECT_LT(largest(a.velocity), 1e-9) << law << ", " << scheme;
      EXPECT_LT(largest(a.acceleration), 1e-7);
      for (std::size_t i = hinges.size(); i < hinges.force.size(); ++i)
        ASSERT_NEAR(hinges.force[i], hinges.force[i % hinges.size()], 1e-8 * moment) << law << ", " << scheme;
    }
}

}  // namespace rest_test
}  // namespace pounding
