// The equations of the link forces in isolation: the test supplies free motions and a flexibility without a structure.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include <Eigen/LU>

#include <pounding/hysteresis/bouc_wen.hpp>
#include <pounding/laws/hertz.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/links/link_solver.hpp>
#include <pounding/structures/hysteretic_spring.hpp>

#include "support/bilinear_spring.hpp"

namespace pounding {
namespace link_solver_test {

struct Linear {
  static constexpr std::string_view name = "linear";
  static constexpr bool may_pull = true;
  double stiffness = 1e6, damping = 0;

  void check() const {}
  laws::Response contact(double penetration, double rate, const laws::Impact&) const noexcept {
    return {stiffness * penetration + damping * rate, stiffness, damping};
  }
};

/// A thousand times stiffer beyond 1 mm: full Newton steps jump back and forth across the corner.
struct Kinked {
  static constexpr std::string_view name = "kinked";
  static double force(double d) { return 1e3 * d + 1e9 * std::max(0.0, d - 1e-3); }

  void check() const {}
  laws::Response contact(double penetration, double, const laws::Impact&) const noexcept {
    return {force(penetration), penetration > 1e-3 ? 1e3 + 1e9 : 1e3, 0};
  }
};

struct Lost {
  static constexpr std::string_view name = "lost";
  static constexpr bool may_pull = true;
  void check() const {}
  laws::Response contact(double, double, const laws::Impact&) const noexcept { return {std::nan(""), 0, 0}; }
};

/// Closed links, their data, and the computed forces.
struct Few {
  std::vector<std::unique_ptr<const Contact>> contacts;
  std::vector<ContactMemory> memories;
  std::vector<std::unique_ptr<const Spring>> springs;
  System system;
  std::unique_ptr<LinkSet> links;
  std::unique_ptr<LinkSolver> solver;
  std::vector<int> active;
  std::vector<LinkMotion> free;
  Eigen::VectorXd free_acceleration, force;
  Eigen::MatrixXd flexibility;
  LinkBlocks blocks;
  double by_u = 1e-6, by_v = 2e-3, weight = 0.5;

  template <class Law>
  void press(const Law& law) {
    contacts.push_back(std::make_unique<GapContact<Law>>(law, 0.0));
    contacts.back()->on_event(memories.emplace_back(contacts.back()->initial()), 0, 0, {0, 1});
  }
  void press_either(bool curved, const Linear& law) {
    if (curved)
      press(laws::Hertz{.stiffness = 1e9});
    else
      press(law);
  }
  void rest() {
    contacts.push_back(std::make_unique<RigidContact>(0.5, 0.0));
    contacts.back()->jumped(memories.emplace_back(contacts.back()->initial()), 0, {}, true);
  }
  bool solve(double guess = 0) {
    const int count = static_cast<int>(free.size());
    system.gap_jacobian.resize(0, count);
    system.contacts.clear();
    for (const auto& contact : contacts) system.contacts.push_back(contact.get());
    for (const auto& spring : springs) system.elements.push_back(spring.get());
    system.initial_contacts = memories;
    system.check();
    links = std::make_unique<LinkSet>(system);
    solver = std::make_unique<LinkSolver>(*links);
    active.clear();
    for (int i = 0; i < count; ++i) active.push_back(i);
    if (free_acceleration.size() == 0) free_acceleration = Eigen::VectorXd::Zero(count);
    force = Eigen::VectorXd::Constant(count, guess);
    blocks.find(flexibility);
    return solver->solve({active, free, free_acceleration, flexibility, by_u, by_v, weight, nullptr, &blocks}, force);
  }
  /// Maximum difference between a force and its law at the motion under all forces, relative to all forces.
  double worst() const {
    double largest = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      largest = std::max(largest, std::abs(contacts[i]->evaluate(memories[i], motion(static_cast<int>(i))).force -
                                           force[static_cast<Eigen::Index>(i)]) /
                                      force.norm());
    return largest;
  }
  /// Motion under the forces.
  LinkMotion motion(int i) const {
    const double relief = weight * flexibility.row(i).dot(force);
    return {free[i].penetration - by_u * relief, free[i].rate - by_v * relief};
  }
};

TEST(LinkSolver, GivesALinearLinkTheForceOfTheClosedForm) {
  const double k = 1e6, c = 2e3, g = 0.4;
  Few few;
  few.press(Linear{k, c});
  few.free = {{3e-3, -0.2}};
  few.flexibility = Eigen::MatrixXd::Constant(1, 1, g);
  const double expected = (k * 3e-3 + c * -0.2) / (1 + few.weight * g * (few.by_u * k + few.by_v * c));
  for (const double guess : {0.0, 1.0, 1e9}) {
    ASSERT_TRUE(few.solve(guess));
    EXPECT_NEAR(few.force[0], expected, 1e-13 * expected);
    EXPECT_EQ(few.solver->failed_link(), -1);
    EXPECT_LE(few.solver->iterations(), 3) << "Newton's method with the exact slope";
  }
}

TEST(LinkSolver, SolvesLinksThatShareABodyTogether) {
  Few few;
  for (const double k : {1e6, 3e6, 2e7}) few.press(Linear{k, 1e-3 * k});
  few.free = {{2e-3, 0.1}, {1e-3, 0.3}, {4e-3, -0.05}};
  few.flexibility.resize(3, 3);
  few.flexibility << 2, -1, 0, -1, 2, -1, 0, -1, 3;
  ASSERT_TRUE(few.solve());
  // k_i u_i + c_i v_i = F_i at the motion under the forces.
  Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
  Eigen::Vector3d b;
  for (int i = 0; i < 3; ++i) {
    const double k = few.contacts[i]->evaluate(few.memories[i], {1, 0}).by_penetration, c = 1e-3 * k;
    a.row(i) += few.weight * (few.by_u * k + few.by_v * c) * few.flexibility.row(i);
    b[i] = k * few.free[i].penetration + c * few.free[i].rate;
  }
  const Eigen::Vector3d expected = a.partialPivLu().solve(b);
  EXPECT_LT((few.force - expected).norm(), 1e-11 * expected.norm());
}

TEST(LinkSolver, LeavesEveryNonlinearLinkInBalanceFromAnyGuess) {
  for (const double guess : {0.0, 1e-3, 1e5, 1e12})
    for (const int count : {1, 2}) {
      Few few;
      for (int i = 0; i < count; ++i) few.press(laws::Hertz{.stiffness = 2.75e9});
      few.free.assign(static_cast<std::size_t>(count), {5e-3, 0.4});
      few.flexibility = Eigen::MatrixXd::Constant(count, count, 0.2);
      few.flexibility.diagonal().array() += 1;
      ASSERT_TRUE(few.solve(guess)) << guess << count;
      for (int i = 0; i < count; ++i) {
        EXPECT_GT(few.force[i], 0);
        EXPECT_NEAR(few.contacts[i]->evaluate(few.memories[i], few.motion(i)).force, few.force[i], 1e-11 * few.force[i])
            << guess << count;
      }
      EXPECT_LT(few.solver->iterations(), 100);
    }
}

// The corner lies on the path of every full step, so that the bracketed solve must take over.
TEST(LinkSolver, FindsForcesOnBothSidesOfACorner) {
  for (const double free : {0.9e-3, 1.0001e-3, 2e-3, 0.5}) {
    Few few;
    for (int i = 0; i < 3; ++i) few.press(Kinked{});
    few.free.assign(3, {free, 0});
    few.by_v = 0;
    few.flexibility = 40 * Eigen::Matrix3d::Identity();
    few.flexibility(0, 1) = few.flexibility(1, 0) = -15;
    few.flexibility(1, 2) = few.flexibility(2, 1) = 12;
    ASSERT_TRUE(few.solve(1e4)) << free;
    // Round-off of a force of 1e9 N/m times 1 mm.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(Kinked::force(few.motion(i).penetration), few.force[i], 1e-6) << free;
  }
}

TEST(LinkSolver, LetsAHeldContactCloseNoFaster) {
  Few few;
  few.rest();
  few.free = {{0, 0}};
  few.free_acceleration = Eigen::VectorXd::Constant(1, 3.0);
  few.flexibility = Eigen::MatrixXd::Constant(1, 1, 0.25);
  ASSERT_TRUE(few.solve());
  EXPECT_NEAR(few.free_acceleration[0] - few.weight * 0.25 * few.force[0], 0, 1e-14);
  EXPECT_GT(few.force[0], 0);
}

// Two rigid contacts between the same two bodies: G is singular and only the sum of the forces is determined.
TEST(LinkSolver, SharesAForceAmongContactsThatHoldTheSameBodies) {
  Few few;
  few.rest();
  few.rest();
  few.free.assign(2, {0, 0});
  few.free_acceleration = Eigen::VectorXd::Constant(2, 3.0);
  few.flexibility = Eigen::MatrixXd::Constant(2, 2, 0.25);
  ASSERT_TRUE(few.solve());
  EXPECT_NEAR(few.weight * 0.25 * few.force.sum(), 3.0, 1e-12);
  EXPECT_NEAR(few.force[0], few.force[1], 1e-12);
}

// A yielding spring has less than its elastic force: the solution lies beyond the force at the free motion.
TEST(LinkSolver, FollowsASpringThatYields) {
  Few few;
  few.springs.push_back(std::make_unique<BilinearSpring>(BilinearSpring::Parameters{1e6, 1e3, 0.1}));
  few.free = {{5e-3, 0}};
  few.by_u = 1e-6;
  few.by_v = 0;
  few.flexibility = Eigen::MatrixXd::Constant(1, 1, 0.8);
  ASSERT_TRUE(few.solve());
  // Excess force -(1 - a)(k d - Fy) at d = free - c f with c = weight by_u g.
  const double c = few.weight * few.by_u * 0.8, expected = -0.9 * (1e6 * 5e-3 - 1e3) / (1 - 0.9 * 1e6 * c);
  EXPECT_NEAR(few.force[0], expected, 1e-12 * std::abs(expected));
  EXPECT_LT(expected, -0.9 * (1e6 * 5e-3 - 1e3)) << "beyond the force at the free motion";
}

// A joint with negligible mass (1e-6 of the stiffness) and sharp, stiff hinges at its four members. Their other ends
// rotate so far that all hinges yield at first: the joint is then loose and the first Newton directions are far too
// long.
TEST(LinkSolver, FindsTheTurnOfAJointWhoseHingesYieldTogether) {
  constexpr int members = 4;
  const double member = 6e6, hinge = 100 * member, turned = 0.02;
  const double yield[members] = {5e4, 3e4, 6e4, 1.5e4};
  Few few;
  // The joint, then the member ends beyond their hinges.
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(1 + members, 1 + members),
                  way = Eigen::MatrixXd::Zero(members, 1 + members);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(1 + members);
  stiffness(0, 0) = 1e-6 * member;
  for (int i = 0; i < members; ++i) {
    few.springs.push_back(std::make_unique<HystereticSpring<hysteresis::BoucWen>>(
        hysteresis::BoucWen{.initial_stiffness = hinge, .yield_force = yield[i], .exponent = 5}));
    way(i, 0) = -1, way(i, 1 + i) = 1;  // penetration: rotation of the end relative to the joint
    stiffness(1 + i, 1 + i) = member;
    load[1 + i] = (i % 2 == 0 ? 1 : -1) * member * turned * (1 + 0.1 * i);
  }
  stiffness += hinge * way.transpose() * way;
  const Eigen::MatrixXd compliance = stiffness.inverse();
  few.flexibility = way * compliance * way.transpose();
  few.by_u = few.weight = 1;
  few.by_v = 0;
  const Eigen::VectorXd free = way * compliance * load;
  for (int i = 0; i < members; ++i) few.free.push_back({free[i], 0});
  ASSERT_TRUE(few.solve());
  EXPECT_LT(few.solver->iterations(), 200);
  double sum = 0;
  for (int i = 0; i < members; ++i) {
    const double d = few.motion(i).penetration, moment = hinge * d + few.force[i];
    EXPECT_NEAR(LoadedSpring(*few.springs[static_cast<std::size_t>(i)]).evaluate({d, 0}).force, few.force[i],
                1e-10 * hinge * std::abs(d))
        << i;
    EXPECT_LE(std::abs(moment), yield[i]) << i;
    sum += moment;
  }
  EXPECT_NEAR(sum, 0, 1e-2 * yield[3]);
}

// Sixty springs of two structures, most of which yield, and three contacts between them. Eliminating the springs of
// each structure first must agree with Newton's method for all equations.
TEST(SoftSprings, OfEachStructureAreEliminatedBeforeTheOtherLinks) {
  constexpr int contacts = 3, of_one = 30, springs = 2 * of_one, count = contacts + springs;
  Eigen::MatrixXd way = Eigen::MatrixXd::Zero(count, 2 * 40);  // links by the unknowns of two structures
  for (int i = 0; i < contacts; ++i)
    for (int j = 0; j < 80; ++j) way(i, j) = std::sin(1 + 7 * i + 3 * j);
  for (int i = 0; i < springs; ++i)
    for (int j = 0; j < 40; ++j) way(contacts + i, (i < of_one ? 0 : 40) + j) = std::cos(2 + 5 * i + 2 * j);
  const Eigen::MatrixXd flexibility = 1e-3 * way * way.transpose();
  Eigen::MatrixXd relief = Eigen::MatrixXd::Zero(count, count);
  relief.bottomRightCorner(springs, springs) = 1e-9 * flexibility.bottomRightCorner(springs, springs);
  Eigen::VectorXd slopes(count), rates = Eigen::VectorXd::Zero(count), residual(count),
                                 only_springs = Eigen::VectorXd::Zero(count);
  const double by_u = 1e-6, by_v = 2e-3, weight = 0.5;
  for (int i = 0; i < count; ++i) {
    residual[i] = 1e3 * std::sin(3.0 + 11 * i);
    slopes[i] = i < contacts ? 1e8
                : i % 7 == 0 ? 0
                             : -0.1 / (by_u * weight * flexibility(i, i) + relief(i, i)) / of_one;
    if (i >= contacts) only_springs[i] = slopes[i];
    if (i < contacts) rates[i] = 1e5;
  }
  const Eigen::MatrixXd by_penetration = weight * by_u * flexibility + relief, by_rate = weight * by_v * flexibility;
  Eigen::MatrixXd matrix = slopes.asDiagonal() * by_penetration;
  matrix += rates.asDiagonal() * by_rate;
  matrix.diagonal().array() += 1;
  const Eigen::VectorXd expected = matrix.partialPivLu().solve(residual);
  const std::vector<int> active(count, 0), others{0, 1, 2};
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(count);
  const CondensedLinks links{.active = active,
                             .free = {},
                             .free_acceleration = none,
                             .flexibility = flexibility,
                             .by_u = by_u,
                             .by_v = by_v,
                             .weight = weight,
                             .relief = &relief};
  SoftSprings solver;
  Eigen::VectorXd direction;
  ASSERT_TRUE(solver.solve_beside(links, others, matrix, only_springs, residual, direction));
  EXPECT_LT((direction - expected).norm(), 1e-11 * expected.norm());
  // Without the contacts.
  const Eigen::MatrixXd g = flexibility.bottomRightCorner(springs, springs),
                        s = relief.bottomRightCorner(springs, springs);
  const Eigen::VectorXd own = slopes.tail(springs), left = residual.tail(springs), nothing = none.tail(springs);
  const CondensedLinks alone{.active = active,
                             .free = {},
                             .free_acceleration = nothing,
                             .flexibility = g,
                             .by_u = by_u,
                             .by_v = by_v,
                             .weight = weight,
                             .relief = &s};
  const Eigen::VectorXd by_themselves = matrix.bottomRightCorner(springs, springs).partialPivLu().solve(left);
  ASSERT_TRUE(solver.solve(alone, own, left, direction));
  EXPECT_LT((direction - by_themselves).norm(), 1e-11 * by_themselves.norm());
  // Springs that soften more than the structure can bear have no factorization.
  EXPECT_FALSE(solver.solve_beside(links, others, matrix, 1e6 * only_springs, residual, direction));
}

TEST(LinkSolver, FindsTheFrictionOfTheForceThatPresses) {
  for (const double sliding : {1e-1, 1e-4}) {
    Few few;
    few.press(Linear{1e6, 0});
    few.system.frictions = {{.contact = 0, .first = 1, .count = 2, .coefficient = 0.4, .sliding = sliding}};
    few.free = {{3e-3, 0.1}, {0, 0.3}, {0, -0.1}};
    few.flexibility = Eigen::MatrixXd::Identity(3, 3);
    few.flexibility(0, 1) = few.flexibility(1, 0) = 0.3;
    ASSERT_TRUE(few.solve());
    const Eigen::Vector2d rates(few.motion(1).rate, few.motion(2).rate);
    const Eigen::Vector2d expected = 0.4 * few.force[0] * rates / std::hypot(rates.norm(), sliding);
    EXPECT_NEAR(few.force[0], 1e6 * few.motion(0).penetration, 1e-10 * few.force[0]);
    EXPECT_LT((few.force.tail(2) - expected).norm(), 1e-8 * few.force[0]) << sliding;
  }
}

// Enough links that a symmetric factorization replaces the slopes and is reused while they do not change.
TEST(LinkSolver, FindsTheForcesOfAHundredLinksThatPressTogether) {
  constexpr int count = 100;
  Few few;
  for (int i = 0; i < count; ++i) {
    few.press_either(i % 3 == 0, {1e6 * (1 + i % 7), 1e3 * (i % 2)});
    few.free.push_back({1e-3 * (1 + i % 5), 0.1});
  }
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(count, 40);
  few.flexibility = b * b.transpose() + 0.1 * Eigen::MatrixXd::Identity(count, count);
  ASSERT_TRUE(few.solve());
  EXPECT_LT(few.worst(), 1e-12);
  const Eigen::VectorXd first = few.force;
  few.flexibility *= 2;
  const CondensedLinks softer{few.active,      few.free, few.free_acceleration,
                              few.flexibility, few.by_u, few.by_v,
                              few.weight,      nullptr,  &few.blocks};
  ASSERT_TRUE(few.solver->solve(softer, few.force));
  EXPECT_LT(few.worst(), 1e-12);
  EXPECT_GT((few.force - first).norm(), 1e-3 * first.norm());
  const Eigen::VectorXd second = few.force;
  few.force.setConstant(few.force.mean());
  ASSERT_TRUE(few.solver->solve(softer, few.force));
  EXPECT_LT((few.force - second).norm(), 1e-10 * second.norm()) << "from another initial guess";
}

// As in a row of bodies: links on the same body are coupled, at most three in a chain, followed by a free body.
TEST(LinkSolver, FindsTheForcesOfLinksInBlocksAsThoseOfAll) {
  constexpr int count = 150;
  Few few;
  few.flexibility = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i) {
    few.press_either(i % 2 == 0, {1e6 * (1 + i % 7), 1e3 * (i % 3)});
    few.free.push_back({1e-3 * (1 + i % 5), 0.1});
    few.flexibility(i, i) = 1 + 0.1 * (i % 4);
    if (i % 3 != 0) few.flexibility(i, i - 1) = few.flexibility(i - 1, i) = -0.4;
  }
  ASSERT_TRUE(few.solve());
  EXPECT_EQ(few.blocks.ends().size(), 50U);
  EXPECT_LT(few.worst(), 1e-12);
  const Eigen::VectorXd by_blocks = few.force;
  few.force.setZero();
  ASSERT_TRUE(few.solver->solve(
      {few.active, few.free, few.free_acceleration, few.flexibility, few.by_u, few.by_v, few.weight}, few.force));
  EXPECT_LT((few.force - by_blocks).norm(), 1e-12 * by_blocks.norm());
}

TEST(LinkSolver, SaysThatALawWithoutAnAnswerFailed) {
  Few few;
  few.press(Lost{});
  few.press(Linear{1e6, 0});
  few.free.assign(2, {1e-3, 0});
  few.flexibility = Eigen::Matrix2d::Identity();
  EXPECT_FALSE(few.solve());
}

}  // namespace link_solver_test
}  // namespace pounding
