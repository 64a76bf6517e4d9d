// Friction at closed contacts, against closed forms of sliding blocks and an independent integrator.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/links/friction.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/stepper.hpp>
#include "support/block_on_wall.hpp"
#include "support/book.hpp"
#include "support/direct.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace friction_test {

constexpr double pi = std::numbers::pi;

using test::Block;
using test::diagonal;
using test::NamedScheme;
using test::schemes;

class WithFriction : public testing::TestWithParam<NamedScheme> {
 protected:
  Scheme scheme = GetParam().scheme;
};

INSTANTIATE_TEST_SUITE_P(Schemes, WithFriction, testing::ValuesIn(schemes),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(FrictionForce, HasTheSlopesOfItsFormula) {
  using Eigen::Vector2d;
  const Friction friction{.contact = 0, .first = 1, .count = 2, .coefficient = 0.4, .sliding = 0.02};
  const auto contact_at = [](double d, double v) {
    return laws::Response{5e6 * std::pow(d, 1.5) + 2e4 * v, 7.5e6 * std::sqrt(d), 2e4};
  };
  const auto vector = [](const Sliding& s) { return Vector2d(s[0], s[1]); };
  const auto force_at = [&](double d, double v, const Vector2d& rates) {
    return vector(friction_force(friction, contact_at(d, v), {rates[0], rates[1]}).force);
  };
  const double d = 3e-3, v = 0.1;
  const Vector2d rates(0.03, -0.01);
  const FrictionForce f = friction_force(friction, contact_at(d, v), {rates[0], rates[1]});
  const double normal = contact_at(d, v).force;
  EXPECT_NEAR(vector(f.force).norm(), 0.4 * normal * rates.norm() / std::hypot(rates.norm(), 0.02), 1e-12 * normal);
  EXPECT_GT(vector(f.force).dot(rates), 0);
  const double h = 1e-7;
  const auto slope = [&](auto at) { return Vector2d((at(h) - at(-h)) / (2 * h)); };
  const Vector2d by_penetration = vector(f.by_penetration), by_rate = vector(f.by_rate);
  EXPECT_LT((slope([&](double e) { return force_at(d + e, v, rates); }) - by_penetration).norm(),
            1e-6 * by_penetration.norm());
  EXPECT_LT((slope([&](double e) { return force_at(d, v + e, rates); }) - by_rate).norm(), 1e-6 * by_rate.norm());
  for (int k = 0; k < 2; ++k) {
    const Vector2d by_sliding(f.by_sliding[0][k], f.by_sliding[1][k]);
    EXPECT_LT((slope([&](double e) { return force_at(d, v, rates + e * Vector2d::Unit(k)); }) - by_sliding).norm(),
              1e-6 * by_sliding.norm());
  }
  EXPECT_EQ(friction_force(friction, {.force = -3.0, .by_penetration = 1.0}, {rates[0], rates[1]}).force, Sliding{})
      << "a contact in tension";
}

// Distance until rest from the speed v, for the force of the formula.
double way_to_rest(double v, double sliding) {
  return Block::mass / (2 * Block::coefficient * Block::pressed) *
         (v * std::hypot(v, sliding) + sliding * sliding * std::asinh(v / sliding));
}

// Time from the speed v0 to the speed v.
double time_between(double v0, double v, double sliding) {
  const auto f = [&](double x) { return std::hypot(x, sliding) - sliding * std::asinh(sliding / x); };
  return Block::mass / (Block::coefficient * Block::pressed) * (f(v0) - f(v));
}

TEST_P(WithFriction, ABlockSlidesToRest) {
  test::Book book("Friction at closed contacts", "sliding block in closed form, friction mu N v/sqrt(v^2 + s^2)",
                  "run at tolerance 1e-5");
  const double v0 = 1.0, stop = Block::mass * v0 / (Block::coefficient * Block::pressed);
  double last = 1e300;
  for (const double sliding : {0.1, 0.01, 1e-3, 1e-5}) {
    SCOPED_TRACE(sliding);
    Block block(sliding);
    ModalSolver base(block.system);
    Stepper stepper(block.system, base, {.tolerance = 1e-5, .scheme = scheme, .max_step = 0.05});
    stepper.start(0, block.u, v0 * Eigen::VectorXd::Unit(2, 1));
    long tries = test::march(stepper, 0.5 * stop, 0.05);
    book.near("time to an intermediate speed [s]", time_between(v0, stepper.view().state().v[1], sliding), 0.5 * stop,
              1e-5 * stop);
    book.near("friction force [N]", stepper.view().state().force[1],
              Block::coefficient * Block::pressed / std::hypot(1, sliding / stepper.view().state().v[1]),
              1e-4 * Block::pressed);
    tries += test::march(stepper, 3 * stop, 0.05);
    book.near("distance to rest [m]", stepper.view().state().u[1], way_to_rest(v0, sliding),
              2e-5 * way_to_rest(v0, sliding));
    book.below("speed after that [m/s]", std::abs(stepper.view().state().v[1]), 1e-5);
    const double coulomb = 0.5 * v0 * stop, off = std::abs(stepper.view().state().u[1] - coulomb);
    EXPECT_LT(off, last) << "closer to Coulomb's law for a smaller sliding velocity";
    last = std::max(off, 2e-5 * coulomb);
    book.near("work of the friction [J]", stepper.view().friction_work()[0], 0.5 * Block::mass * v0 * v0,
              1e-4 * Block::mass);
    EXPECT_LT(tries, 20000) << "the transition to rest must not stall the steps";
  }
}

TEST_P(WithFriction, SlidingInTwoDirectionsKeepsItsDirection) {
  const double sliding = 0.01, end = 0.6;
  Block plane(sliding, 1), space(sliding, 2);
  const auto run = [&](Block& block, const Eigen::VectorXd& v) {
    ModalSolver base(block.system);
    Stepper stepper(block.system, base, {.tolerance = 1e-6, .scheme = scheme, .max_step = 0.01});
    stepper.start(0, block.u, v);
    test::march(stepper, end, 0.01);
    return stepper.view().state();
  };
  const State one = run(plane, Eigen::Vector2d(0, 1)), two = run(space, Eigen::Vector3d(0, 0.6, -0.8));
  EXPECT_NEAR(two.u[1], 0.6 * one.u[1], 1e-6);
  EXPECT_NEAR(two.u[2], -0.8 * one.u[1], 1e-6);
  EXPECT_NEAR(two.v[1], 0.6 * one.v[1], 1e-6);
  EXPECT_NEAR(two.v[2], -0.8 * one.v[1], 1e-6);
}

// A wall that slides along the block drags it; the force does work on the ground.
TEST_P(WithFriction, AWallThatSlidesTakesTheBlockAlong) {
  test::Book book("Friction at closed contacts", "a sliding wall drags a block: F t/m, then its speed",
                  "the wall accelerates over a short time; then the tolerance 1e-6");
  const double sliding = 1e-3, speed = 0.5, acceleration = 10;
  Block block(sliding);
  block.system.grounds = {GroundMotion(Pulse{Pulse::Shape::rectangle, -acceleration, speed / acceleration})};
  block.system.load = Eigen::MatrixXd::Zero(2, 1);
  block.system.gap_by_ground = Eigen::Vector2d(0, 1);
  ModalSolver base(block.system);
  Stepper stepper(block.system, base, {.tolerance = 1e-6, .scheme = scheme, .max_step = 0.02});
  stepper.start(0, block.u, Eigen::Vector2d::Zero());
  test::march(stepper, 0.2, 0.02);
  // For a wall with a sudden velocity it would be F t / m; here the wall accelerates over a short time.
  const double force = Block::coefficient * Block::pressed;
  book.near("intermediate speed [m/s]", stepper.view().state().v[1], force / Block::mass * 0.2,
            0.01 * force / Block::mass * 0.2);
  test::march(stepper, 2, 0.02);
  book.near("final speed [m/s]", stepper.view().state().v[1], speed, 1e-6);
  const Energies e = stepper.view().energies();
  EXPECT_NEAR(e.input, e.kinetic + e.strain + e.impact, 1e-5 * e.kinetic);
  EXPECT_GT(stepper.view().friction_work()[0], 0.4 * e.kinetic);
}

// An oblique impact of two masses in the plane: the normal is inclined, so that normal and friction forces are coupled
// through both springs of each mass.
struct Oblique {
  static constexpr double mass[] = {1e5, 1.3e5}, period_x[] = {0.8, 0.5}, period_z[] = {0.3, 0.17}, gap = 0.02,
                          angle = 0.4;
  static constexpr double stiffness = 2.75e9, coefficient = 0.5, sliding = 0.02, amplitude = 4, ground_period = 0.6,
                          delay = 0.11;
  GapContact<laws::Hertz> link{laws::Hertz{.stiffness = stiffness}, gap};
  System system;

  static double spring(int i) {
    const double w = 2 * pi / (i % 2 == 0 ? period_x : period_z)[i / 2];
    return mass[i / 2] * w * w;
  }

  Oblique() {
    const double c = std::cos(angle), s = std::sin(angle);
    std::vector<double> m, k, d;
    for (int i = 0; i < 4; ++i) {
      m.push_back(mass[i / 2]);
      k.push_back(spring(i));
      d.push_back(0.05 * 2 * std::sqrt(k[i] * m[i]));
      system.groups.push_back({i, 1, 1e-4, 1e-3});
    }
    system.mass = diagonal(m);
    system.stiffness = diagonal(k);
    system.damping = diagonal(d);
    Eigen::Matrix<double, 4, 2> closing;
    closing << c, -s, s, c, -c, s, -s, -c;
    system.gap_jacobian = closing.sparseView();
    system.contacts = {&link};
    system.frictions = {{.contact = 0, .first = 1, .count = 1, .coefficient = coefficient, .sliding = sliding}};
    const GroundMotion motion(Harmonic{amplitude, ground_period, 10});
    system.grounds = {motion, motion.delayed(delay)};
    system.load = Eigen::MatrixXd::Zero(4, 2);
    system.load(0, 0) = mass[0];
    system.load(2, 1) = mass[1];
    system.gap_by_ground.resize(2, 2);
    system.gap_by_ground << c, -c, -s, s;
  }

  // u and v of the four unknowns, d and v of both grounds, work of the friction.
  static Eigen::VectorXd direct(double end) {
    const Oblique problem;
    const Eigen::MatrixXd closing = problem.system.gap_jacobian;
    const auto ground = [](double t) { return t >= 0 ? amplitude * std::sin(2 * pi * t / ground_period) : 0.0; };
    const auto f = [&](double t, const Eigen::VectorXd& y) {
      Eigen::VectorXd out(13);
      const double a[] = {ground(t), ground(t - delay)};
      // Absolute from relative: x moves with the ground of its mass.
      Eigen::Vector4d x = y.head(4), v = y.segment(4, 4);
      for (int i = 0; i < 2; ++i) x[2 * i] += y[8 + i], v[2 * i] += y[10 + i];
      const double overlap = closing.col(0).dot(x) - gap, slip = closing.col(1).dot(v);
      const double normal = overlap > 0 ? stiffness * std::pow(overlap, 1.5) : 0;
      const double along = coefficient * normal * slip / std::hypot(slip, sliding);
      for (int i = 0; i < 4; ++i) {
        const double k = spring(i), m = mass[i / 2];
        out[i] = y[4 + i];
        out[4 + i] =
            -(k * y[i] + 0.1 * std::sqrt(k * m) * y[4 + i] + closing(i, 0) * normal + closing(i, 1) * along) / m -
            (i % 2 == 0 ? a[i / 2] : 0.0);
      }
      for (int i = 0; i < 2; ++i) out[8 + i] = y[10 + i], out[10 + i] = a[i];
      out[12] = along * slip / 1e6;
      return out;
    };
    return test::integrate(f, Eigen::VectorXd::Zero(13), 0, end, 0.1, {delay});
  }
};

TEST_P(WithFriction, AnObliqueImpactIsThatOfAnIndependentIntegration) {
  test::Book book("Friction at closed contacts", "independent integration of an oblique impact in absolute coordinates",
                  "run at tolerance 1e-6, error ten times as large after three impacts");
  const double end = 1.5;
  static const Eigen::VectorXd expected = Oblique::direct(end);
  Oblique problem;
  ModalSolver base(problem.system);
  Stepper stepper(problem.system, base, {.tolerance = 1e-6, .scheme = scheme, .max_step = 0.01});
  stepper.start(0, Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero());
  test::march(stepper, end, 0.01);
  EXPECT_GE(stepper.view().memory().contacts[0].impacts().size(), 3u);
  book.below("oblique impact: displacements, difference over size [-]",
             (stepper.view().state().u - expected.head(4)).norm(), 1e-5 * expected.head(4).norm());
  book.below("oblique impact: velocities, difference over size [-]",
             (stepper.view().state().v - expected.segment(4, 4)).norm(), 1e-5 * expected.segment(4, 4).norm());
  const double lost = 1e6 * expected[12];
  EXPECT_GT(lost, 1e3);
  book.near("oblique impact: work of the friction [J]", stepper.view().friction_work()[0], lost, 1e-5 * lost);
  const Energies e = stepper.view().energies();
  EXPECT_NEAR(e.input, e.kinetic + e.strain + e.damping + e.impact, 1e-5 * lost);
  EXPECT_DOUBLE_EQ(e.impact, stepper.view().friction_work()[0] + stepper.view().memory().contacts[0].log.work());
}

// Constant normal force, so that friction is smooth: the block on a spring decelerates.
TEST_P(WithFriction, StepsKeepTheirOrder) {
  test::Book book("Friction at closed contacts", "order of the scheme, against an independent integration",
                  "the next order of the error");
  const double sliding = 0.3, k = 8e4, end = 0.8;
  const auto f = [&](double, const Eigen::VectorXd& y) {
    Eigen::VectorXd out(2);
    out << y[1], -(k * y[0] + Block::coefficient * Block::pressed * y[1] / std::hypot(y[1], sliding)) / Block::mass;
    return out;
  };
  const Eigen::VectorXd expected = test::integrate(f, Eigen::Vector2d(0, 1), 0, end, 1, {});
  std::vector<double> errors;
  for (double h = end / 16; h > end / 200; h /= 2) {
    Block block(sliding);
    block.system.stiffness.coeffRef(1, 1) = k;
    ModalSolver base(block.system);
    Stepper stepper(block.system, base, {.tolerance = 1e-3, .scheme = scheme, .max_step = h});
    stepper.start(0, block.u, Eigen::Vector2d(0, 1));
    test::march_evenly(stepper, end, h);
    errors.push_back((Eigen::Vector2d(stepper.view().state().u[1], 0.2 * stepper.view().state().v[1]) -
                      Eigen::Vector2d(expected[0], 0.2 * expected[1]))
                         .norm());
  }
  book.near("observed order with friction [-]", std::log2(errors[errors.size() - 2] / errors.back()), GetParam().order,
            0.3);
}

std::vector<std::uint64_t> bits_of(const Stepper& stepper) {
  std::vector<double> all;
  const auto add = [&](const auto& values) { all.insert(all.end(), values.data(), values.data() + values.size()); };
  for (const State* state : {&stepper.view().state(), &stepper.view().begin(), &stepper.view().end_minus()}) {
    all.push_back(state->time);
    add(state->u), add(state->v), add(state->a), add(state->force);
  }
  const Energies e = stepper.view().energies();
  for (const double value : {e.input, e.kinetic, e.strain, e.damping, e.impact, stepper.view().friction_work()[0]})
    all.push_back(value);
  std::vector<std::uint64_t> bits;
  for (const double value : all) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

TEST_P(WithFriction, AnArchiveGoesOnWithTheSameBits) {
  Oblique whole, continued;
  ModalSolver base(whole.system), second(continued.system);
  const StepperOptions options{.tolerance = 1e-5, .scheme = scheme, .max_step = 0.01};
  Stepper first(whole.system, base, options), other(continued.system, second, options);
  first.start(0, Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero());
  for (double t = 0.1007; !first.view().in_contact(); t += 2e-3) test::march(first, t, 0.01);
  other.restore(first.save());
  EXPECT_EQ(bits_of(first), bits_of(other));
  const double end = first.view().time() + 0.7;
  test::march(first, end, 0.01);
  test::march(other, end, 0.01);
  EXPECT_EQ(bits_of(first), bits_of(other));
}

TEST(Friction, IsRefusedWhereItCannotWork) {
  const auto text_of = [](auto change) {
    Block block(0.01);
    change(block.system);
    try {
      ModalSolver base(block.system);
      const Stepper stepper(block.system, base, {.max_step = 0.01});
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const RigidContact rigid(0.5, 0.0);
  EXPECT_EQ(text_of([](System&) {}), "");
  EXPECT_TRUE(test::mentions(text_of([&](System& s) { s.contacts = {&rigid}; }), {"friction"}));
  EXPECT_TRUE(test::mentions(text_of([](System& s) { s.frictions[0].sliding = 0; }), {"friction"}));
  EXPECT_TRUE(test::mentions(text_of([](System& s) { s.frictions[0].coefficient = -0.1; }), {"friction"}));
  EXPECT_TRUE(test::mentions(text_of([](System& s) { s.frictions[0].contact = 1; }), {"friction"}));
  EXPECT_TRUE(test::mentions(text_of([](System& s) { s.frictions[0].count = 2; }), {"gap_jacobian"}));
  EXPECT_TRUE(test::mentions(text_of([](System& s) { s.frictions.push_back(s.frictions[0]); }), {"gap_jacobian"}));
  EXPECT_TRUE(test::mentions(text_of([](System& s) { s.frictions.clear(); }), {"gap_jacobian"}));
}

}  // namespace friction_test
}  // namespace pounding
