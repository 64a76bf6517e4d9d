// Bodies that stay together: restitution 0, and contacts that are closed at the start.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "support/book.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace sticking_test {

using test::run_text;

double energy_error(const Results& r) { return r.energy.error.back(); }

// Plastic impact: the common velocity follows from momentum. Then both masses form one oscillator until its spring
// pulls harder than it pushes.
TEST(RestitutionZero, MovesTheBodiesAsOneAfterTheTouch) {
  test::Book book("Sticking bodies",
                  "momentum, and the free vibration of both masses on one spring until the contact force is zero",
                  "run at tolerance 1e-7");
  const double ball = 5e4, mass = 1e5, stiffness = 4e6, v = 1;
  const Outcome run = run_text(
      "structures:\n  ball: {body: {mass: 50 t}, initial_velocity: 1 m/s}\n"
      "  floor: {oscillator: {mass: 100 t, stiffness: 4 MN/m, damping: 0}}\n"
      "links: [{between: [ball, floor], gap: 10 mm, law: stereomechanical, restitution: 0}]\n"
      "analysis: {duration: 1.5, tolerance: 1e-7}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  const ImpactRow& row = run.results.impacts[0];
  const double together = ball * v / (ball + mass), w = std::sqrt(stiffness / (ball + mass)), touch = 0.01 / v;
  book.near("touch [s]", row.t_start, touch, 1e-12);
  // u = V/w sin(w t), and the force on the ball m u'' is a push while u > 0.
  book.near("end of the rest: half a period later [s]", row.t_end, touch + std::acos(-1.0) / w, 1e-6);
  book.near("restitution [-]", row.restitution, 0, 1e-9);
  book.near("energy lost in the touch [J]", row.energy_lost, 0.5 * ball * mass / (ball + mass) * v * v, 1e-3);
  const StructureHistory &a = run.results.structures[0], &b = run.results.structures[1];
  book.near("largest displacement of the floor [m]", *std::max_element(b.displacement.begin(), b.displacement.end()),
            together / w, 1e-5);
  book.near("velocity of the ball at the end [m/s]", a.velocity.back(), -together, 1e-6);
  book.near("velocity amplitude of the floor at the end [m/s]",
            std::hypot(b.velocity.back(), b.displacement.back() * std::sqrt(stiffness / mass)), together, 1e-6);
  EXPECT_NEAR(energy_error(run.results), 0, 1e-3);
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

// Both bodies move together: F = m w V at the first quarter of the period, for any length of the steps.
TEST(RestitutionZero, LocatesThePeakForceOfBodiesThatStick) {
  const double ball = 1e3, stiffness = 8e4, mass = 3e3, exact = ball * std::sqrt(stiffness / mass) / 3;
  for (const double tolerance : {1e-3, 1e-4, 1e-6})
    for (const char* integrator : {"esdirk4", "generalized_alpha"}) {
      const Outcome run =
          run_text(fmt::format("structures:\n  ball: {{body: {{mass: 1 t}}, initial_velocity: 1}}\n"
                               "  ground: {{oscillator: {{mass: 2 t, stiffness: 8e4}}, damping: 0}}\n"
                               "links: [{{between: [ball, ground], gap: 0.1, law: stereomechanical, restitution: 0}}]\n"
                               "analysis: {{duration: 0.74, tolerance: {}, integrator: {}}}\n",
                               tolerance, integrator));
      ASSERT_EQ(run.results.impacts.size(), 1u);
      const ImpactRow& row = run.results.impacts[0];
      EXPECT_NEAR(row.peak_force, exact, tolerance * exact) << integrator;
      EXPECT_NEAR(row.t_peak, 0.1 + 0.5 * std::acos(-1.0) / std::sqrt(stiffness / mass), 0.03 * std::sqrt(tolerance))
          << integrator;
      EXPECT_GE(row.peak_force, largest(run.results.links[0].force)) << integrator;
      EXPECT_EQ(run.summary.links[0].peak_force, row.peak_force);
    }
}

// An oscillator at a wall is at rest while the ground motion presses it: the force is m a(t) at every tolerance.
TEST(RestOnAWall, LocatesThePeakForceOfTheGround) {
  for (const double tolerance : {1e-3, 1e-6})
    for (const char* restitution : {"0", "0.5"}) {
      const Outcome run = run_text(fmt::format(
          "ground_motion: {{harmonic: {{amplitude: -2.0, period: 0.7, duration: 0.35}}}}\n"
          "structures:\n  a: {{oscillator: {{mass: 100 t, period: 0.5, damping: 5 %}}}}\n  w: {{wall: {{}}}}\n"
          "links: [{{between: [a, w], gap: 0, law: stereomechanical, restitution: {}}}]\n"
          "analysis: {{duration: 0.4, tolerance: {}}}\n",
          restitution, tolerance));
      ASSERT_GE(run.results.impacts.size(), 1u);
      EXPECT_NEAR(run.results.impacts[0].peak_force, 2e5, 1e-6 * 2e5) << tolerance;
      EXPECT_NEAR(run.results.impacts[0].t_peak, 0.175, 1e-4);
      EXPECT_GE(run.results.impacts[0].peak_force, largest(run.results.links[0].force));
    }
}

// Three bodies in a row that the ground motion presses against a wall: each link carries the inertia of all bodies
// before it.
TEST(RestOnAWall, LocatesThePeakForcesInARow) {
  const Outcome run = run_text(
      "ground_motion: {harmonic: {amplitude: -2.0, period: 0.7, duration: 0.35}}\n"
      "structures:\n  a: {body: {mass: 100 t}}\n  b: {body: {mass: 50 t}}\n  c: {body: {mass: 20 t}}\n  w: {wall: {}}\n"
      "links:\n  - {between: [a, b], gap: 0, law: stereomechanical, restitution: 0}\n"
      "  - {between: [b, c], gap: 0, law: stereomechanical, restitution: 0.3}\n"
      "  - {between: [c, w], gap: 0, law: stereomechanical, restitution: 0}\n"
      "analysis: {duration: 0.3, tolerance: 1e-4}\n");
  const double mass[] = {100e3, 150e3, 170e3};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(run.summary.links[i].peak_force, 2 * mass[i], 1e-6 * 2 * mass[i]);
    EXPECT_GE(run.summary.links[i].peak_force, largest(run.results.links[i].force));
  }
}

// Critical damping: d = v t exp(-w t), which never returns to zero; the largest force is c v = 2 m w v at the touch.
TEST(RestitutionZero, IsCriticalDampingForKelvinVoigt) {
  test::Book book("Sticking bodies",
                  "critically damped oscillator: d_max = v/(w e) at t = 1/w, F = 2 m w v at the touch",
                  "run at tolerance 1e-7");
  const double m = 5e4, k = 5e7, w = std::sqrt(k / m), v = 0.5;
  const Outcome run = run_text(
      "structures:\n  ball: {body: {mass: 50 t}, initial_velocity: 0.5 m/s}\n  w: {wall: {}}\n"
      "links: [{between: [ball, w], gap: 10 mm, law: kelvin_voigt, stiffness: 50 MN/m, restitution: 0}]\n"
      "analysis: {duration: 0.3, tolerance: 1e-7}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  const ImpactRow& row = run.results.impacts[0];
  EXPECT_TRUE(std::isnan(row.t_end)) << "still in contact";
  book.near("peak penetration [m]", row.peak_penetration, v / w * std::exp(-1.0), 1e-9);
  book.near("peak force over 2 m w v [-]", row.peak_force / (2 * m * w * v), 1, 1e-7);
  const double t = 0.3 - 0.02;
  book.near("penetration at the end [m]", run.results.structures[0].displacement.back() - 0.01,
            v * t * std::exp(-w * t), 1e-9);
}

constexpr const char* pressed =
    "structures:\n"
    "  left:  {oscillator: {mass: 100 t, stiffness: 20 MN/m, damping: 5 %}}\n"
    "  right: {oscillator: {mass: 150 t, stiffness: 50 MN/m, damping: 5 %}}\n"
    "links: [{between: [left, right], gap: -2 mm, preload: true, law: ";

TEST(Preload, StaysAtRestUntilTheGroundMoves) {
  for (const std::string law :
       {"linear_spring, stiffness: 93.5 MN/m", "hertz, stiffness: 2.75e9",
        "kelvin_voigt, stiffness: 9e7, restitution: 0.5", "jankowski, stiffness: 2.75e9, restitution: 0.5",
        "elastoplastic, stiffness: 2.75e9, restitution: 0.5"}) {
    SCOPED_TRACE(law);
    const Outcome run = run_text(pressed + law + "}]\nanalysis: {duration: 1, tolerance: 1e-6}\n");
    ASSERT_EQ(run.results.impacts.size(), 1u);
    EXPECT_EQ(run.results.impacts[0].t_start, 0);
    EXPECT_TRUE(std::isnan(run.results.impacts[0].t_end));
    EXPECT_TRUE(std::isnan(run.results.impacts[0].restitution));
    for (const StructureHistory& s : run.results.structures) {
      EXPECT_LT(std::abs(s.displacement.front()), 2e-3);
      EXPECT_NE(s.displacement.front(), 0);
      for (const double u : s.displacement) EXPECT_NEAR(u, s.displacement.front(), 1e-12);
    }
    EXPECT_GT(run.results.energy.input.back(), 10);
    EXPECT_NEAR(energy_error(run.results), 0, 1e-9 * run.results.energy.input.back());
    const LinkHistory& link = run.results.links[0];
    EXPECT_EQ(link.time.front(), 0);
    EXPECT_GT(link.force.front(), 0);
    for (const double force : link.force) EXPECT_NEAR(force / link.force.front(), 1, 1e-9);
  }
}

// Three springs in series share the overlap: F = 2 mm/(1/k1 + 1/k2 + 1/k), and store half of F times the overlap.
TEST(Preload, OfALinearSpringIsThatOfThreeSpringsInLine) {
  const Outcome run = run_text(
      pressed + std::string("linear_spring, stiffness: 93.5 MN/m}]\nanalysis: {duration: 0.1, tolerance: 1e-6}\n"));
  const double force = 2e-3 / (1 / 20e6 + 1 / 50e6 + 1 / 93.5e6);
  EXPECT_NEAR(run.results.links[0].force.front(), force, 1e-9 * force);
  EXPECT_NEAR(run.results.structures[0].displacement.front(), -force / 20e6, 1e-12);
  EXPECT_NEAR(run.results.structures[1].displacement.front(), force / 50e6, 1e-12);
  EXPECT_NEAR(run.results.energy.input.back(), 0.5 * force * 2e-3, 1e-9 * force);
}

// Linear structures with a linear contact that never opens: the preload superposes on the motion of the system joined
// by the contact.
TEST(Preload, AddsToTheMotionOfALinearSystem) {
  test::Book book(
      "Contacts closed at the start",
      "superposition: doubling the preload doubles the equilibrium and leaves the motion of the linear system about it",
      "runs at tolerance 1e-7");
  const auto moved = [](double overlap) {
    return run_text(fmt::format(
        "ground_motion: {{harmonic: {{amplitude: 0.2, period: 0.4, duration: 1}}}}\n"
        "structures:\n"
        "  left:  {{oscillator: {{mass: 100 t, stiffness: 20 MN/m, damping: 5 %}}}}\n"
        "  right: {{oscillator: {{mass: 150 t, stiffness: 50 MN/m, damping: 5 %}}}}\n"
        "links: [{{between: [left, right], gap: {} mm, preload: true, law: linear_spring, stiffness: 93.5 MN/m}}]\n"
        "analysis: {{duration: 2, tolerance: 1e-7}}\n",
        -overlap));
  };
  const Outcome one = moved(20), two = moved(40);
  ASSERT_TRUE(std::isnan(one.results.impacts.at(0).t_end) && one.results.impacts.size() == 1) << "never open";
  const double k = 9.35e7, force = 20e-3 / (1 / k + 1 / 2e7 + 1 / 5e7);
  const double shift[] = {-force / 2e7, force / 5e7};
  for (int s = 0; s < 2; ++s) {
    const auto &a = one.results.structures[s].displacement, &b = two.results.structures[s].displacement;
    ASSERT_EQ(a.size(), b.size());
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(b[i] - a[i] - shift[s]));
    book.below("difference of the two runs, less that of the equilibria [m]", worst, 2e-8);
  }
  EXPECT_NEAR(energy_error(one.results), 0, 1e-5 * one.results.energy.input.back());
}

// The contact opens and closes, and the energy balance holds with the initially stored energy in the input.
TEST(Preload, ClosesTheEnergyWhereTheContactOpens) {
  for (const std::string law : {"hertz, stiffness: 2.75e9", "elastoplastic, stiffness: 2.75e9, restitution: 0.5",
                                "hertz_damped, stiffness: 2.75e9, restitution: 0.6, impact_velocity: 0.2"}) {
    SCOPED_TRACE(law);
    const Outcome run =
        run_text("ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\n" + (pressed + law) +
                 "}]\ncompare: no_pounding\nanalysis: {duration: 3, tolerance: 1e-6}\n");
    ASSERT_GT(run.results.impacts.size(), 2u);
    EXPECT_EQ(run.results.impacts[0].t_start, 0);
    EXPECT_GT(run.results.impacts[0].t_end, 0);
    EXPECT_GT(run.results.impacts[0].energy_lost, -1e-3 * run.results.energy.input.back());
    EXPECT_NEAR(energy_error(run.results), 0, 1e-4 * run.results.energy.input.back());
  }
}

}  // namespace sticking_test
}  // namespace pounding
