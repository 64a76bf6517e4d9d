// Multiple-support excitation, and relative displacements from ground motion and gravity, against integration in
// absolute coordinates and closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/stepper.hpp>
#include "support/book.hpp"
#include "support/direct.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace moving_ground_test {

constexpr double pi = std::numbers::pi;

using test::diagonal;
using test::NamedScheme;
using test::schemes;

class MovingGround : public testing::TestWithParam<NamedScheme> {
 protected:
  Scheme scheme = GetParam().scheme;
};

INSTANTIATE_TEST_SUITE_P(Schemes, MovingGround, testing::ValuesIn(schemes),
                         [](const auto& test) { return std::string(test.param.name); });

// Two oscillators with a Hertz link; a harmonic motion arrives at the right one with a delay.
struct Delayed {
  static constexpr double mass[] = {1e5, 1.5e5}, period[] = {0.8, 0.4}, ratio = 0.05, gap = 0.02, stiffness = 2.75e9;
  static constexpr double amplitude = 3, ground_period = 0.6, duration = 1.5, delay = 0.13, end = 3;
  GapContact<laws::Hertz> link{laws::Hertz{.stiffness = stiffness}, gap};
  System system;

  explicit Delayed(double later = delay) {
    std::vector<double> k, c;
    for (int i = 0; i < 2; ++i) {
      const double w = 2 * pi / period[i];
      k.push_back(mass[i] * w * w);
      c.push_back(2 * ratio * w * mass[i]);
      system.groups.push_back({i, 1, 1e-4, 1e-3});
    }
    system.mass = diagonal({mass[0], mass[1]});
    system.stiffness = diagonal(k);
    system.damping = diagonal(c);
    system.gap_jacobian = Eigen::MatrixXd(Eigen::Vector2d(1, -1)).sparseView();
    system.contacts = {&link};
    const GroundMotion motion(Harmonic{amplitude, ground_period, duration});
    system.grounds = {motion, motion.delayed(later)};
    system.load = Eigen::Vector2d(mass[0], mass[1]).asDiagonal();
    system.gap_by_ground = Eigen::RowVector2d(1, -1);
    system.outputs = diagonal({1, 1});
  }

  // Absolute x1 x2 v1 v2 of the masses and of their grounds at the end.
  static Eigen::VectorXd direct() {
    const auto ground = [](double t) {
      return t >= 0 && t < duration ? amplitude * std::sin(2 * pi * t / ground_period) : 0.0;
    };
    const auto f = [&](double t, const Eigen::VectorXd& y) {
      Eigen::VectorXd out(8);
      out << y[2], y[3], 0, 0, y[6], y[7], ground(t), ground(t - delay);
      const double overlap = y[0] - y[1] - gap, force = overlap > 0 ? stiffness * std::pow(overlap, 1.5) : 0;
      for (int i = 0; i < 2; ++i) {
        const double w = 2 * pi / period[i];
        out[2 + i] =
            -w * w * (y[i] - y[4 + i]) - 2 * ratio * w * (y[2 + i] - y[6 + i]) + (i == 0 ? -1 : 1) * force / mass[i];
      }
      return out;
    };
    return test::integrate(f, Eigen::VectorXd::Zero(8), 0, end, 0.1, {duration, delay, duration + delay});
  }
};

TEST_P(MovingGround, TwoOscillatorsMoveAsInAbsoluteCoordinates) {
  test::Book book("Multiple-support excitation",
                  "independent integration in absolute coordinates of two oscillators, the motion delayed at one",
                  "run at tolerance 1e-6");
  static const Eigen::VectorXd expected = Delayed::direct();
  Delayed problem;
  ModalSolver base(problem.system);
  Stepper stepper(problem.system, base, {.tolerance = 1e-6, .scheme = scheme, .max_step = 0.01});
  stepper.start(0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero());
  test::march(stepper, Delayed::end, 0.01);
  EXPECT_GE(stepper.view().memory().contacts[0].impacts().size(), 4u);
  const Eigen::MatrixXd& motion = stepper.view().outputs().motion;
  for (int i = 0; i < 2; ++i) {
    book.near("absolute displacement [m]", motion(i, 0) + problem.system.grounds[i].displacement(Delayed::end),
              expected[i], 1e-6);
    book.near("absolute velocity [m/s]", motion(i, 1) + problem.system.grounds[i].velocity(Delayed::end),
              expected[2 + i], 1e-5);
  }
  const Energies e = stepper.view().energies();
  EXPECT_NEAR(e.input, e.kinetic + e.strain + e.damping + e.impact, 1e-6 * e.damping);
}

TEST(OneMotion, GivenAsTwoIsTheSame) {
  Delayed as_two(0), as_one(0);
  as_one.system.grounds.pop_back();
  as_one.system.load = Eigen::MatrixXd(as_one.system.load.rowwise().sum());
  as_one.system.gap_by_ground.resize(0, 0);
  const auto run = [](Delayed& problem) {
    ModalSolver base(problem.system);
    Stepper stepper(problem.system, base, {.tolerance = 1e-4, .max_step = 0.01});
    stepper.start(0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero());
    test::march(stepper, 1.0, 0.01);
    return stepper.view().state();
  };
  const State two = run(as_two), one = run(as_one);
  EXPECT_LT((two.u - one.u).norm(), 1e-9 * one.u.norm());
  EXPECT_LT((two.v - one.v).norm(), 1e-9 * one.v.norm());
}

// 0.07 + 0.08 is the next floating-point number after 0.15: no step fits between the two jumps, and none is needed.
TEST_P(MovingGround, JumpsThatOnlyRoundingKeepsApartAreOne) {
  const GroundMotion motion(Pulse{Pulse::Shape::rectangle, 3, 0.4});
  const GroundMotion once = motion.delayed(0.15), twice = motion.delayed(0.07).delayed(0.08);
  ASSERT_EQ(twice.next_break(0), std::nextafter(once.next_break(0), 1));
  const auto run = [this](const GroundMotion& left, const GroundMotion& right) {
    Delayed problem;
    problem.system.grounds = {left, right};
    ModalSolver base(problem.system);
    Stepper stepper(problem.system, base, {.tolerance = 1e-5, .scheme = scheme, .max_step = 0.01});
    stepper.start(0, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero());
    test::march(stepper, 1.0, 0.01);
    return stepper.view().state();
  };
  const State equal = run(once, once), first = run(once, twice), last = run(twice, once);
  for (const State* each : {&first, &last}) {
    EXPECT_LT((each->u - equal.u).norm(), 1e-9 * equal.u.norm());
    EXPECT_LT((each->v - equal.v).norm(), 1e-9 * equal.v.norm());
  }
}

// A mass at rest on fixed ground; a wall on its right moves with other ground.
struct BeforeWall {
  static constexpr double mass = 6e4;
  std::unique_ptr<const Contact> contact;
  System system;

  BeforeWall(std::unique_ptr<const Contact> link, const GroundMotion& motion, double spring = 0)
      : contact(std::move(link)) {
    system.mass = diagonal({mass});
    system.damping = SparseMatrix(1, 1);
    system.stiffness = diagonal({spring});
    system.gap_jacobian = diagonal({1});
    system.contacts = {contact.get()};
    system.groups = {{0, 1, 1e-4, 1e-3}};
    system.grounds = {motion};
    system.load = Eigen::MatrixXd::Zero(1, 1);
    system.gap_by_ground = Eigen::MatrixXd::Constant(1, 1, -1);
    system.outputs = diagonal({1});
  }
};

// A pulse of 0.1 s gives the wall 0.1 m/s towards the mass; it closes the gap of 20 mm at 0.25 s.
const GroundMotion towards(Pulse{Pulse::Shape::rectangle, -1, 0.1});

TEST_P(MovingGround, AWallThatDriftsThrowsARigidMassAhead) {
  test::Book book("Multiple-support excitation",
                  "a wall that drifts at 0.1 m/s throws a rigid mass ahead, e = 0.6: impulse times the velocity of "
                  "the wall",
                  "round-off");
  const double restitution = 0.6;
  BeforeWall problem(std::make_unique<RigidContact>(restitution, 0.02), towards);
  ModalSolver base(problem.system);
  Stepper stepper(problem.system, base, {.tolerance = 1e-5, .scheme = scheme, .max_step = 0.05});
  stepper.start(0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));
  test::march(stepper, 1, 0.05);
  ASSERT_EQ(stepper.view().memory().contacts[0].impacts().size(), 1u);
  const ImpactRow& impact = stepper.view().memory().contacts[0].impacts()[0];
  book.near("touch [s]", impact.t_start, 0.25, 1e-11);
  book.near("approach [m/s]", impact.v_approach, 0.1, 1e-12);
  book.near("speed after it [m/s]", stepper.view().state().v[0], -0.16, 1e-12);
  book.near("displacement at 1 s [m]", stepper.view().state().u[0], -0.16 * 0.75, 1e-10);
  const Energies e = stepper.view().energies();
  book.near("kinetic energy [J]", e.kinetic, 0.5 * BeforeWall::mass * 0.16 * 0.16, 1e-7);
  book.near("input [J]", e.input, BeforeWall::mass * 0.16 * 0.1, 1e-7);
  book.near("energy lost [J]", e.impact, 0.5 * BeforeWall::mass * 0.01 * (1 - restitution * restitution), 1e-7);
}

TEST_P(MovingGround, AWallThatDriftsThrowsAnElasticMassAhead) {
  test::Book book("Multiple-support excitation",
                  "a wall that drifts at 0.1 m/s throws a mass ahead by a linear spring: half a period of contact",
                  "run at tolerance 1e-6");
  const double stiffness = 9.35e7;
  BeforeWall problem(std::make_unique<GapContact<laws::LinearSpring>>(laws::LinearSpring{.stiffness = stiffness}, 0.02),
                     towards);
  ModalSolver base(problem.system);
  Stepper stepper(problem.system, base, {.tolerance = 1e-6, .scheme = scheme, .max_step = 0.05});
  stepper.start(0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));
  test::march(stepper, 1, 0.05);
  ASSERT_EQ(stepper.view().memory().contacts[0].impacts().size(), 1u);
  const ImpactRow& impact = stepper.view().memory().contacts[0].impacts()[0];
  const double w = std::sqrt(stiffness / BeforeWall::mass);
  book.near("touch [s]", impact.t_start, 0.25, 1e-11);
  book.near("separation [s]", impact.t_end, 0.25 + pi / w, 1e-7);
  book.near("largest penetration [m]", impact.peak_penetration, 0.1 / w, 1e-6 * 0.1 / w);
  book.near("speed after it [m/s]", stepper.view().state().v[0], -0.2, 1e-7);
  const Energies e = stepper.view().energies();
  book.near("input [J]", e.input, 0.5 * BeforeWall::mass * 0.04, 1e-6 * e.input);
  EXPECT_NEAR(e.input, e.kinetic + e.impact, 1e-6 * e.input);
}

// The wall pushes the mass while it accelerates and separates from it when it decelerates.
TEST_P(MovingGround, AMassRestsOnAWallThatAccelerates) {
  test::Book book("Multiple-support excitation", "a mass that a wall pushes while it gains speed: m a, then A T/pi",
                  "run at tolerance 1e-5");
  const double amplitude = 2, duration = 0.8, half = duration / 2;
  BeforeWall problem(std::make_unique<RigidContact>(0.5, 0.0),
                     GroundMotion(Pulse{Pulse::Shape::sine, -amplitude, duration}));
  ModalSolver base(problem.system);
  Stepper stepper(problem.system, base, {.tolerance = 1e-5, .scheme = scheme, .max_step = 0.02});
  stepper.start(0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));
  test::march(stepper, 0.3, 0.02);
  EXPECT_EQ(stepper.view().memory().contacts[0].phase(), ContactPhase::resting);
  book.near("displacement while it rests [m]", stepper.view().state().u[0], problem.system.grounds[0].displacement(0.3),
            1e-14);
  book.near("force while it rests [N]", stepper.view().state().force[0],
            BeforeWall::mass * amplitude * std::sin(2 * pi * 0.3 / duration), 1e-6 * BeforeWall::mass * amplitude);
  test::march(stepper, 1, 0.02);
  EXPECT_EQ(stepper.view().memory().contacts[0].phase(), ContactPhase::open);
  const double speed = amplitude * duration / pi, way = amplitude * duration / (2 * pi) * half;
  book.near("speed after that [m/s]", stepper.view().state().v[0], -speed, 1e-6 * speed);
  book.near("displacement after that [m]", stepper.view().state().u[0], -way - speed * (1 - half), 1e-6 * speed);
  const Energies e = stepper.view().energies();
  EXPECT_NEAR(e.input, e.kinetic + e.impact, 1e-5 * e.kinetic);
  book.near("kinetic energy [J]", e.kinetic, 0.5 * BeforeWall::mass * speed * speed, 1e-5 * e.kinetic);
}

TEST_P(MovingGround, WhatGravityHasClosedIsMissingInTheGap) {
  const auto run = [&](double gap, double closed) {
    BeforeWall problem(std::make_unique<GapContact<laws::Hertz>>(laws::Hertz{.stiffness = 2.75e9}, gap), {});
    problem.system.gap_by_ground.resize(0, 0);
    if (closed != 0) problem.system.gravity_offset = Eigen::VectorXd::Constant(1, closed);
    ModalSolver base(problem.system);
    Stepper stepper(problem.system, base, {.tolerance = 1e-6, .scheme = scheme, .max_step = 0.01});
    stepper.start(0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
    test::march(stepper, 0.1, 0.01);
    return std::pair(stepper.view().state().v[0], stepper.view().memory().contacts[0].impacts()[0].t_start);
  };
  const auto [speed, touch] = run(0.02, 0.005);
  const auto [expected_speed, expected_touch] = run(0.015, 0);
  EXPECT_NEAR(touch, 0.015, 1e-12);
  EXPECT_NEAR(speed, expected_speed, 1e-9);
  EXPECT_NEAR(touch, expected_touch, 1e-12);
}

// A mass on a spring that gravity presses on a spring at the wall, which moves harmonically: linear while they are in
// contact.
TEST_P(MovingGround, StepsKeepTheirOrder) {
  test::Book book("Multiple-support excitation", "order of the scheme, against an independent integration",
                  "the next order of the error");
  const double k = 4e6, contact = 6e6, closed = 0.05, amplitude = 0.4, period = 0.5, end = 0.45;
  const double rest = -contact * closed / (k + contact);
  const auto expected = [&] {
    const auto f = [&](double t, const Eigen::VectorXd& y) {
      Eigen::VectorXd out(4);
      out << y[1], -(k * y[0] + contact * (y[0] - y[2] + closed)) / BeforeWall::mass, y[3],
          amplitude * std::sin(2 * pi * t / period);
      return out;
    };
    return test::integrate(f, rest * Eigen::VectorXd::Unit(4, 0), 0, end, 0.01, {});
  }();
  std::vector<double> errors;
  for (double h = end / 16; h > end / 100; h /= 2) {
    BeforeWall problem(std::make_unique<GapContact<laws::LinearSpring>>(laws::LinearSpring{.stiffness = contact}, 0.0),
                       GroundMotion(Harmonic{amplitude, period, 10}), k);
    problem.system.gravity_offset = Eigen::VectorXd::Constant(1, closed);
    ModalSolver base(problem.system);
    Stepper stepper(problem.system, base, {.tolerance = 1e-3, .scheme = scheme, .max_step = h});
    stepper.start(0, Eigen::VectorXd::Constant(1, rest), Eigen::VectorXd::Zero(1));
    test::march_evenly(stepper, end, h);
    EXPECT_TRUE(presses(stepper.view().memory().contacts[0].phase()));
    errors.push_back(
        std::hypot(stepper.view().state().u[0] - expected[0], 0.1 * (stepper.view().state().v[0] - expected[1])));
  }
  book.near("observed order on a moving ground [-]", std::log2(errors[errors.size() - 2] / errors.back()),
            GetParam().order, 0.25);
}

// At every time that a report may need.
TEST_P(MovingGround, ObservedIsThatOfTheWholeState) {
  Delayed problem;
  Eigen::MatrixXd rows(2, 3);
  rows << 1, 0.5, 0, 0, -2, 3;
  problem.system.outputs = rows.sparseView();
  ModalSolver base(problem.system);
  Stepper stepper(problem.system, base, {.tolerance = 1e-4, .scheme = scheme, .max_step = 0.01});
  stepper.start(0, Eigen::Vector2d(0.001, 0), Eigen::Vector2d(0, 0.02));
  const auto expect_same = [&](const OutputQuantities& seen, const State& state) {
    EXPECT_EQ(seen.time, state.time);
    Eigen::MatrixXd whole(2, 3), difference;
    whole << state.u, state.v, state.a;
    difference = seen.motion - rows.transpose() * whole;
    for (int j = 0; j < 3; ++j) EXPECT_LT(difference.col(j).norm(), 1e-13 * (1 + whole.col(j).norm()));
  };
  StepController controller(stepper);
  FixedSteps policy;
  long events = 0;
  for (int step = 0; step < 400; ++step) {
    if (step % 3 == 0)
      expect_same(stepper.view().outputs(),
                  stepper.view().state());  // not at each step, so that stale values would be noticed
    controller.advance(2e-3, 1e9, policy);
    if (step % 2 == 1 && stepper.view().events() == events) continue;
    events = stepper.view().events();
    expect_same(stepper.view().outputs_begin(), stepper.view().begin());
    expect_same(stepper.view().outputs_end_minus(), stepper.view().end_minus());
    State inside;
    inside.time = 0.3 * stepper.view().begin().time + 0.7 * stepper.view().end_minus().time;
    stepper.view().interpolate(inside.time, inside.u, inside.v);
    stepper.view().interpolate_acceleration(inside.time, inside.a);
    OutputQuantities seen{inside.time, {}};
    stepper.view().interpolate_outputs(inside.time, seen.motion);
    expect_same(seen, inside);
  }
  EXPECT_GT(events, 4);
}

TEST(Stepper, RefusesPartsThatDoNotFit) {
  const auto text_of = [](auto change) {
    Delayed problem;
    change(problem.system);
    try {
      ModalSolver base(problem.system);
      const Stepper stepper(problem.system, base, {.max_step = 0.01});
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(text_of([](System&) {}), "");
  EXPECT_TRUE(test::mentions(text_of([](System& s) { s.grounds.pop_back(); }), {"ground"}));
  EXPECT_TRUE(
      test::mentions(text_of([](System& s) { s.gap_by_ground = Eigen::MatrixXd::Ones(1, 1); }), {"gap_by_ground"}));
  EXPECT_TRUE(
      test::mentions(text_of([](System& s) { s.gravity_offset = Eigen::VectorXd::Ones(2); }), {"gravity_offset"}));
}

}  // namespace moving_ground_test
}  // namespace pounding
