// Extremes of a run against its histories at outputs every 0.1 ms, against equilibrium, and against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <pounding/run/separation.hpp>
#include "support/book.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace envelopes_test {

constexpr double pi = std::numbers::pi;

// Two frames of different height with a row of storeys in contact, reporting members and reactions.
std::string frames(const std::string& links, const std::string& analysis, const std::string& left = "",
                   const std::string& right = "", const std::string& right_height = "3 m") {
  return fmt::format(
      "ground_motion: {{synthetic: {{seed: 1940, duration: 3 s, pga: 0.6 g, soil: firm}}}}\n"
      "structures:\n"
      "  left: {{frame: {{material: {{E: 30 GPa, density: 2500}}, grid: {{storeys: 3, bays: 2, storey_height: 3 m, "
      "bay_width: 5 m,\n"
      "    columns: {{rectangle: [0.4 m, 0.4 m]}}, beams: {{rectangle: [0.3 m, 0.5 m]}}, floor_mass: 90 t}}, report: "
      "{{members: all}}{}}},\n"
      "    damping: 5 %}}\n"
      "  right: {{frame: {{origin: [10.01 m, 0 m], material: {{E: 30 GPa, density: 2500}}, grid: {{storeys: 2, bays: "
      "1, storey_height: {}, bay_width: 5 m,\n"
      "    columns: {{rectangle: [0.5 m, 0.5 m]}}, beams: {{rectangle: [0.3 m, 0.6 m]}}, floor_mass: 60 t}}, report: "
      "{{members: all}}{}}},\n"
      "    damping: 5 %}}\n"
      "{}analysis: {{duration: 3{}}}\n",
      left, right_height, right, links, analysis);
}

const std::string facing =
    "links: [{between: [left, right], floors: all, gap: 10 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.6}]\n";

// Extremes of a history [time, quantity].
Extremes extremes_of(const std::vector<double>& history, const std::vector<double>& time, std::size_t count) {
  Extremes extremes(count);
  for (std::size_t t = 0; t < time.size(); ++t)
    for (std::size_t i = 0; i < count; ++i) extremes.update(i, time[t], history[t * count + i]);
  return extremes;
}

// Every extreme of the run agrees with the dense outputs within `relative` of the maximum absolute value of the
// quantity, or within 1e-6 of the overall maximum where that is round-off.
void expect_extremes(const Extremes& run, const std::vector<double>& history, const std::vector<double>& time,
                     double relative, const std::string& what) {
  ASSERT_GT(run.size(), 0u) << what;
  ASSERT_EQ(history.size(), run.size() * time.size()) << what;
  const Extremes dense = extremes_of(history, time, run.size());
  double all = 0;
  for (std::size_t i = 0; i < run.size(); ++i) all = std::max(all, dense.peak(i));
  ASSERT_GT(all, 0) << what;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double allowed = std::max(relative * dense.peak(i), 1e-6 * all);
    EXPECT_NEAR(run.min[i], dense.min[i], allowed) << what << " " << i << ", at " << dense.t_min[i] << " s";
    EXPECT_NEAR(run.max[i], dense.max[i], allowed) << what << " " << i << ", at " << dense.t_max[i] << " s";
  }
}

// Compares a run with default outputs and one with outputs every 0.1 ms.
void expect_extremes_of_dense_outputs(const std::function<std::string(const std::string& output_step)>& yaml,
                                      double relative) {
  const Outcome coarse = test::run_text(yaml("")), dense = test::run_text(yaml(", output_step: 0.1 ms"));
  const std::vector<double>& time = dense.results.time;
  ASSERT_GT(time.size(), 10 * coarse.results.time.size());
  EXPECT_GT(coarse.results.impacts.size(), 1u);
  for (std::size_t k = 0; k < dense.results.structures.size(); ++k) {
    const StructureHistory& history = dense.results.structures[k];
    const StructureEnvelope &envelope = coarse.results.structures[k].envelope, &same = history.envelope;
    expect_extremes(envelope.displacement, history.displacement, time, relative, history.name + ": displacement");
    // Accelerations vary much faster than forces within a contact; outputs every 0.1 ms resolve them to 1 %.
    expect_extremes(envelope.acceleration, history.acceleration, time, 1e-2, history.name + ": acceleration");
    expect_extremes(envelope.drift, history.drift, time, relative, history.name + ": drift");
    expect_extremes(envelope.storey_shear, history.storey_shear, time, relative, history.name + ": storey shear");
    if (envelope.members.empty()) continue;
    expect_extremes(envelope.member_force, history.end_forces, time, relative, history.name + ": member force");
    expect_extremes(envelope.reaction, history.reaction, time, relative, history.name + ": reaction");
    EXPECT_EQ(envelope.member_force.max, same.member_force.max) << "extremes do not depend on the outputs";
    EXPECT_EQ(envelope.reaction.t_min, same.reaction.t_min);
  }
}

// Velocity and acceleration jump at the end of a step: the next step begins with the values after the jump.
TEST(Envelopes, OfABodyThatBouncesAreThoseOfDenseOutputs) {
  const Outcome run = test::run_text(
      "structures: {ball: {oscillator: {mass: 100 t, period: 1 s, damping: 50 %}, initial_velocity: 1 m/s}, wall: "
      "{wall: {}}}\n"
      "links: [{between: [ball, wall], gap: 50 mm, law: stereomechanical, restitution: 0.8}]\n"
      "analysis: {duration: 3, output_step: 0.1 ms}\n");
  ASSERT_GT(run.results.impacts.size(), 0u);
  const StructureHistory& ball = run.results.structures[0];
  EXPECT_NEAR(ball.envelope.displacement.max[0], 0.05, 1e-12);
  expect_extremes(ball.envelope.acceleration, ball.acceleration, run.results.time, 1e-3, "acceleration");
}

TEST(Envelopes, OfAFramePairAreThoseOfDenseOutputs) {
  expect_extremes_of_dense_outputs([](const std::string& outputs) { return frames(facing, outputs); }, 1e-3);
}

TEST(Envelopes, OfFramesThatCarryTheirWeightAreThoseOfDenseOutputs) {
  expect_extremes_of_dense_outputs(
      [](const std::string& outputs) {
        return frames(facing, outputs, ", gravity: true, geometry: p_delta", ", gravity: true, geometry: p_delta");
      },
      1e-3);
}

TEST(Envelopes, OfMembersThatTurnAreThoseOfDenseOutputs) {
  expect_extremes_of_dense_outputs(
      [](const std::string& outputs) { return frames(facing, outputs, ", gravity: true, geometry: corotational"); },
      1e-3);
}

// A right frame with lower storeys hits the columns of the left one between their ends; the beams have these hinges.
std::string hit_columns(const std::string& outputs, const std::string& hinges = "") {
  const std::string hit =
      "links: [{between: [left, right], floors: any, level_within: 50 mm, gap: 10 mm, law: hertz_damped, stiffness: "
      "1e8, restitution: 0.6}]\n";
  return frames(hit, outputs, ", mass: consistent" + hinges, ", mass: consistent" + hinges, "2.4 m");
}

TEST(Envelopes, OfAColumnThatIsHitBetweenItsEndsAreThoseOfDenseOutputs) {
  expect_extremes_of_dense_outputs([](const std::string& outputs) { return hit_columns(outputs); }, 1e-3);
}

TEST(Envelopes, OfHitColumnsBesideHingesThatYieldAreThoseOfDenseOutputs) {
  const auto yaml = [](const std::string& outputs) {
    return hit_columns(outputs, ", hinges: {beams: {at: both, yield_moment: 300 kN m, hardening: 2 %}}");
  };
  const Outcome run = test::run_text(yaml(""));
  double lost = 0;
  for (const StructureHistory& structure : run.results.structures)
    for (const double each : structure.springs.lost) lost += each;
  EXPECT_GT(lost, 1e3);
  expect_extremes_of_dense_outputs(yaml, 1e-3);
}

TEST(Envelopes, OfHitColumnsAreTheSameBesideHingesThatNeverYield) {
  const Outcome without = test::run_text(hit_columns("")),
                never = test::run_text(
                    hit_columns("", ", hinges: {beams: {at: both, yield_moment: 1e12, hardening: 2 %}}"));
  ASSERT_GT(never.results.impacts.size(), 1u);
  for (int k = 0; k < 2; ++k) {
    const StructureEnvelope &a = never.results.structures[k].envelope, &b = without.results.structures[k].envelope;
    ASSERT_FALSE(never.results.structures[k].springs.names.empty());
    for (const auto& [mine, other] :
         {std::pair(&a.member_force, &b.member_force), std::pair(&a.storey_shear, &b.storey_shear),
          std::pair(&a.reaction, &b.reaction)}) {
      ASSERT_GT(mine->size(), 0u);
      EXPECT_EQ(mine->min, other->min);
      EXPECT_EQ(mine->max, other->max);
      EXPECT_EQ(mine->t_min, other->t_min);
      EXPECT_EQ(mine->t_max, other->t_max);
    }
  }
}

TEST(Envelopes, AfterRigidImpactsAreThoseOfDenseOutputs) {
  const std::string rigid =
      "links: [{between: [left, right], floors: all, gap: 10 mm, law: stereomechanical, restitution: 0.6}]\n";
  const auto yaml = [&](const std::string& outputs) { return frames(rigid, outputs); };
  const Outcome coarse = test::run_text(yaml("")), dense = test::run_text(yaml(", output_step: 0.1 ms"));
  ASSERT_GT(coarse.results.impacts.size(), 1u);
  for (int k = 0; k < 2; ++k)
    expect_extremes(coarse.results.structures[k].envelope.member_force, dense.results.structures[k].end_forces,
                    dense.results.time, 1e-3, "member force");
}

TEST(Envelopes, OfStoreysThatYieldAreThoseOfDenseOutputs) {
  expect_extremes_of_dense_outputs(
      [](const std::string& outputs) {
        return "ground_motion: {synthetic: {seed: 7, duration: 4 s, step: 0.02, pga: 0.4 g}}\n"
               "structures:\n"
               "  left: {shear_building: {storeys: 3, mass: 250 t, stiffness: 5e5 kN/m, yield_force: 1500 kN, "
               "hardening: 0.05}, damping: 5 %}\n"
               "  right: {shear_building: {storeys: 3, mass: 150 t, stiffness: 9e5 kN/m}, damping: 3 %}\n"
               "links: [{between: [left, right], floors: all, gap: 5 mm, law: jankowski, stiffness: 2.75e9, "
               "restitution: 0.65}]\n"
               "analysis: {duration: 4" +
               outputs + "}\n";
      },
      1e-3);
}

TEST(Envelopes, WithFeetThatMoveDifferentlyAreThoseOfDenseOutputs) {
  expect_extremes_of_dense_outputs(
      [](const std::string& outputs) {
        return frames(
            facing, outputs,
            ", supports: {\"0.0\": fixed, \"0.1\": {fix: fixed, delay: 20 ms}, \"0.2\": {fix: fixed, delay: 40 ms}}");
      },
      1e-3);
}

TEST(Envelopes, InSpaceAreThoseOfDenseOutputs) {
  expect_extremes_of_dense_outputs(
      [](const std::string& outputs) {
        return "ground_motion: {components: {x: {harmonic: {amplitude: 4, period: 0.5, duration: 1.2}}, y: {harmonic: "
               "{amplitude: 2, period: 0.3, duration: 1.2}}}}\n"
               "structures:\n"
               "  a: {frame: {material: {E: 30 GPa, poisson: 0.2}, grid: {storeys: 1, bays: [1, 1], storey_height: 3 "
               "m, bay_width: {x: 6 m, y: 4 m},\n"
               "    columns: {circle: 0.25}, beams: {circle: 0.5}, floor_mass: 40 t}, report: {members: all}}, "
               "damping: 5 %}\n"
               "  b: {frame: {origin: [6.01, 1], material: {E: 30 GPa, poisson: 0.2}, grid: {storeys: 1, bays: [1, 1], "
               "storey_height: 3 m, bay_width: {x: 6 m, y: 4 m},\n"
               "    columns: {circle: 0.35}, beams: {circle: 0.5}, floor_mass: 60 t}, report: {members: all}}, "
               "damping: 5 %}\n"
               "links: [{between: [a, b], gap: 10 mm, law: hertz_damped, stiffness: 1e9, restitution: 0.6}]\n"
               "analysis: {duration: 1.2" +
               outputs + "}\n";
      },
      1e-3);
}

// Sum of the reactions of a structure in one direction at each output time.
std::vector<double> sum_of_reactions(const StructureHistory& history, std::size_t direction) {
  const std::size_t directions = history.envelope.directions.size(), supports = history.envelope.supports.size();
  std::vector<double> sums(history.reaction.size() / (directions * supports), 0.0);
  for (std::size_t t = 0; t < sums.size(); ++t)
    for (std::size_t i = 0; i < supports; ++i) sums[t] += history.reaction[(t * supports + i) * directions + direction];
  return sums;
}

TEST(Reactions, HoldTheLowestStoreyAndTheWeight) {
  const Outcome run = test::run_text(frames("", "", ", gravity: true"));
  const StructureHistory& left = run.results.structures[0];
  EXPECT_EQ(left.envelope.supports, (std::vector<std::string>{"0.0", "0.1", "0.2"}));
  EXPECT_EQ(left.envelope.directions, (std::vector<std::string>{"x", "z", "ry"}));
  const std::vector<double> along = sum_of_reactions(left, 0), up = sum_of_reactions(left, 1);
  double largest = 0;
  for (std::size_t t = 0; t < along.size(); ++t) {
    EXPECT_NEAR(along[t], -left.storey_shear[3 * t], 1e-6 * 1e6) << "the shear on the floor has the opposite sign";
    largest = std::max(largest, std::abs(along[t]));
  }
  EXPECT_GT(largest, 1e5);
  // At rest: three floors of 90 t, columns of 9 m x 3 and beams of 10 m x 3, including the lumped halves at the feet.
  const double weight = 9.80665 * (3 * 90e3 + 2500 * (0.16 * 27 + 0.15 * 30));
  EXPECT_NEAR(up.front(), weight, 1e-9 * weight);
}

// A single column ends at each foot.
TEST(Reactions, HoldTheColumnThatIsHitBetweenItsEnds) {
  const std::string hit =
      "links: [{between: [left, right], floors: any, level_within: 50 mm, gap: 10 mm, law: hertz_damped, stiffness: "
      "1e8, restitution: 0.6}]\n";
  const Outcome run = test::run_text(frames(hit, "", ", mass: consistent", ", mass: consistent", "1.2 m"));
  ASSERT_GT(run.results.impacts.size(), 1u);
  const StructureHistory& left = run.results.structures[0];
  const StructureEnvelope& envelope = left.envelope;
  const std::size_t members = envelope.members.size(), components = envelope.components.size();
  for (std::size_t foot = 0; foot < 3; ++foot) {
    const auto column = std::find(envelope.members.begin(), envelope.members.end(), fmt::format("column 1.{}", foot)) -
                        envelope.members.begin();
    for (std::size_t t = 0; t < run.results.time.size(); ++t) {
      const double shear = left.end_forces[(t * members + column) * components + 1],
                   reaction = left.reaction[(t * 3 + foot) * 3];
      EXPECT_NEAR(std::abs(shear), std::abs(reaction), 1e-6) << foot << ", output " << t;
    }
    const std::size_t of_column = column * components + 1, of_foot = foot * 3;
    EXPECT_NEAR(envelope.member_force.peak(of_column), envelope.reaction.peak(of_foot), 1e-6) << foot;
  }
}

TEST(Reactions, OfASpringToTheGroundPushAgainstTheDisplacement) {
  const Outcome run = test::run_text(
      "ground_motion: {harmonic: {amplitude: 2, period: 0.5, duration: 1}}\n"
      "structures:\n"
      "  a: {frame: {material: {E: 30 GPa}, sections: {s: {area: 0.2, inertia_y: 1e-3}},\n"
      "    nodes: {foot: [0, 0], top: [0, 3]}, members: {c: {between: [foot, top], section: s}},\n"
      "    supports: {foot: fixed}, springs: [{node: top, dof: ux, stiffness: 2e6}], masses: {top: 20 t}, floors: "
      "[{nodes: [top]}]}, damping: 2 %}\n"
      "analysis: {duration: 1}\n");
  const StructureHistory& a = run.results.structures[0];
  ASSERT_EQ(a.envelope.supports, (std::vector<std::string>{"foot", "top"}));
  for (std::size_t t = 0; t < run.results.time.size(); ++t)
    EXPECT_NEAR(a.reaction[6 * t + 3], -2e6 * a.displacement[t], 1e-6) << t;
}

TEST(Separation, ThatIsEnoughIsTheLargestApproachOfTheRunWithoutLinks) {
  const auto yaml = [](const std::string& more) {
    return "ground_motion: {synthetic: {seed: 3, duration: 5 s, pga: 0.4 g}}\n"
           "structures:\n"
           "  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n"
           "  right: {oscillator: {mass: 150 t, period: 0.4, damping: 2 %}}\n"
           "  wall: {wall: {}}\n" +
           more;
  };
  const std::string links =
      "links:\n  - {between: [left, right], gap: 20 mm, law: hertz, stiffness: 1e9}\n"
      "  - {between: [right, wall], gap: 30 mm, law: hertz, stiffness: 1e9}\n";
  const Summary compared = test::run_text(yaml(links + "compare: no_pounding\nanalysis: {duration: 5}\n")).summary;
  const Outcome apart = test::run_text(yaml("analysis: {duration: 5, output_step: 0.1 ms}\n"));
  const std::vector<double>&u = apart.results.structures[0].displacement, &v = apart.results.structures[1].displacement;
  double approach = 0, ua = 0, ub = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    approach = std::max(approach, u[i] - v[i]);
    ua = std::max(ua, std::abs(u[i]));
    ub = std::max(ub, std::abs(v[i]));
  }
  ASSERT_EQ(compared.separations.size(), 2u);
  const LinkSeparation &pair = compared.separations[0], &wall = compared.separations[1];
  EXPECT_EQ(pair.link, "left-right");
  EXPECT_EQ(pair.gap, 0.02);
  // Two runs at tolerance 1e-4 with different steps.
  EXPECT_NEAR(pair.enough, approach, 1e-3 * approach);
  EXPECT_NEAR(pair.left, ua, 1e-3 * ua);
  EXPECT_NEAR(pair.right, ub, 1e-3 * ub);
  EXPECT_EQ(pair.absolute_sum, pair.left + pair.right);
  EXPECT_NEAR(pair.srss, std::hypot(ua, ub), 1e-3 * ua);
  const double rho = double_difference(0.8, 0.05, 0.4, 0.02);
  EXPECT_NEAR(pair.ddc, std::sqrt(ua * ua + ub * ub - 2 * rho * ua * ub), 1e-3 * ua);
  EXPECT_NEAR(wall.enough, *std::max_element(v.begin(), v.end()), 1e-3 * ub);
  EXPECT_EQ(wall.right, 0);
  EXPECT_NEAR(wall.ddc, ub, 1e-3 * ub) << "the wall moves with the ground";
  EXPECT_TRUE(test::run_text(yaml(links + "analysis: {duration: 1}\n")).summary.separations.empty());
}

// Correlation of two oscillators under white noise, integrated over all frequencies.
double correlation(double period_a, double damping_a, double period_b, double damping_b) {
  const auto response = [](double w, double period, double damping) {
    const double natural = 2 * pi / period;
    return 1.0 / std::complex<double>(natural * natural - w * w, 2 * damping * natural * w);
  };
  double both = 0, of_a = 0, of_b = 0;
  constexpr double step = 2e-3;
  for (double w = 0.5 * step; w < 4000; w += step) {
    const std::complex<double> a = response(w, period_a, damping_a), b = response(w, period_b, damping_b);
    both += (a * std::conj(b)).real();
    of_a += std::norm(a);
    of_b += std::norm(b);
  }
  return both / std::sqrt(of_a * of_b);
}

TEST(Separation, CombinesByTheCorrelationUnderWhiteNoise) {
  test::Book book("Sufficient gap",
                  "the correlation of two oscillators under white noise, integrated over the frequency",
                  "the midpoint rule up to 4000 rad/s in steps of 2e-3");
  struct Pair {
    double period_a, damping_a, period_b, damping_b;
  };
  for (const Pair& p :
       {Pair{0.8, 0.05, 0.4, 0.05}, Pair{1.0, 0.05, 0.9, 0.02}, Pair{0.5, 0.1, 0.55, 0.05}, Pair{0.4, 0.02, 1.2, 0.1}})
    book.near(
        fmt::format("correlation, {:g} s {:g} and {:g} s {:g} [-]", p.period_a, p.damping_a, p.period_b, p.damping_b),
        double_difference(p.period_a, p.damping_a, p.period_b, p.damping_b),
        correlation(p.period_a, p.damping_a, p.period_b, p.damping_b), 1e-5);
  EXPECT_NEAR(double_difference(0.7, 0.05, 0.7, 0.05), 1, 1e-15) << "equal structures move together";
  EXPECT_TRUE(std::isnan(double_difference(std::numeric_limits<double>::infinity(), 0.05, 0.7, 0.05)));
}

}  // namespace envelopes_test
}  // namespace pounding
