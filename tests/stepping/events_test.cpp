// Contacts that a fixed step would miss or that challenge an integrator.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include <pounding/laws/all.hpp>

#include "support/runs.hpp"

namespace pounding {
namespace events_test {

using test::run_text;

// 10 kg at 20 m/s on a stiff wall: the contact lasts a hundredth of the first free step.
TEST(ShortContact, IsFoundByAStepMuchLongerThanIt) {
  const Outcome run = run_text(
      "structures:\n  a: {body: {mass: 10 kg}, initial_velocity: 20 m/s}\n  w: {wall: {}}\n"
      "links: [{between: [a, w], gap: 10 m, law: linear_spring, stiffness: 1e9}]\n"
      "analysis: {duration: 1, tolerance: 1e-6}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  EXPECT_NEAR(run.results.impacts[0].t_start, 0.5, 1e-12);
  EXPECT_NEAR(run.results.impacts[0].t_end - run.results.impacts[0].t_start, M_PI * std::sqrt(10.0 / 1e9), 1e-9);
  EXPECT_NEAR(run.results.impacts[0].peak_force, 20 * std::sqrt(1e9 * 10.0), 1e-5 * 2e6);
}

// A light body: the contact lasts pi sqrt(m/k) = 10 us at any speed, a free step half a second.
class ShortContactAtSpeed : public testing::TestWithParam<double> {};

TEST_P(ShortContactAtSpeed, GivesBackTheSpeedOfALightBody) {
  const double v = GetParam();
  const Outcome run =
      run_text(fmt::format("structures:\n  a: {{body: {{mass: 0.01 kg}}, initial_velocity: {0}}}\n"
                           "  w: {{wall: {{}}}}\n"
                           "links: [{{between: [a, w], gap: {1}, law: linear_spring, stiffness: 1e9}}]\n"
                           "analysis: {{duration: 1, tolerance: 1e-6}}\n",
                           v, v / 2));
  ASSERT_EQ(run.results.impacts.size(), 1u);
  EXPECT_NEAR(run.results.impacts[0].t_start, 0.5, 1e-12);
  EXPECT_NEAR(run.results.impacts[0].peak_force, v * std::sqrt(1e9 * 0.01), 1e-5 * v * std::sqrt(1e9 * 0.01));
  EXPECT_NEAR(run.results.structures[0].velocity.back(), -v, 1e-5 * v);
}

INSTANTIATE_TEST_SUITE_P(Speeds, ShortContactAtSpeed, testing::Values(0.01, 1.0, 30.0, 1000.0));

// An undamped oscillator with an amplitude slightly above or below the gap.
Outcome grazing(double excess) {
  const double w = 2 * M_PI / 0.5;
  return run_text("structures:\n  a: {oscillator: {mass: 100 t, period: 0.5, damping: 0}, initial_velocity: " +
                  fmt::format("{}", w * 0.02) +
                  "}\n  w: {wall: {}}\nlinks: [{between: [a, w], gap: " + fmt::format("{}", 0.02 * (1 - excess)) +
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

// A rigid ball pressed on a wall by a constant ground acceleration has ever lower bounces. With e = 0.5 and a = 2
// m/s^2, from rest 10 mm away, the touch is at t1 = sqrt(2 g/a) with v1 = a t1, and all bounces end at t1 + 2 (v1/a)
// e/(1 - e) = 3 t1.
TEST(RestingContact, FollowsInfinitelyManyBounces) {
  const Outcome run = run_text(
      "ground_motion: {pulse: {shape: rectangle, amplitude: -2.0, duration: 2 s}}\n"
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
  EXPECT_NEAR(impulse, 1e5 * 2.0 * 2.0, 1e-3 * 4e5) << "the wall took all momentum of the ground motion";
}

TEST(RestingContact, OpensWhenTheGroundTurns) {
  const Outcome run = run_text(
      "ground_motion: {pulse: {shape: sine, amplitude: -2.0, duration: 2 s}}\n"
      "structures:\n  a: {body: {mass: 100 t}}\n  w: {wall: {}}\n"
      "links: [{between: [a, w], gap: 0, law: stereomechanical, restitution: 0.5}]\n"
      "analysis: {duration: 2, tolerance: 1e-6}\n");
  // Pressed for the first second, then free: v(2) = -integral of 2 sin(pi t) from 1 to 2 ... = -4/pi.
  EXPECT_NEAR(run.results.structures[0].velocity.back(), -4 / M_PI, 1e-5);
  EXPECT_NEAR(run.results.impacts.back().t_end, 1.0, 1e-5);
}

// A compliant contact settles at the static penetration.
TEST(RestingContact, SettlesAtTheStaticPenetration) {
  const Outcome run = run_text(
      "ground_motion: {pulse: {shape: rectangle, amplitude: -2.0, duration: 5 s}}\n"
      "structures:\n  a: {body: {mass: 100 t}}\n  w: {wall: {}}\n"
      "links: [{between: [a, w], gap: 0, law: kelvin_voigt_no_tension, stiffness: 50 MN/m, "
      "restitution: 0.3}]\nanalysis: {duration: 5}\n");
  EXPECT_NEAR(run.results.structures[0].displacement.back(), 1e5 * 2.0 / 50e6, 1e-7);
}

// Eight links with gaps that are equal or differ by a micrometre.
class NearlySimultaneousContacts : public testing::TestWithParam<const char*> {
 protected:
  static long steps(double difference) {
    std::string structures = "structures:\n  w: {wall: {}}\n", links = "links:\n";
    for (int i = 0; i < 8; ++i) {
      structures += fmt::format(
          "  a{}: {{oscillator: {{mass: 100 t, period: 0.5, damping: 5 %}}, initial_velocity: 1 m/s}}\n", i);
      links += fmt::format("  - {{between: [a{}, w], gap: {}, law: {}}}\n", i, 0.02 + i * difference, GetParam());
    }
    const Outcome run = run_text(structures + links + "analysis: {duration: 2}\n");
    EXPECT_EQ(run.results.impacts.size() % 8, 0u);
    return run.summary.solver.steps;
  }
};

TEST_P(NearlySimultaneousContacts, DoNotMultiplyTheSteps) { EXPECT_LT(steps(1e-6), 2 * steps(0)); }

INSTANTIATE_TEST_SUITE_P(Laws, NearlySimultaneousContacts,
                         testing::Values("hertz, stiffness: 2.75e9",
                                         "hertz_damped, stiffness: 2.75e9, restitution: 0.65",
                                         "kelvin_voigt, stiffness: 9.35e7, restitution: 0.65",
                                         "stereomechanical, restitution: 0.65"),
                         test::law_name);

// Forty bodies that touch their walls at the start: a single landing includes all of them.
TEST(TouchesAtTheStart, AreOneLanding) {
  const auto run = [](int count) {
    std::string structures = "structures:\n  w: {wall: {}}\n", links = "links:\n";
    for (int i = 0; i < count; ++i) {
      structures +=
          fmt::format("  a{}: {{oscillator: {{mass: 100 t, period: 0.5, damping: 5 %}}, initial_velocity: {} m/s}}\n",
                      i, 1 + 0.01 * i);
      links += fmt::format(
          "  - {{between: [a{}, w], gap: 0, law: kelvin_voigt, stiffness: 93.5 MN/m, restitution: 0.65}}\n", i);
    }
    return run_text(structures + links + "analysis: {duration: 0.01}\n");
  };
  const Outcome one = run(1), all = run(40);
  EXPECT_EQ(all.summary.solver.events, 40);
  EXPECT_LT(all.summary.solver.iterations, 3 * one.summary.solver.iterations);
  ASSERT_EQ(all.results.impacts.size(), 40u);
  for (const ImpactRow& row : all.results.impacts) EXPECT_EQ(row.t_start, 0);
  EXPECT_DOUBLE_EQ(all.results.impacts[0].peak_force, one.results.impacts[0].peak_force);
}

TEST(ZeroGap, StaysUnilateral) {
  const Outcome run = run_text(
      "ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\n"
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
  EXPECT_LT(widest, -1e-2) << "the buildings separate";
}

// Two links between the same bodies touch simultaneously: the first impulse separates both, and no contact persists.
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

// A body that simultaneously hits another body and a wall separates from both.
TEST(RigidContactsAtOneInstant, LetABodyLeaveAWallAndAnotherBody) {
  const Outcome run = run_text(
      "structures:\n"
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

// A row of four equal bodies, the first one moving: rigid contacts at zero gap transmit the impulse.
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

// Minimal problems at which an engine once failed: light bodies between heavy ones, contacts at rest, and velocity
// jumps next to closed contacts.

constexpr const char* push = "ground_motion: {pulse: {shape: rectangle, amplitude: -4.0, duration: 1.0}}\n";

void expect_sound(const Outcome& run, double tolerance) {
  EXPECT_LT(run.summary.energy.error, 10 * tolerance);
  for (const ImpactRow& row : run.results.impacts) EXPECT_GE(row.v_approach, 0) << row.t_start;
  for (const LinkHistory& link : run.results.links)
    for (std::size_t i = 0; i < link.time.size(); ++i) {
      EXPECT_GE(link.force[i], -1e-9 * run.summary.links[0].peak_force) << link.name << " at " << link.time[i];
      if (link.penetration[i] < -1e-9) {
        EXPECT_EQ(link.force[i], 0) << link.name << " at " << link.time[i];
      }
    }
}

// STEP decreases faster than the spring force: a released contact presses again before the bodies part.
TEST(ReleasedContact, PressesAgainBeforeItParts) {
  const Outcome run = run_text(
      "structures:\n  a: {body: {mass: 1e5}, initial_velocity: 2.0}\n  b: {body: {mass: 1e5}}\n"
      "links: [{between: [a, b], gap: 0, law: adams_impact, stiffness: 1e11, depth: 0.003, "
      "restitution: 0.05}]\nanalysis: {duration: 0.3, tolerance: 1e-5}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  EXPECT_NEAR(run.results.impacts[0].restitution, 0.05, 1e-4);
}

// A released contact presses again. A trial long enough to pass over this does not detect it until another touch
// shortens the trial.
TEST(ReleasedContact, PressesAgainThoughALongTrialPassesOverIt) {
  const Outcome run = run_text(
      "structures:\n  b0: {body: {mass: 2930.792081235971}, initial_velocity: 0.9069193061762009}\n"
      "  b1: {body: {mass: 12853.331203736185}, initial_velocity: 0.05217583509988377}\n"
      "  b2: {body: {mass: 1035.4403963447048}, initial_velocity: -0.25658658132249146}\n"
      "  b3: {body: {mass: 211711.28108783916}, initial_velocity: -0.12584687996890231}\n"
      "  b4: {body: {mass: 3958.719706243838}, initial_velocity: -0.7250283803595077}\nlinks:\n"
      "  - {between: [b0, b1], gap: 0.04765522908381816, law: bilinear_hertz, stiffness: 17203662.69930779, "
      "restitution: 0.65, "
      "formula: muthukumar_desroches}\n"
      "  - {between: [b1, b2], gap: 0, law: modified_linear_viscoelastic, stiffness: 984471736.0854828, restitution: "
      "0.1}\n"
      "  - {between: [b2, b3], gap: 0, law: adams_impact, stiffness: 45570985690.39583, depth: 0.00027057851722426743, "
      "restitution: 0.3, impact_velocity: 0.031604114170162186}\n"
      "  - {between: [b3, b4], gap: 0.023701554862004703, law: hertz_damped, stiffness: 71868979.71570522, "
      "restitution: 0.5, "
      "impact_velocity: 2.993531470949195}\nanalysis: {duration: 0.3, tolerance: 1e-5}\n");
  double gained = 1035.4403963447048 * (run.results.structures[2].velocity.back() + 0.25658658132249146), given = 0,
         total = 0;
  for (const ImpactRow& row : run.results.impacts) {
    if (row.link == 1) given += row.impulse;
    if (row.link == 2) given -= row.impulse;
    total += row.impulse;
  }
  EXPECT_NEAR(gained, given, 1e-5 * total) << "a body gains the sum of the impulses of its contacts";
}

// A contact that is opened by a rigid one would pull if the law of the approach still applied.
TEST(JumpOfTheVelocity, ReversesAPressedContactBesideIt) {
  const Outcome run = run_text(
      "structures:\n  a: {body: {mass: 1.0}, initial_velocity: 1.0}\n  b: {body: {mass: 1.0}}\n"
      "links:\n"
      "  - {between: [a, b], gap: 0.037, law: limited_damper, stiffness: 1.0, restitution: 0.1}\n"
      "  - {between: [a, b], gap: 0.04, law: stereomechanical, restitution: 1.0, name: beside}\n"
      "analysis: {duration: 0.1, tolerance: 1e-4}\n");
  ASSERT_EQ(run.results.impacts.size(), 2u);
  for (const double force : run.results.links[0].force) EXPECT_GE(force, 0);
  EXPECT_GE(run.results.impacts[0].impulse, 0);
  expect_sound(run, 1e-4);
}

// The last hops are lower than the round-off of the motion.
TEST(RestingContact, EndsHopsThatNoStepCouldSee) {
  const Outcome run = run_text(push + std::string("structures:\n  a: {body: {mass: 1.0}}\n  w: {wall: {}}\n"
                                                  "links: [{between: [a, w], gap: 1e-6, law: stereomechanical, "
                                                  "restitution: 0.05}]\nanalysis: {duration: 2.0, tolerance: 1e-4}\n"));
  EXPECT_NEAR(run.results.structures[0].displacement.back(), 1e-6, 1e-10);
  double impulse = 0;
  for (const ImpactRow& row : run.results.impacts) impulse += row.impulse;
  EXPECT_NEAR(impulse, 4.0, 1e-6);
}

// Rows that come to rest: they touch and part at speeds that leave no penetration above the round-off of their motion.
class TouchesInRoundOff : public testing::TestWithParam<const char*> {};

TEST_P(TouchesInRoundOff, TakeTime) {
  const Outcome run = run_text(GetParam());
  expect_sound(run, 1e-3);
  EXPECT_LT(run.summary.solver.steps, 2000);
}

INSTANTIATE_TEST_SUITE_P(
    Models, TouchesInRoundOff,
    testing::Values(
        "ground_motion: {pulse: {shape: sine, amplitude: -1.5766867448399593, start: 0.0, duration: 1.0}}\n"
        "structures:\n"
        "  a: {oscillator: {mass: 787270.2189307639, period: 0.15054238912323856, damping: 0.05}}\n"
        "  w: {wall: {}}\n"
        "links: [{between: [a, w], gap: 0, law: modified_linear_viscoelastic, stiffness: 74266794058.09273, "
        "damping_ratio: 3.9053186018392827}]\n"
        "analysis: {duration: 2.0, tolerance: 0.001}\n",
        "ground_motion: {pulse: {shape: sine, amplitude: -3.9703557119392032, start: 0.0, duration: 2.5}}\n"
        "structures:\n"
        "  a: {oscillator: {mass: 1251.1399089128977, period: 1.534474334880143, damping: 0.05}}\n"
        "  b: {oscillator: {mass: 871103.6867257797, period: 0.07189141164425848, damping: 0}}\n"
        "  w: {wall: {}}\n"
        "links:\n"
        "  - {between: [a, b], gap: 0, law: komodromos, stiffness: 145594975.66907328, restitution: 0.3}\n"
        "  - {between: [b, w], gap: 0, law: hertz, stiffness: 3818242400.489604}\n"
        "analysis: {duration: 2.0, tolerance: 0.001}\n",
        "ground_motion: {pulse: {shape: half_sine, amplitude: -1.6749683568450386, start: 0.0, duration: 1.0}}\n"
        "structures:\n"
        "  a: {body: {mass: 1259.6998424150443}}\n"
        "  b: {body: {mass: 1572.4761318339097}}\n"
        "  c: {body: {mass: 4723.322725683341}}\n"
        "  d: {body: {mass: 5002.2748551343175}}\n"
        "  w: {wall: {}}\n"
        "links:\n"
        "  - {between: [a, b], gap: 0, law: hertz_damped, stiffness: 5112492.335688482, restitution: 0.3, formula: "
        "gonthier}\n"
        "  - {between: [b, c], gap: 0, law: modified_linear_viscoelastic, stiffness: 82260875544.46341, restitution: "
        "0.05}\n"
        "  - {between: [c, d], gap: 0, law: komodromos, stiffness: 138040799.85348383, restitution: 0.05}\n"
        "  - {between: [d, w], gap: 0, law: modified_kelvin, stiffness: 2133935.936728552, restitution: 0.3}\n"
        "analysis: {duration: 2.0, tolerance: 0.0001}\n"));

// The contact on the other side presses the light body on the rigid one with 1e6 times its weight.
TEST(LightBody, IsHeldBetweenACompliantContactAndARigidOne) {
  const Outcome run = run_text(
      "structures:\n  a: {body: {mass: 1e5}, initial_velocity: 1.0}\n  b: {body: {mass: 1.0}}\n"
      "  c: {body: {mass: 1e5}}\n"
      "links:\n  - {between: [a, b], gap: 0, law: jankowski, stiffness: 1e8, restitution: 0.05}\n"
      "  - {between: [b, c], gap: 0.04, law: stereomechanical, restitution: 0.05}\n"
      "analysis: {duration: 0.1, tolerance: 1e-4}\n");
  EXPECT_LT(run.results.impacts.size(), 20u);
  EXPECT_NEAR(1e5 * run.results.structures[0].velocity.back() + run.results.structures[1].velocity.back() +
                  1e5 * run.results.structures[2].velocity.back(),
              1e5, 1e-7 * 1e5);
  expect_sound(run, 1e-4);
}

// Sequential Newton impacts converge with the mass ratio: a factor of 1 - 1e-2, or 1 - 1e-6, per sweep.
TEST(LightBody, HandsAnImpulseBetweenTwoRigidContacts) {
  for (const double light : {1e3, 0.1}) {
    const Outcome run =
        run_text(fmt::format("structures:\n  a: {{body: {{mass: 1e5}}}}\n  b: {{body: {{mass: {}}}}}\n"
                             "  c: {{body: {{mass: 1e5}}, initial_velocity: -0.2}}\n"
                             "links:\n  - {{between: [a, b], gap: 0, law: stereomechanical, restitution: 1.0}}\n"
                             "  - {{between: [b, c], gap: 0, law: stereomechanical, restitution: 0.1}}\n"
                             "analysis: {{duration: 0.01, tolerance: 1e-3}}\n",
                             light));
    const double a = run.results.structures[0].velocity.back(), b = run.results.structures[1].velocity.back(),
                 c = run.results.structures[2].velocity.back();
    EXPECT_NEAR(1e5 * a + light * b + 1e5 * c, -0.2e5, 1e-10 * 0.2e5);
    // Below the tolerance times the largest speed a bounce is not resolved.
    EXPECT_LE(a, b + 1e-3 * 0.2) << light;
    EXPECT_LE(b, c + 1e-3 * 0.2) << light;
    EXPECT_GE(run.summary.energy.impact, 0);
    EXPECT_LT(run.summary.energy.error, 1e-10) << "round-off of speeds, times the mass ratio";
    EXPECT_LE(run.results.impacts.size(), 4u) << "simultaneous impulses are one impact of a link";
  }
}

// Damping calibrated at the lowest resolved speed, 1e-6 m/s, turns the weakest pull into a strong one.
TEST(TouchAtRest, LosesItsForceWhereTheBodiesPart) {
  const Outcome run = run_text(
      "ground_motion: {harmonic: {amplitude: 2.5, period: 1.2350790576384953, duration: 1.0}}\nstructures:\n"
      "  b0: {body: {mass: 1.0}, initial_velocity: -0.8}\n"
      "  b1: {oscillator: {mass: 10000.0, period: 0.2, damping: 0}}\n"
      "  b2: {oscillator: {mass: 56000.0, period: 0.5, damping: 0}}\n"
      "  b3: {oscillator: {mass: 109089.84449573551, period: 0.3070877823407642, damping: 0.05}}\n"
      "  b4: {body: {mass: 52000.0}}\n"
      "links:\n"
      "  - {between: [b3, b4], gap: 0, law: modified_kelvin, stiffness: 850000000.0, restitution: 0.05}\n"
      "  - {between: [b0, b1], gap: 0, law: hertz_damped, stiffness: 1.0, restitution: 1.0}\n"
      "  - {between: [b1, b2], gap: 0.01, law: linear_spring, stiffness: 30262121799.656094}\n"
      "analysis: {duration: 1.0, tolerance: 0.001}\n");
  expect_sound(run, 1e-3);
}

TEST(TouchAtRest, IsSolvedBetweenTwoCompliantContacts) {
  const Outcome run = run_text(
      push + std::string("structures:\n  a: {body: {mass: 1.0}}\n  b: {body: {mass: 1.0}}\n"
                         "  w: {wall: {}}\nlinks:\n"
                         "  - {between: [a, b], gap: 0, law: modified_kelvin, stiffness: 1e8, restitution: 0.05}\n"
                         "  - {between: [b, w], gap: 0, law: hertz_damped, stiffness: 1e8, restitution: 1.0}\n"
                         "analysis: {duration: 0.1, tolerance: 1e-3}\n"));
  expect_sound(run, 1e-3);
}

TEST(TouchAtRest, DoesNotBeginWhileTheBodiesPart) {
  const Outcome run = run_text(
      "ground_motion: {pulse: {shape: rectangle, amplitude: -2.3, duration: 1.0}}\nstructures:\n"
      "  b1: {oscillator: {mass: 1.0, period: 1.2, damping: 10 %}}\n  b2: {body: {mass: 1000.0}}\n  b3: {wall: "
      "{}}\nlinks:\n"
      "  - {between: [b2, b3], gap: 0, law: adams_impact, stiffness: 9e10, depth: 1.0, restitution: 0.05}\n"
      "  - {between: [b1, b2], gap: 0, law: bilinear_hertz, stiffness: 1.0, restitution: 1.0, impact_velocity: 1.0}\n"
      "analysis: {duration: 0.01, tolerance: 1e-3, integrator: generalized_alpha}\n");
  expect_sound(run, 1e-3);
}

// The end of a touch with dominant damping: the sign of its force is noise unless compared with the terms of the force.
TEST(TouchAtRest, DoesNotSwitchWithTheRoundingOfItsForce) {
  const Outcome run = run_text(
      "ground_motion: {pulse: {shape: sine, amplitude: -4.347324437979877, start: 0.0, duration: 1.0}}\nstructures:\n"
      "  b0: {body: {mass: 6114.625528914283}}\n  b1: {body: {mass: 1293.0359076006882}}\n"
      "  b2: {body: {mass: 13473.618046691967}}\n  b3: {body: {mass: 7601.719385526253}}\n  b4: {wall: {}}\nlinks:\n"
      "  - {between: [b3, b4], gap: 0, law: kelvin_voigt_no_tension, stiffness: 1872824340.9813142, restitution: 0.3, "
      "formula: anagnostopoulos}\n"
      "  - {between: [b0, b1], gap: 1e-09, law: linear_spring, stiffness: 41689992564.23305}\n"
      "  - {between: [b1, b2], gap: 0, law: hertz_damped, stiffness: 25595226379.75214, restitution: 0.1}\n"
      "  - {between: [b2, b3], gap: 0, law: adams_impact, stiffness: 600912267.4553211, depth: 0.0006746294526312445, "
      "restitution: 0.1, formula: exact}\n"
      "analysis: {duration: 0.8, tolerance: 1e-5}\n");
  expect_sound(run, 1e-5);
}

// At a jump of the ground acceleration, the absolute acceleration is continuous: m a = -(c v + k u) at every output
// time.
TEST(JumpOfTheGround, LeavesTheAbsoluteAccelerationInBalance) {
  const Outcome run = run_text(
      "ground_motion: {pulse: {shape: rectangle, amplitude: 2.0, start: 0.5, duration: 1}}\n"
      "structures: {a: {oscillator: {mass: 2 kg, period: 0.4, damping: 5 %}}}\n"
      "analysis: {duration: 2, output_step: 0.01, tolerance: 1e-6, integrator: generalized_alpha}\n");
  const StructureHistory& a = run.results.structures[0];
  const double w = 2 * M_PI / 0.4;
  for (std::size_t i = 0; i < run.results.time.size(); ++i)
    EXPECT_NEAR(a.acceleration[i], -(2 * 0.05 * w * a.velocity[i] + w * w * a.displacement[i]), 1e-5)
        << run.results.time[i];
}

// A first step over whole periods would miss the motion.
TEST(GroundMotion, IsNotSteppedOver) {
  const Outcome run = run_text(
      "ground_motion: {harmonic: {amplitude: 3.0, period: 0.1, duration: 1.6}}\n"
      "structures: {a: {body: {mass: 1 t}}}\nanalysis: {duration: 1.6, max_step: 1e3}\n");
  // v = -(A T/2 pi)(1 - cos), u(1.6) = -A T t/(2 pi).
  EXPECT_NEAR(run.results.structures[0].displacement.back(), -3.0 * 0.1 * 1.6 / (2 * M_PI), 1e-5);
}

TEST(LinkHistory, RisesFromZeroAtTheTouch) {
  const Outcome run = run_text(
      "structures:\n  a: {body: {mass: 100 t}, initial_velocity: 1 m/s}\n  w: {wall: {}}\n"
      "links: [{between: [a, w], gap: 10 mm, law: kelvin_voigt_no_tension, stiffness: 93.5 MN/m, "
      "restitution: 0.5}]\nanalysis: {duration: 0.2, tolerance: 1e-6, integrator: generalized_alpha}\n");
  const LinkHistory& link = run.results.links[0];
  double impulse = 0;
  for (std::size_t i = 1; i < link.time.size(); ++i)
    impulse += 0.5 * (link.time[i] - link.time[i - 1]) * (link.force[i] + link.force[i - 1]);
  // Trapezoidal rule over about a hundred samples; a ramp from the last output before the touch would add one per cent.
  EXPECT_NEAR(impulse, run.results.impacts[0].impulse, 1e-4 * impulse);
}

// Steps are limited only by their error; the samples resolve the force inside them.
TEST(LinkHistory, FollowsTheForceInsideLongSteps) {
  const Outcome run = run_text(
      "structures:\n  a: {body: {mass: 100 t}, initial_velocity: 1 m/s}\n  w: {wall: {}}\n"
      "links: [{between: [a, w], gap: 10 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}]\n"
      "analysis: {duration: 0.2, tolerance: 1e-3}\n");
  const LinkHistory& link = run.results.links[0];
  const ImpactRow& impact = run.results.impacts.at(0);
  EXPECT_TRUE(std::is_sorted(link.time.begin(), link.time.end()));
  const auto top = std::max_element(link.force.begin(), link.force.end());
  EXPECT_EQ(*top, impact.peak_force) << "the peak is a sample";
  EXPECT_NEAR(link.time[static_cast<std::size_t>(top - link.force.begin())], impact.t_peak, 1e-15);
  const laws::HertzDamped law{.stiffness = 2.75e9, .restitution = 0.65};
  const laws::Impact touched = laws::touch(law, impact.v_approach);
  int pressed = 0;
  for (std::size_t i = 0; i < link.time.size(); ++i) {
    if (link.force[i] == 0) continue;
    ++pressed;
    EXPECT_NEAR(law.respond(link.penetration[i], link.velocity[i], touched).force, link.force[i],
                1e-9 * impact.peak_force)
        << i;
  }
  EXPECT_GT(pressed, 3 * run.summary.solver.steps / 2) << "steps are long in this run";
}

// Linear interpolation between the samples has an error of at most a thousandth of the peak force.
TEST(LinkHistory, IsAsDenseAsAPictureNeeds) {
  for (const double tolerance : {1e-3, 1e-4}) {
    const Outcome run = run_text(fmt::format(
        "structures:\n  a: {{body: {{mass: 100 t}}, initial_velocity: 1 m/s}}\n  w: {{wall: {{}}}}\n"
        "links: [{{between: [a, w], gap: 10 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65}}]\n"
        "analysis: {{duration: 0.2, tolerance: {:g}}}\n",
        tolerance));
    const LinkHistory& link = run.results.links[0];
    const laws::HertzDamped law{.stiffness = 2.75e9, .restitution = 0.65};
    const laws::Impact touched = laws::touch(law, run.results.impacts.at(0).v_approach);
    double missed = 0;
    for (std::size_t i = 1; i < link.time.size(); ++i) {
      if (link.force[i - 1] == 0 || link.force[i] == 0) continue;
      const double h = link.time[i] - link.time[i - 1];
      const double middle =
          0.5 * (link.penetration[i - 1] + link.penetration[i]) + h / 8 * (link.velocity[i - 1] - link.velocity[i]);
      const double rate =
          0.5 * (link.velocity[i - 1] + link.velocity[i]) + h / 8 * (link.force[i] - link.force[i - 1]) / 100e3;
      const double force = law.respond(middle, rate, touched).force;
      missed = std::max(missed, std::abs(force - 0.5 * (link.force[i - 1] + link.force[i])));
    }
    EXPECT_LT(missed, 1e-3 * run.results.impacts[0].peak_force) << tolerance;
    EXPECT_GT(missed, 0.2e-3 * run.results.impacts[0].peak_force) << "not denser than at " << tolerance;
  }
}

}  // namespace events_test
}  // namespace pounding
