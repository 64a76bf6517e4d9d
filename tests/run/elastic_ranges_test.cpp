// Steps in which every hinge stays in its elastic range, which results are told of by a short way.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "support/runs.hpp"
#include "support/without_range.hpp"

namespace pounding {
namespace elastic_ranges_test {

// Two frames, the left one under its weight. Shaken hard they collide, and hinges of the left one yield; those of the
// right one never do. `of_right`: a line of the right frame.
std::string pair(const std::string& amplitude, const std::string& analysis,
                 const std::string& law = "hertz_damped, stiffness: 1e9",
                 const std::string& of_right = "hinges: {beams: {at: both, yield_moment: 180 MN m, hardening: 2 %}}") {
  const std::string members =
      "storey_height: 3.2 m, bay_width: 6 m, columns: {rectangle: [0.4 m, 0.4 m]}, beams: {rectangle: [0.3 m, 0.5 m]}";
  return "ground_motion: {harmonic: {amplitude: " + amplitude +
         ", period: 0.5 s, duration: 1.5 s}}\n"
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
         "      " +
         of_right +
         "\n"
         "    damping: 5 %\n"
         "links: [{between: [left, right], floors: all, gap: 20 mm, law: " +
         law +
         ", restitution: 0.65}]\n"
         "analysis: {duration: 2.5 s, " +
         analysis + "}\n";
}

// Parts of the largest value.
void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  double largest = 0, error = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(b[i]));
    error = std::max(error, std::abs(a[i] - b[i]));
  }
  EXPECT_LE(error, tolerance * largest) << error / largest;
}

Model without_ranges(const std::string& text) {
  Model model = test::model_of(text);
  for (Structure& structure : model.structures)
    for (YieldingPart& part : structure.yielding)
      part.spring = std::make_unique<test::WithoutRange>(std::move(part.spring));
  return model;
}

// Returns how many hinges have yielded.
int compare(const std::string& text) {
  int yielded = 0;
  const Model model = test::model_of(text), slow = without_ranges(text);
  const Outcome a = run(model), b = run(slow);
  EXPECT_GT(a.summary.impacts.size(), 0u);
  EXPECT_EQ(a.results.energy.hysteretic, b.results.energy.hysteretic);
  EXPECT_EQ(a.results.energy.strain, b.results.energy.strain);
  EXPECT_EQ(a.results.energy.error, b.results.energy.error);
  for (std::size_t k = 0; k < 2; ++k) {
    const StructureHistory &x = a.results.structures[k], &y = b.results.structures[k];
    EXPECT_EQ(x.displacement, y.displacement);
    EXPECT_EQ(x.acceleration, y.acceleration);
    EXPECT_EQ(x.storey_shear, y.storey_shear);
    const SpringHistory &p = x.springs, &q = y.springs;
    for (const auto& [mine, other] :
         {std::pair(&p.hysteretic, &q.hysteretic), std::pair(&p.last, &q.last), std::pair(&p.lost, &q.lost),
          std::pair(&p.plastic, &q.plastic), std::pair(&p.cycles.turn, &q.cycles.turn),
          std::pair(&p.cycles.swings, &q.cycles.swings)})
      EXPECT_EQ(*mine, *other);
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_EQ(std::isnan(p.first_yield[i]), std::isnan(q.first_yield[i]));
      if (!std::isnan(p.first_yield[i])) {
        EXPECT_EQ(p.first_yield[i], q.first_yield[i]);
        ++yielded;
      }
    }
    for (const auto& [mine, other] : {std::pair(&x.envelope.member_force, &y.envelope.member_force),
                                      std::pair(&x.envelope.storey_shear, &y.envelope.storey_shear),
                                      std::pair(&x.envelope.reaction, &y.envelope.reaction)}) {
      EXPECT_EQ(mine->min, other->min);
      EXPECT_EQ(mine->max, other->max);
      EXPECT_EQ(mine->t_min, other->t_min);
      EXPECT_EQ(mine->t_max, other->t_max);
    }
    // Outputs are sums over modes one step earlier or later, which round differently. Extremes before anything yields
    // are taken between knots, whose cubics miss the motion by 1e-5 of the largest one; the long way takes those of
    // forces on parabolas.
    expect_near(p.deformation, q.deformation, 1e-13);
    expect_near(p.force, q.force, 1e-13);
    for (const auto& [mine, other] : {std::pair(&p.deformations, &q.deformations), std::pair(&p.forces, &q.forces)}) {
      expect_near(mine->min, other->min, 5e-5);
      expect_near(mine->max, other->max, 5e-5);
    }
  }
  return yielded;
}

TEST(ElasticRanges, ChangeNoBitOfTheResults) {
  for (const std::string scheme : {"tolerance: 1e-4", "tolerance: 1e-3, integrator: generalized_alpha"}) {
    EXPECT_GT(compare(pair("4.0", "output_step: 7 ms, " + scheme)), 4);
    // Nothing yields: most steps are told of by a bound, and those between outputs far apart bring nothing new.
    for (const std::string output : {"7 ms", "0.11 s", "2.5 s"})
      EXPECT_EQ(compare(pair("0.5", "output_step: " + output + ", " + scheme)), 0) << output;
  }
}

// A frame is pushed at once and rests before long; another one yields before, while or after the first one moves
// farthest.
TEST(ElasticRanges, KeepWhatIsBeforeTheFirstYield) {
  const std::string grid =
      "material: {E: 30 GPa}, grid: {storeys: 2, bays: 1, storey_height: 3.2 m, bay_width: 6 m, columns: {rectangle: "
      "[0.4 m, 0.4 m]}, "
      "beams: {rectangle: [0.3 m, 0.5 m]}, floor_mass: 40 t}";
  const auto pulse = [](double start) {
    return "forces: [{floor: 2, pulse: {shape: half_sine, amplitude: 400 kN, duration: 0.2 s, start: " +
           std::to_string(start) + "}}]";
  };
  for (double start = 0; start < 0.3; start += 0.012) {
    const std::string text =
        "structures:\n"
        "  a: {frame: {" +
        grid + ", hinges: {beams: {at: both, yield_moment: 180 MN m}}}, damping: 30 %, " + pulse(0) +
        "}\n"
        "  b: {frame: {" +
        grid + ", hinges: {beams: {at: both, yield_moment: 100 kN m}}}, damping: 5 %, " + pulse(start) +
        "}\n"
        "analysis: {duration: 1 s, output_step: 0.1 s}\n";
    const Model quick = test::model_of(text), slow = without_ranges(text);
    const Outcome x = run(quick), y = run(slow);
    EXPECT_GT(x.results.structures[1].springs.first_yield[0], start);
    for (std::size_t k = 0; k < 2; ++k) {
      const SpringHistory &p = x.results.structures[k].springs, &q = y.results.structures[k].springs;
      for (const auto& [mine, other] : {std::pair(&p.deformations, &q.deformations), std::pair(&p.forces, &q.forces)}) {
        expect_near(mine->min, other->min, 5e-5);
        expect_near(mine->max, other->max, 5e-5);
      }
    }
  }
}

// Frames that are looked at in every step: contacts change velocities in no time, members turn.
TEST(ElasticRanges, ChangeNoBitWhereEveryStepCounts) {
  for (const std::string amplitude : {"4.0", "0.5"}) {
    const bool yields = amplitude == "4.0";
    EXPECT_EQ(compare(pair(amplitude, "output_step: 7 ms, tolerance: 1e-4", "stereomechanical")) > 4, yields);
    EXPECT_EQ(compare(pair(amplitude, "output_step: 7 ms, tolerance: 1e-4", "hertz_damped, stiffness: 1e9",
                           "geometry: corotational")) > 4,
              yields);
  }
}

// A ground that moves to one side at first: the storey stays elastic in the strong direction where the weak one would
// have yielded.
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
