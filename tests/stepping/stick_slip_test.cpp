// Friction with a tangential stiffness, against closed forms and an independent integration with very short steps.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/links/friction.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/stepper.hpp>
#include "support/block_on_wall.hpp"
#include "support/book.hpp"
#include "support/direct.hpp"

namespace pounding {
namespace stick_slip_test {

using Eigen::Vector2d, Eigen::Vector3d;
using test::Block;
using test::NamedScheme;

class StickSlip : public testing::TestWithParam<NamedScheme> {
 protected:
  Scheme scheme = GetParam().scheme;
};

INSTANTIATE_TEST_SUITE_P(Schemes, StickSlip, testing::Values(test::schemes[2]),
                         [](const auto& test) { return std::string(test.param.name); });

constexpr double limit = Block::coefficient * Block::pressed;  // 2.4 kN
constexpr double stiffness = 8e6;                              // tangential [N/m]

void stiffen(Block& block, double k = stiffness) { block.system.frictions[0].stiffness = k; }

// Contact of a law with a force in which a friction is evaluated.
struct Pressed {
  GapContact<laws::Hertz> link{laws::Hertz{.stiffness = 5e6}, 0.0};

  static laws::Response response(const LinkMotion& at) {
    const double d = at.penetration;
    return {5e6 * std::pow(d, 1.5) + 2e4 * at.rate, 7.5e6 * std::sqrt(d), 2e4};
  }
  FrictionForce force(const Friction& friction, const LinkMotion& normal, const TangentialMotion& along) const {
    return friction_force(friction, link, normal, response(normal), along);
  }
};

TEST(StickSlipForce, HasTheSlopesOfItsFormula) {
  const Pressed pressed;
  const LinkMotion normal{3e-3, 0.1};
  for (const double ratio : {0.0, 0.8})
    for (const double lag : {0.0, 2e-3})
      for (const double size : {1e-5, 2e-2}) {
        SCOPED_TRACE(testing::Message() << ratio << ' ' << lag << ' ' << size);
        Friction friction{.first = 1, .count = 2, .coefficient = 0.3, .static_coefficient = 0.5, .stribeck = 0.05};
        (ratio > 0 ? friction.ratio : friction.stiffness) = ratio > 0 ? ratio : 4e5;
        const TangentialMotion along{{size, -0.4 * size}, {0.03, -0.01}, {0.1 * size, 0}, lag};
        const FrictionForce f = pressed.force(friction, normal, along);
        EXPECT_EQ(f.slips, size > 1e-3);
        const double all = std::hypot(f.force[0], f.force[1]);
        EXPECT_GT(all, 0);
        for (int i = 0; i < 2; ++i) {
          const auto slope = [&](auto change, double h) {
            LinkMotion n[2]{normal, normal};
            TangentialMotion t[2]{along, along};
            change(n[0], t[0], -h);
            change(n[1], t[1], h);
            return (pressed.force(friction, n[1], t[1]).force[i] - pressed.force(friction, n[0], t[0]).force[i]) /
                   (2 * h);
          };
          EXPECT_NEAR(f.by_penetration[i], slope([](auto& n, auto&, double h) { n.penetration += h; }, 1e-7),
                      1e-5 * all / normal.penetration);
          EXPECT_NEAR(f.by_rate[i], slope([](auto& n, auto&, double h) { n.rate += h; }, 1e-5), 1e-6 * all / 0.1);
          for (int j = 0; j < 2; ++j) {
            EXPECT_NEAR(f.by_displacement[i][j],
                        slope([j](auto&, auto& t, double h) { t.displacement[j] += h; }, 1e-4 * size),
                        1e-6 * all / size);
            EXPECT_NEAR(f.by_sliding[i][j], slope([j](auto&, auto& t, double h) { t.rate[j] += h; }, 1e-6),
                        1e-6 * all / 0.01);
          }
        }
      }
}

TEST(StickSlipForce, HasTheSlipOfItsStage) {
  const Pressed pressed;
  const Friction friction{.first = 1, .count = 1, .coefficient = 0.3, .stiffness = 4e5};
  const LinkMotion normal{3e-3, 0};
  const double lag = 2e-3, capacity = 0.3 * Pressed::response(normal).force;
  const FrictionForce sliding = pressed.force(friction, normal, {{0.02, 0}, {1, 0}, {0, 0}, lag});
  EXPECT_NEAR(sliding.force[0], capacity, 1e-12 * capacity);
  EXPECT_NEAR(friction.stiffness * (0.02 - lag * sliding.slip_rate[0]), capacity, 1e-9 * capacity);
  EXPECT_EQ(pressed.force(friction, normal, {{1e-5, 0}, {1, 0}, {0, 0}, lag}).slip_rate[0], 0);
  EXPECT_EQ(pressed.force(friction, {-1e-3, 0}, {{0.02, 0}, {1, 0}, {0, 0}, lag}).force[0], 0) << "an open contact";
}

// The block stretches the spring, slides to rest and swings on the spring: all in closed form.
TEST_P(StickSlip, ABlockSlidesToRestAndSwings) {
  test::Book book("Friction with a tangential stiffness", "block on an elastic slider in closed form",
                  "run at tolerance 1e-6");
  const double v0 = 0.2, w = std::sqrt(stiffness / Block::mass), stretch = limit / stiffness,
               begins = std::asin(stretch * w / v0) / w, v1 = v0 * std::cos(w * begins),
               decelerates = v1 * Block::mass / limit, stop = begins + decelerates,
               way = stretch + 0.5 * v1 * decelerates, end = stop + 0.3;
  Block block(0);
  stiffen(block);
  ModalSolver base(block.system);
  Stepper stepper(block.system, base, {.tolerance = 1e-6, .scheme = scheme, .max_step = 0.02});
  stepper.start(0, block.u, v0 * Vector2d::Unit(1));
  long tries = test::march(stepper, 0.5 * begins, 0.02);
  book.near("displacement while it sticks [m]", stepper.view().state().u[1], v0 / w * std::sin(0.5 * w * begins),
            1e-5 * stretch);
  book.near("stored energy while it sticks [J]", stepper.view().friction_stored()[0], stepper.view().friction_work()[0],
            1e-5 * stepper.view().friction_work()[0]);
  tries += test::march(stepper, begins + 0.5 * decelerates, 0.02);
  book.near("speed while it slides [m/s]", stepper.view().state().v[1], 0.5 * v1, 1e-5 * v0);
  tries += test::march(stepper, end, 0.02);
  book.near("displacement after the stop [m]", stepper.view().state().u[1],
            way - stretch + stretch * std::cos(w * (end - stop)), 2e-5 * way);
  const double lost = 0.5 * Block::mass * v0 * v0 - 0.5 * stiffness * stretch * stretch;
  book.near("energy lost [J]", stepper.view().friction_work()[0] - stepper.view().friction_stored()[0], lost,
            2e-5 * lost);
  const Energies e = stepper.view().energies();
  EXPECT_NEAR(e.imbalance(), 0, 1e-5 * lost);
  EXPECT_LT(tries, 3000);
}

// A block in the plane of the contact on springs, integrated with very short steps: leapfrog with the force of the
// slider mapped back to its limit.
struct Reference {
  Vector2d springs, u = Vector2d::Zero(), v, slip = Vector2d::Zero();
  Friction friction;
  double wall = 0;  // velocity of the wall along the first direction
  double lost = 0;

  void run(double end, int steps) {
    const double h = end / steps;
    Vector2d at_wall = Vector2d::Zero();
    for (int i = 0; i < steps; ++i) {
      u += 0.5 * h * v;
      at_wall[0] += 0.5 * h * wall;
      const Vector2d relative = u - at_wall, rate = v - Vector2d(wall, 0), elastic = relative - slip;
      Vector2d force = friction.stiffness * elastic;
      const double most = friction.limit(rate.norm()) * Block::pressed;
      if (force.norm() > most) {
        force *= most / force.norm();
        const Vector2d moved = relative - force / friction.stiffness;
        lost += force.dot(moved - slip);
        slip = moved;
      }
      v -= h / Block::mass * (springs.cwiseProduct(u) + force);
      u += 0.5 * h * v;
      at_wall[0] += 0.5 * h * wall;
    }
  }
};

// Sliding along a curve: the direction of the slip turns.
TEST_P(StickSlip, SlidingAlongACurveIsThatOfAnIndependentIntegration) {
  test::Book book("Friction with a tangential stiffness",
                  "independent integration with 4 million steps of a block that slides along a curve",
                  "run at tolerance 1e-5; ten times that");
  const double end = 1.2;
  Block block(0, 2);
  stiffen(block);
  const Vector2d springs(1.2e5, 3e5), v(0.8, 0.5);
  for (int i = 0; i < 2; ++i) block.system.stiffness.coeffRef(i + 1, i + 1) = springs[i];
  Reference expected{.springs = springs, .v = v, .friction = block.system.frictions[0]};
  expected.run(end, 4'000'000);
  ModalSolver base(block.system);
  Stepper stepper(block.system, base, {.tolerance = 1e-5, .scheme = scheme, .max_step = 0.02});
  stepper.start(0, block.u, Vector3d(0, v[0], v[1]));
  const long tries = test::march(stepper, end, 0.02);
  const double size = v.norm() / std::sqrt(springs[0] / Block::mass);
  book.below("displacement, difference over size [-]", (stepper.view().state().u.tail(2) - expected.u).norm() / size,
             1e-4);
  book.near("energy lost [J]", stepper.view().friction_work()[0] - stepper.view().friction_stored()[0], expected.lost,
            1e-4 * expected.lost);
  EXPECT_LT(tries, 5000);
}

// A wall that slides pulls the block on its spring: with static friction above sliding friction it sticks and slips.
TEST_P(StickSlip, AStickSlipOscillatorIsThatOfAnIndependentIntegration) {
  test::Book book("Friction with a tangential stiffness",
                  "independent integration with 4 million steps of a block on a spring on a sliding wall",
                  "run at tolerance 1e-6; ten times its share in the growing phase error");
  const double end = 2.5, speed = 0.02, k = 8e4;
  Block block(0);
  stiffen(block, 8e5);
  Friction& friction = block.system.frictions[0];
  friction.static_coefficient = 0.4;
  friction.stribeck = 0.02;
  block.system.stiffness.coeffRef(1, 1) = k;
  Reference expected{.springs = {k, 0}, .v = {0, 0}, .friction = friction, .wall = speed};
  expected.run(end, 4'000'000);
  // The wall moves like the ground of its end; it has this speed from the start.
  block.system.grounds = {GroundMotion(Pulse{Pulse::Shape::rectangle, -speed / 1e-6, 1e-6})};
  block.system.load = Eigen::MatrixXd::Zero(2, 1);
  block.system.gap_by_ground = Vector2d(0, 1);
  ModalSolver base(block.system);
  Stepper stepper(block.system, base, {.tolerance = 1e-6, .scheme = scheme, .max_step = 0.01});
  stepper.start(0, block.u, Vector2d::Zero());
  test::march(stepper, end, 0.01);
  const double reach = 0.4 * Block::pressed / k;
  EXPECT_GT(expected.lost, 0.1 * limit * speed * end) << "it has slipped";
  book.below("displacement, difference over the static reach [-]",
             std::abs(stepper.view().state().u[1] - expected.u[0]) / reach, 1e-3);
  book.near("energy lost [J]", stepper.view().friction_work()[0] - stepper.view().friction_stored()[0], expected.lost,
            1e-3 * expected.lost);
}

std::vector<std::uint64_t> bits_of(const Stepper& stepper) {
  std::vector<std::uint64_t> bits;
  const State& state = stepper.view().state();
  for (const Eigen::VectorXd* all : {&state.u, &state.v, &state.a, &state.force})
    for (const double value : *all) bits.push_back(std::bit_cast<std::uint64_t>(value));
  bits.push_back(std::bit_cast<std::uint64_t>(stepper.view().friction_work()[0]));
  bits.push_back(std::bit_cast<std::uint64_t>(stepper.view().friction_stored()[0]));
  return bits;
}

TEST_P(StickSlip, AnArchiveContinuesWithTheSameBits) {
  Block whole(0), continued(0);
  stiffen(whole);
  stiffen(continued);
  ModalSolver base(whole.system), second(continued.system);
  const StepperOptions options{.tolerance = 1e-5, .scheme = scheme, .max_step = 0.01};
  Stepper first(whole.system, base, options), other(continued.system, second, options);
  first.start(0, whole.u, 0.2 * Vector2d::Unit(1));
  test::march(first, 0.03, 0.01);
  other.restore(first.save());
  EXPECT_EQ(bits_of(first), bits_of(other));
  test::march(first, 0.3, 0.01);
  test::march(other, 0.3, 0.01);
  EXPECT_EQ(bits_of(first), bits_of(other));
}

TEST(StickSlipForce, NeedsTheIntegratorThatFollowsReversals) {
  Block block(0);
  stiffen(block);
  ModalSolver base(block.system);
  EXPECT_THROW(Stepper(block.system, base, {.scheme = test::schemes[0].scheme, .max_step = 0.01}),
               std::invalid_argument);
}

TEST(StickSlipForce, NeedsConsistentNumbers) {
  const auto accepts = [](auto change) {
    Block block(0);
    change(block.system.frictions[0]);
    try {
      block.system.check();
    } catch (const std::invalid_argument&) {
      return false;
    }
    return true;
  };
  EXPECT_TRUE(accepts([](Friction& f) { f.stiffness = 1e6; }));
  EXPECT_FALSE(accepts([](Friction&) {})) << "neither a stiffness nor a sliding velocity";
  EXPECT_FALSE(accepts([](Friction& f) { f.stiffness = f.ratio = 1; }));
  EXPECT_FALSE(accepts([](Friction& f) { f.ratio = -1; }));
  EXPECT_FALSE(accepts([](Friction& f) { f.stiffness = 1e6, f.static_coefficient = 0.2, f.stribeck = 0.1; }));
  EXPECT_FALSE(accepts([](Friction& f) { f.stiffness = 1e6, f.static_coefficient = 0.4; }));
}

}  // namespace stick_slip_test
}  // namespace pounding
