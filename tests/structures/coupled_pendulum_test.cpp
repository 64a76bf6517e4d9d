// The friction pendulum with friction along the sliding direction: contract, closed forms, OpenSees.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <pounding/structures/coupled_pendulum.hpp>
#include <pounding/structures/make_spring.hpp>
#include "support/bearing_references.hpp"
#include "support/book.hpp"
#include "support/elements.hpp"
#include "support/loaded.hpp"

namespace pounding {
namespace coupled_pendulum_test {

using test::ElementRun;
using test::Vector2;

constexpr SlidingFriction constant{
    .weight = 1e6, .radius = 2, .slow = 0.06, .fast = 0.06, .rate = 1, .sliding_deformation = 1e-3};
constexpr SlidingFriction by_rate{
    .weight = 1e6, .radius = 2, .slow = 0.03, .fast = 0.08, .rate = 20, .sliding_deformation = 1e-3};

TEST(CoupledPendulum, SlopesAreDerivatives) {
  test::expect_slopes_are_derivatives(CoupledPendulum(constant), 0, 2e-5);
  test::expect_slopes_are_derivatives(CoupledPendulum(by_rate), 0.05, 2e-5);
}

TEST(CoupledPendulum, StraightPathsCanBeDivided) {
  test::expect_straight_paths_can_be_divided(CoupledPendulum(constant), 1e-12);
}

TEST(CoupledPendulum, EnergiesBalance) { test::expect_energies_balance(CoupledPendulum(constant), 1e-4); }

TEST(CoupledPendulum, IsTheSliderOfOneDirectionOnALine) {
  const CoupledPendulum element(by_rate);
  const test::Loaded<SlidingSpring, SlidingFriction> spring(by_rate);
  for (const double v : {0.01, 0.1, 1.0})
    for (const double d : {0.2e-3, 0.9e-3, 5e-3, -5e-3}) {
      const auto expected = spring.evaluate({d, v});
      const ElementResponse found = ElementRun(element).at({0.6 * d, 0.8 * d}, {0.6 * v, 0.8 * v});
      EXPECT_NEAR(found.force[0], 0.6 * expected.force, 1e-9 * std::abs(expected.force));
      EXPECT_NEAR(found.force[1], 0.8 * expected.force, 1e-9 * std::abs(expected.force));
      const double along = 0.36 * found.by_rate[0][0] + 0.96 * found.by_rate[0][1] + 0.64 * found.by_rate[1][1];
      EXPECT_NEAR(along, expected.by_rate, 1e-9 * std::abs(expected.by_rate));
    }
}

TEST(CoupledPendulum, TurnsItsFrictionIntoTheSlidingDirection) {
  const CoupledPendulum element(constant);
  ElementRun run(element);
  run.go({50e-3, 0});
  // tan(angle/2) decreases from 1 by exp(-k0 x/(mu W)).
  const double x = 0.7e-3, angle = 2 * std::atan(std::exp(-x / 1e-3)), w = 1e6;
  const Vector2 force = run.force({50e-3, x});
  EXPECT_NEAR(force[0], 0.06 * w * std::sin(angle) + w / 2 * 50e-3, 1e-9 * w);
  EXPECT_NEAR(force[1], 0.06 * w * std::cos(angle) + w / 2 * x, 1e-9 * w);
}

TEST(CoupledPendulum, LosesFrictionTimesPathOnACircle) {
  const CoupledPendulum element(constant);
  ElementRun run(element);
  const double b = 0.1;
  const int steps = 2000;
  double before = 0;
  for (int i = 0; i <= 2 * steps; ++i) {
    const double angle = 2 * std::numbers::pi * i / steps;
    run.go({b * std::cos(angle), b * std::sin(angle)});
    if (i == steps) before = run.lost();
  }
  // The friction leads the slip circle, of radius sqrt(b^2 - u_y^2).
  const double expected = 0.06 * 1e6 * 2 * std::numbers::pi * std::sqrt(b * b - 1e-6);
  EXPECT_NEAR(run.lost() - before, expected, 1e-5 * expected);
}

TEST(CoupledPendulum, FollowsATurnWithinAStep) {
  const CoupledPendulum element(constant);
  ElementRun one(element), many(element);
  one.go({20e-3, 0});
  many.go({20e-3, 0});
  // d = (20 + 10 t - 10 t^2, 5 t^2) mm.
  const int steps = 2000;
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    many.go({(20 + 10 * t - 10 * t * t) * 1e-3, 5e-3 * t * t});
  }
  one.step({20e-3, 5e-3}, {10e-3, 0}, {-10e-3, 10e-3}, 1);
  const Vector2 a = one.force(one.d()), b = many.force(many.d());
  EXPECT_NEAR(a[0], b[0], 2e-2 * 6e4);
  EXPECT_NEAR(a[1], b[1], 2e-2 * 6e4);
  EXPECT_NEAR(one.lost(), many.lost(), 1e-2 * many.lost());
}

TEST(CoupledPendulum, ReversesWithinAStepAsInOneDirection) {
  test::Loaded<Spring> spring(make_spring(
      {.law = "friction_pendulum",
       .values = {{"weight", constant.weight}, {"radius", 2}, {"friction", 0.06}, {"yield_displacement", 1e-3}}}));
  const CoupledPendulum element(constant);
  ElementRun run(element);
  LinkStep step;
  step.end = 0.2;
  for (const auto& [d, begin, end] : {std::array{20e-3, 0.1, 0.1}, {15e-3, 0.1, -0.2}, {30e-3, -0.2, 0.3}}) {
    step.motion_begin = {step.motion_end.penetration, begin};
    step.motion_end = {d, end};
    spring.accept(step);
    run.step({0.6 * d, 0.8 * d}, {0.6 * begin, 0.8 * begin}, {0.6 * end, 0.8 * end}, step.end);
    const double expected = spring.evaluate({d, 0}).force + spring.stiffness() * d;
    EXPECT_NEAR(run.force(run.d())[0], 0.6 * expected, 1e-9 * constant.weight);
    EXPECT_NEAR(run.force(run.d())[1], 0.8 * expected, 1e-9 * constant.weight);
    EXPECT_NEAR(run.lost(), spring.lost(), 1e-9 * constant.weight);
  }
}

TEST(CoupledPendulum, LosesTheFrictionOfEachSpeed) {
  const CoupledPendulum element(by_rate);
  ElementRun run(element);
  run.step({20e-3, 0}, {0.2, 0}, {0.2, 0}, 0.1);
  const double before = run.lost(), h = 0.1;
  // The speed decreases linearly from 0.2 to 0.15 m/s, and the elastic deformation with the friction. The loss is the
  // sum of eight trapezoids.
  run.step({20e-3 + 0.175 * h, 0}, {0.2, 0}, {0.15, 0}, h);
  const auto force = [](double v) { return by_rate.coefficient(v) * by_rate.weight; };
  const double work = gauss_integral([&](double s) { return force(0.2 - 0.05 * s) * (0.2 - 0.05 * s) * h; }, 0, 1);
  const double released = (force(0.2) * force(0.2) - force(0.15) * force(0.15)) / (2 * by_rate.stick());
  EXPECT_NEAR(run.lost() - before, work + released, 3e-4 * work);
}

TEST(CoupledPendulum, RejectsWrongParameters) {
  SlidingFriction wrong = constant;
  wrong.weight = 0;
  EXPECT_THROW(CoupledPendulum{wrong}, std::invalid_argument);
}

TEST(CoupledPendulum, AgreesWithOpenSeesInTheElCentroEarthquake) {
  test::Book book("Mass on an isolator in two directions, both components of El Centro 1940",
                  "OpenSees, refined steps (tests/verification/opensees/bearings.py)",
                  "1e-4 of the peak; the reference is converged to 1e-5");
  const double weight = 1e5 * 9.80665;
  SlidingFriction friction = constant;
  friction.weight = weight;
  book.below("singleFPBearing, Coulomb, displacements / peak [-]",
             test::difference(test::ride(CoupledPendulum(friction), 1e5, 2e-4, 1e-4), test::pendulum), 1e-4);
  friction = by_rate;
  friction.weight = weight;
  book.below("singleFPBearing, VelDependent, displacements / peak [-]",
             test::difference(test::ride(CoupledPendulum(friction), 1e5, 2e-4, 1e-3), test::pendulum_rate), 1e-4);
}

}  // namespace coupled_pendulum_test
}  // namespace pounding
