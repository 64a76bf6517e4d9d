// Contacts that a fixed step would miss, or that would make an integrator stumble.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "support/runs.hpp"

namespace pounding {
namespace {

using test::run_text;

// 10 kg at 20 m/s on a stiff wall: the contact lasts a hundredth of the first free step.
TEST(ShortContact, IsFoundByAStepMuchLongerThanIt) {
  const Outcome run = run_text("structures:\n  a: {body: {mass: 10 kg}, initial_velocity: 20 m/s}\n  w: {wall: {}}\n"
                               "links: [{between: [a, w], gap: 10 m, law: linear_spring, stiffness: 1e9}]\n"
                               "analysis: {duration: 1, tolerance: 1e-6}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  EXPECT_NEAR(run.results.impacts[0].t_start, 0.5, 1e-12);
  EXPECT_NEAR(run.results.impacts[0].t_end - run.results.impacts[0].t_start, M_PI * std::sqrt(10.0 / 1e9), 1e-9);
  EXPECT_NEAR(run.results.impacts[0].peak_force, 20 * std::sqrt(1e9 * 10.0), 1e-5 * 2e6);
}

// An undamped oscillator whose amplitude is the gap and a little more, or a little less.
Outcome grazing(double excess) {
  const double w = 2 * M_PI / 0.5;
  return run_text("structures:\n  a: {oscillator: {mass: 100 t, period: 0.5, damping: 0}, initial_velocity: " +
                  fmt::format("{}", w * 0.02) + "}\n  w: {wall: {}}\nlinks: [{between: [a, w], gap: " +
                  fmt::format("{}", 0.02 * (1 - excess)) +
                  ", law: hertz, stiffness: 2.75e9}]\nanalysis: {duration: 0.4, tolerance: 1e-6}\n");
}

TEST(Grazing, TouchesOnceWhenTheGapIsAHairTooSmall) {
  const Outcome run = grazing(1e-4);
  ASSERT_EQ(run.results.impacts.size(), 1u);
  // u = U sin(w t) reaches (1 - 1e-4) U at speed w U sqrt(2e-4).
  EXPECT_NEAR(run.results.impacts[0].v_approach, 2 * M_PI / 0.5 * 0.02 * std::sqrt(2e-4), 2e-3 * 0.0036);
  EXPECT_NEAR(run.results.impacts[0].restitution, 1, 1e-3);
}

TEST(Grazing, DoesNotTouchWhenTheGapIsAHairTooLarge) { EXPECT_TRUE(grazing(-1e-4).results.impacts.empty()); }

// A rigid ball that a constant ground acceleration presses on a wall bounces ever lower: with e = 0.5 and a = 2 m/s^2 from
// rest 10 mm away the touch comes at t1 = sqrt(2 g/a) at v1 = a t1, and all bounces end at t1 + 2 (v1/a) e/(1 - e) = 3 t1.
TEST(RestingContact, FollowsInfinitelyManyBounces) {
  const Outcome run = run_text("ground_motion: {pulse: {shape: rectangle, amplitude: -2.0, duration: 2 s}}\n"
                               "structures:\n  a: {body: {mass: 100 t}}\n  w: {wall: {}}\n"
                               "links: [{between: [a, w], gap: 10 mm, law: stereomechanical, restitution: 0.5}]\n"
                               "analysis: {duration: 2, tolerance: 1e-5}\n");
  const double t1 = std::sqrt(2 * 0.01 / 2.0);
  ASSERT_GT(run.results.impacts.size(), 5u);
  ASSERT_LT(run.results.impacts.size(), 40u);
  EXPECT_NEAR(run.results.impacts[0].t_start, t1, 1e-9);
  EXPECT_NEAR(run.results.impacts.back().t_start, 3 * t1, 1e-4);
  EXPECT_NEAR(run.results.structures[0].displacement.back(), 0.01, 1e-8);
  EXPECT_NEAR(run.results.structures[0].velocity.back(), 0, 1e-9);
  double impulse = 0;
  for (const ImpactRow& row : run.results.impacts) impulse += row.impulse;
  EXPECT_NEAR(impulse, 1e5 * 2.0 * 2.0, 1e-3 * 4e5) << "the wall took all the momentum of the ground";
}

TEST(RestingContact, OpensWhenTheGroundTurns) {
  const Outcome run = run_text("ground_motion: {pulse: {shape: sine, amplitude: -2.0, duration: 2 s}}\n"
                               "structures:\n  a: {body: {mass: 100 t}}\n  w: {wall: {}}\n"
                               "links: [{between: [a, w], gap: 0, law: stereomechanical, restitution: 0.5}]\n"
                               "analysis: {duration: 2, tolerance: 1e-6}\n");
  // Pressed for the first second, then free: v(2) = -integral of 2 sin(pi t) from 1 to 2 ... = -4/pi.
  EXPECT_NEAR(run.results.structures[0].velocity.back(), -4 / M_PI, 1e-5);
  EXPECT_NEAR(run.results.impacts.back().t_end, 1.0, 1e-5);
}

// A compliant contact settles at the penetration that carries the push.
TEST(RestingContact, SettlesAtTheStaticPenetration) {
  const Outcome run = run_text("ground_motion: {pulse: {shape: rectangle, amplitude: -2.0, duration: 5 s}}\n"
                               "structures:\n  a: {body: {mass: 100 t}}\n  w: {wall: {}}\n"
                               "links: [{between: [a, w], gap: 0, law: kelvin_voigt_no_tension, stiffness: 50 MN/m, "
                               "restitution: 0.3}]\nanalysis: {duration: 5}\n");
  EXPECT_NEAR(run.results.structures[0].displacement.back(), 1e5 * 2.0 / 50e6, 1e-7);
}

// Eight links with gaps that differ by a micrometre, or not at all.
long steps_of_eight(double difference) {
  std::string structures = "structures:\n  w: {wall: {}}\n", links = "links:\n";
  for (int i = 0; i < 8; ++i) {
    structures += fmt::format("  a{}: {{oscillator: {{mass: 100 t, period: 0.5, damping: 5 %}}, initial_velocity: 1 m/s}}\n", i);
    links += fmt::format("  - {{between: [a{}, w], gap: {}, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}}\n", i,
                         0.02 + i * difference);
  }
  const Outcome run = run_text(structures + links + "analysis: {duration: 2}\n");
  EXPECT_EQ(run.results.impacts.size() % 8, 0u);
  return run.summary.solver.steps;
}

TEST(NearlySimultaneousContacts, DoNotMultiplyTheSteps) {
  const long equal = steps_of_eight(0), different = steps_of_eight(1e-6);
  EXPECT_LT(different, 2 * equal);
}

TEST(ZeroGap, StaysUnilateral) {
  const Outcome run = run_text("ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\n"
                               "structures:\n"
                               "  a: {oscillator: {mass: 100 t, period: 0.7, damping: 5 %}}\n"
                               "  b: {oscillator: {mass: 150 t, period: 0.3, damping: 5 %}}\n"
                               "links: [{between: [a, b], gap: 0, law: kelvin_voigt_no_tension, stiffness: 93.5 MN/m, "
                               "restitution: 0.65}]\nanalysis: {duration: 4}\n");
  EXPECT_GT(run.results.impacts.size(), 3u);
  const LinkHistory& link = run.results.links[0];
  double widest = 0;
  for (std::size_t i = 0; i < link.time.size(); ++i) {
    if (link.penetration[i] < -1e-9) {
      EXPECT_EQ(link.force[i], 0) << "at " << link.time[i];
    }
    EXPECT_GE(link.force[i], 0) << "at " << link.time[i];
    widest = std::min(widest, link.penetration[i]);
  }
  EXPECT_LT(widest, -1e-2) << "the buildings part";
}

// Two links between the same bodies touch at the same instant: the first impulse parts both, and nothing is held.
TEST(RigidContactsAtOneInstant, AreAsOne) {
  const std::string one = test::two_oscillators("stereomechanical, restitution: 0.65", 1e-4);
  std::string two = one;
  two.insert(two.find("analysis:"),
             "  - {name: second, between: [left, right], gap: 20 mm, law: stereomechanical, restitution: 0.65}\n");
  const Outcome single = run_text(one), both = run_text(two);
  EXPECT_NEAR(both.summary.structures[0].peak_displacement[0], single.summary.structures[0].peak_displacement[0], 1e-9);
  EXPECT_EQ(both.results.impacts.size(), single.results.impacts.size());
  EXPECT_GE(both.summary.energy.impact, 0);
}

// A body that hits another and a wall at the same instant leaves both.
TEST(RigidContactsAtOneInstant, LetABodyLeaveAWallAndAnotherBody) {
  const Outcome run = run_text("structures:\n"
                               "  a: {body: {mass: 1 t}, initial_velocity: 1 m/s}\n"
                               "  b: {body: {mass: 1 t}}\n"
                               "  w: {wall: {}}\n"
                               "links:\n"
                               "  - {between: [a, b], gap: 10 mm, law: stereomechanical, restitution: 0.6}\n"
                               "  - {between: [a, w], gap: 10 mm, law: stereomechanical, restitution: 0.6}\n"
                               "analysis: {duration: 0.1}\n");
  EXPECT_LT(run.results.structures[0].velocity.back(), 0);
  for (const ImpactRow& row : run.results.impacts) EXPECT_FALSE(std::isnan(row.t_end));
  EXPECT_LT(run.summary.energy.error, 1e-12);
}

// A row of four equal bodies, the first one moving: rigid contacts at zero gap hand the impulse on.
TEST(RigidRow, HandsTheImpulseOnAtTheSameInstant) {
  std::string structures = "structures:\n", links = "links:\n";
  for (int i = 0; i < 4; ++i) {
    structures += fmt::format("  b{}: {{body: {{mass: 10 t}}{}}}\n", i, i == 0 ? ", initial_velocity: 1 m/s" : "");
    if (i > 0)
      links += fmt::format("  - {{between: [b{}, b{}], gap: {}, law: stereomechanical, restitution: 1}}\n", i - 1, i,
                           i == 1 ? "10 mm" : "0");
  }
  const Outcome run = run_text(structures + links + "analysis: {duration: 0.1}\n");
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(run.results.structures[i].velocity.back(), 0, 1e-12) << i;
  EXPECT_NEAR(run.results.structures[3].velocity.back(), 1, 1e-12);
}

// Where the ground jumps, the absolute acceleration does not: m a = -(c v + k u) at every output time.
TEST(JumpOfTheGround, LeavesTheAbsoluteAccelerationInBalance) {
  const Outcome run = run_text("ground_motion: {pulse: {shape: rectangle, amplitude: 2.0, start: 0.5, duration: 1}}\n"
                               "structures: {a: {oscillator: {mass: 2 kg, period: 0.4, damping: 5 %}}}\n"
                               "analysis: {duration: 2, output_step: 0.01, tolerance: 1e-6}\n");
  const StructureHistory& a = run.results.structures[0];
  const double w = 2 * M_PI / 0.4;
  for (std::size_t i = 0; i < run.results.time.size(); ++i)
    EXPECT_NEAR(a.acceleration[i], -(2 * 0.05 * w * a.velocity[i] + w * w * a.displacement[i]), 1e-5) << run.results.time[i];
}

// A first step over whole periods would see no motion at all.
TEST(GroundMotion, IsNotSteppedOver) {
  const Outcome run = run_text("ground_motion: {harmonic: {amplitude: 3.0, period: 0.1, duration: 1.6}}\n"
                               "structures: {a: {body: {mass: 1 t}}}\nanalysis: {duration: 1.6, max_step: 1e3}\n");
  // v = -(A T/2 pi)(1 - cos), u(1.6) = -A T t/(2 pi).
  EXPECT_NEAR(run.results.structures[0].displacement.back(), -3.0 * 0.1 * 1.6 / (2 * M_PI), 1e-5);
}

TEST(LinkHistory, RisesFromZeroAtTheTouch) {
  const Outcome run = run_text("structures:\n  a: {body: {mass: 100 t}, initial_velocity: 1 m/s}\n  w: {wall: {}}\n"
                               "links: [{between: [a, w], gap: 10 mm, law: kelvin_voigt_no_tension, stiffness: 93.5 MN/m, "
                               "restitution: 0.5}]\nanalysis: {duration: 0.2, tolerance: 1e-6}\n");
  const LinkHistory& link = run.results.links[0];
  double impulse = 0;
  for (std::size_t i = 1; i < link.time.size(); ++i)
    impulse += 0.5 * (link.time[i] - link.time[i - 1]) * (link.force[i] + link.force[i - 1]);
  // Trapezoids over some hundred samples; a ramp from the last output before the touch would add a per cent.
  EXPECT_NEAR(impulse, run.results.impacts[0].impulse, 1e-4 * impulse);
}

}  // namespace
}  // namespace pounding
