// A run does not change its model: repeated runs have the same bits.

#include <gtest/gtest.h>

#include <string>

#include "support/runs.hpp"

namespace pounding {
namespace repeated_runs_test {

struct Case {
  const char* name;
  std::string yaml;
};

class Repeated : public testing::TestWithParam<Case> {};

TEST_P(Repeated, RunsHaveTheSameBits) {
  const Model model = test::model_of(GetParam().yaml);
  const Outcome first = run(model), second = run(model);
  ASSERT_GT(first.summary.impacts.size(), 0u);
  ASSERT_EQ(first.summary.impacts.size(), second.summary.impacts.size());
  EXPECT_EQ(first.results.impacts.size(), second.results.impacts.size());
  EXPECT_EQ(first.results.solver.steps, second.results.solver.steps);
  for (std::size_t k = 0; k < first.results.structures.size(); ++k) {
    EXPECT_EQ(first.results.structures[k].displacement, second.results.structures[k].displacement);
    EXPECT_EQ(first.results.structures[k].springs.hysteretic, second.results.structures[k].springs.hysteretic);
  }
  for (std::size_t i = 0; i < first.results.links.size(); ++i)
    EXPECT_EQ(first.results.links[i].force, second.results.links[i].force);
  EXPECT_EQ(first.summary.energy.hysteretic, second.summary.energy.hysteretic);
  EXPECT_EQ(first.summary.energy.impact, second.summary.energy.impact);
}

constexpr const char* ground = "ground_motion: {harmonic: {amplitude: 5, period: 0.5 s, duration: 2 s}}\n";

INSTANTIATE_TEST_SUITE_P(
    Models, Repeated,
    testing::Values(
        Case{"WithAnIndentation", std::string(ground) +
                                      "structures:\n  a: {oscillator: {mass: 100 t, period: 0.8}, damping: 5 %}\n"
                                      "  b: {oscillator: {mass: 150 t, period: 0.4}, damping: 5 %}\n"
                                      "links: [{between: [a, b], gap: 10 mm, law: komodromos, stiffness: 90 MN/m, "
                                      "restitution: 0.6}]\nanalysis: {duration: 3}\ncompare: no_pounding\n"},
        Case{"ThatYield",
             std::string(ground) +
                 "structures:\n  a: {oscillator: {mass: 100 t, period: 0.8, yield_force: 400 kN}, damping: "
                 "5 %}\n  b: {oscillator: {mass: 150 t, period: 0.4}, damping: 5 %}\n"
                 "links: [{between: [a, b], gap: 1 mm, law: stereomechanical, restitution: 0.6}]\n"
                 "analysis: {duration: 3}\n"},
        Case{"PressedAtTheStart", std::string(ground) +
                                      "structures:\n  a: {oscillator: {mass: 100 t, period: 0.8}, damping: 5 %}\n"
                                      "  b: {oscillator: {mass: 150 t, period: 0.4}, damping: 5 %}\n"
                                      "links: [{between: [a, b], gap: -2 mm, preload: true, law: hertz, stiffness: "
                                      "2.75e9}]\ndevices:\n  tie: {between: [a, b], bar: {stiffness: 5 MN/m}, damper: "
                                      "{coefficient: 200 kN s/m}}\n"
                                      "analysis: {duration: 3}\n"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace repeated_runs_test
}  // namespace pounding
