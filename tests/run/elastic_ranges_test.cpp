// Steps in which every hinge stays in its elastic range, for which the recorder has a fast path.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "support/runs.hpp"
#include "support/without_range.hpp"

namespace pounding {
namespace elastic_ranges_test {

// Two colliding frames, the left one under its weight; its hinges yield, those of the right one never do.
std::string pair(const std::string& analysis) {
  const std::string members =
      "storey_height: 3.2 m, bay_width: 6 m, columns: {rectangle: [0.4 m, 0.4 m]}, beams: {rectangle: [0.3 m, 0.5 m]}";
  return "ground_motion: {harmonic: {amplitude: 4.0, period: 0.5 s, duration: 1.5 s}}\n"
         "structures:\n"
         "  left:\n"
         "    frame:\n"
         "      material: {E: 30 GPa, density: 2500 kg/m^3}\n"
         "      gravity: true\n"
         "      grid: {storeys: 3, bays: 1, " +
         members +
         ", floor_mass: 40 t}\n"
         "      hinges: {beams: {at: both, yield_moment: 180 kN m, hardening: 2 %}, columns: {at: feet, yield_moment: "
         "250 kN m, hardening: 2 %}}\n"
         "    damping: 5 %\n"
         "  right:\n"
         "    frame:\n"
         "      material: {E: 30 GPa}\n"
         "      origin: [6.02, 0]\n"
         "      grid: {storeys: 2, bays: 1, " +
         members +
         ", floor_mass: 40 t}\n"
         "      hinges: {beams: {at: both, yield_moment: 180 MN m, hardening: 2 %}}\n"
         "    damping: 5 %\n"
         "links: [{between: [left, right], floors: all, gap: 20 mm, law: hertz_damped, stiffness: 1e9, restitution: "
         "0.65}]\n"
         "analysis: {duration: 2.5 s, output_step: 7 ms, " +
         analysis + "}\n";
}

TEST(ElasticRanges, ChangeNoBitOfTheResults) {
  for (const char* analysis : {"tolerance: 1e-4", "tolerance: 1e-3, integrator: generalized_alpha"}) {
    const Model model = test::model_of(pair(analysis));
    Model slow = test::model_of(pair(analysis));
    for (Structure& structure : slow.structures)
      for (YieldingPart& part : structure.yielding)
        part.element = std::make_shared<const test::WithoutRange>(std::move(part.element));
    const Outcome a = run(model), b = run(slow);
    ASSERT_GT(a.summary.impacts.size(), 0u);
    EXPECT_EQ(a.results.energy.hysteretic, b.results.energy.hysteretic);
    EXPECT_EQ(a.results.energy.strain, b.results.energy.strain);
    EXPECT_EQ(a.results.energy.error, b.results.energy.error);
    int yielded = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const StructureHistory &x = a.results.structures[k], &y = b.results.structures[k];
      EXPECT_EQ(x.displacement, y.displacement);
      EXPECT_EQ(x.acceleration, y.acceleration);
      EXPECT_EQ(x.storey_shear, y.storey_shear);
      const SpringHistory &p = x.springs, &q = y.springs;
      EXPECT_EQ(p.deformation, q.deformation);
      EXPECT_EQ(p.force, q.force);
      EXPECT_EQ(p.hysteretic, q.hysteretic);
      EXPECT_EQ(p.last, q.last);
      EXPECT_EQ(p.lost, q.lost);
      EXPECT_EQ(p.plastic, q.plastic);
      EXPECT_EQ(p.cycles.turn, q.cycles.turn);
      EXPECT_EQ(p.cycles.swings, q.cycles.swings);
      for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_EQ(std::isnan(p.first_yield[i]), std::isnan(q.first_yield[i]));
        if (!std::isnan(p.first_yield[i])) {
          EXPECT_EQ(p.first_yield[i], q.first_yield[i]);
          ++yielded;
        }
      }
      for (const auto& [mine, other] : {std::pair(&p.deformations, &q.deformations), std::pair(&p.forces, &q.forces),
                                        std::pair(&x.envelope.member_force, &y.envelope.member_force),
                                        std::pair(&x.envelope.storey_shear, &y.envelope.storey_shear),
                                        std::pair(&x.envelope.reaction, &y.envelope.reaction)}) {
        EXPECT_EQ(mine->min, other->min);
        EXPECT_EQ(mine->max, other->max);
        EXPECT_EQ(mine->t_min, other->t_min);
        EXPECT_EQ(mine->t_max, other->t_max);
      }
    }
    EXPECT_GT(yielded, 4);
  }
}

// A ground that first moves to one side: the storey stays elastic in the strong direction beyond the limit of the weak
// one.
TEST(YieldLimits, AreThoseOfTheDirection) {
  const Outcome run = test::run_text(
      "ground_motion: {harmonic: {amplitude: -2, period: 0.5, duration: 2}}\n"
      "structures:\n  a: {oscillator: {mass: 100 t, stiffness: 20 MN/m, spring: {bilinear: {yield_force: 400 kN, "
      "negative_yield_force: 100 kN, hardening: 0.05}}}, "
      "damping: 5 %}\nanalysis: {duration: 2, output_step: 1e-3, tolerance: 1e-6}\n");
  const SpringHistory& history = run.results.structures[0].springs;
  const SpringSummary& storey = run.summary.structures[0].springs[0];
  const double lowest = history.deformations.min[0], highest = history.deformations.max[0];
  EXPECT_LT(lowest, -0.02);
  EXPECT_GT(highest, 0.005);
  EXPECT_NEAR(storey.ductility, std::max(-lowest / 0.005, highest / 0.02), 1e-12);
  std::size_t first = 0;
  while (history.deformation[first] > -0.005 && history.deformation[first] < 0.02) ++first;
  EXPECT_NEAR(storey.first_yield, run.results.time[first], 1.01e-3);
}

}  // namespace elastic_ranges_test
}  // namespace pounding
