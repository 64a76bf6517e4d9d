// Impulses between rigid bodies in isolation: closed forms of collisions, without time or structures.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/event_functions.hpp>
#include <pounding/stepping/links/rigid_impacts.hpp>

namespace pounding {
namespace rigid_impacts_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Balls in a row and the contacts between neighbours.
struct Row {
  VectorXd mass, velocity;

  MatrixXd jacobian() const {  // closing rates from velocities
    const int contacts = static_cast<int>(mass.size()) - 1;
    MatrixXd b = MatrixXd::Zero(mass.size(), contacts);
    for (int i = 0; i < contacts; ++i) b(i, i) = 1, b(i + 1, i) = -1;
    return b;
  }
  MatrixXd flexibility() const { return jacobian().transpose() * mass.cwiseInverse().asDiagonal() * jacobian(); }
  Strikes strikes(double restitution) const {
    const MatrixXd b = jacobian();
    return {flexibility(),
            b.transpose() * velocity,
            VectorXd::Constant(b.cols(), restitution),
            VectorXd::Constant(b.cols(), 1e-6),
            1e-12,
            0};
  }
  VectorXd after(const VectorXd& impulse) const {
    return velocity - mass.cwiseInverse().asDiagonal() * (jacobian() * impulse);
  }
  double energy(const VectorXd& v) const { return 0.5 * mass.dot(v.cwiseAbs2()); }
};

TEST(Bounce, OfTwoBallsObeysNewtonsLawAndKeepsMomentum) {
  for (const double e : {0.3, 0.65, 1.0}) {
    const Row row{Eigen::Vector2d(2, 5), Eigen::Vector2d(3, -1)};
    const RigidBounce result = bounce(row.strikes(e));
    const VectorXd v = row.after(result.impulse);
    EXPECT_NEAR(v[0] - v[1], -e * 4, 1e-14);
    EXPECT_NEAR(result.rate[0], -e * 4, 1e-14);
    EXPECT_NEAR(row.mass.dot(v), row.mass.dot(row.velocity), 1e-13);
    EXPECT_NEAR(result.work[0], row.energy(row.velocity) - row.energy(v), 1e-13) << "the work is the energy lost";
    const double reduced = 10.0 / 7;
    EXPECT_NEAR(result.work[0], 0.5 * reduced * (1 - e * e) * 16, 1e-13);
  }
}

TEST(Bounce, HandsAnImpulseThroughARowOfEqualBalls) {
  Row row{VectorXd::Ones(5), VectorXd::Zero(5)};
  row.velocity[0] = 2;
  const VectorXd v = row.after(bounce(row.strikes(1)).impulse);
  EXPECT_LT((v - 2 * VectorXd::Unit(5, 4)).norm(), 1e-14) << "Newton's cradle";
}

TEST(Bounce, LosesWhatIsTooSlowToResolve) {
  const Row row{Eigen::Vector2d(1, 3), Eigen::Vector2d(1, 0)};
  Strikes strikes = row.strikes(0.9);
  strikes.slowest[0] = 1.5;
  const RigidBounce result = bounce(strikes);
  EXPECT_NEAR(result.rate[0], 0, 1e-15);
  EXPECT_NEAR(row.after(result.impulse)[1], 0.25, 1e-15) << "they continue together";
  EXPECT_NEAR(result.work[0], 0.375, 1e-15);
}

TEST(Bounce, BringsBodiesToRestThatPartAsTheyTouch) {
  const Row row{Eigen::Vector2d(1, 1), Eigen::Vector2d(0, 1e-3)};
  Strikes strikes = row.strikes(0.5);
  EXPECT_EQ(bounce(strikes).impulse[0], 0) << "otherwise they separate";
  strikes.parting = 1;
  EXPECT_NEAR(bounce(strikes).rate[0], 0, 1e-18);
  EXPECT_LT(bounce(strikes).impulse[0], 0);
}

TEST(PlasticImpulses, MakeBallsGoOnTogether) {
  Row row{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(6, 0, 0)};
  const VectorXd f = plastic_impulses(row.flexibility(), row.jacobian().transpose() * row.velocity, 1e-12);
  const VectorXd v = row.after(f);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(v[i], 1, 1e-14);
}

TEST(PlasticImpulses, NeverPull) {
  // The middle ball is pressed away from the last one, which moves off.
  const Row row{VectorXd::Ones(3), Eigen::Vector3d(2, 0, 5)};
  const VectorXd f = plastic_impulses(row.flexibility(), row.jacobian().transpose() * row.velocity, 1e-12);
  EXPECT_NEAR(f[0], 1, 1e-14);
  EXPECT_EQ(f[1], 0);
}

TEST(PlasticImpulses, SatisfyTheConditionsOfTheLeast) {
  MatrixXd g(3, 3);
  g << 2, 1.5, -0.3, 1.5, 2, 0.4, -0.3, 0.4, 1;
  for (const Eigen::Vector3d& rate : {Eigen::Vector3d(1, 1.4, 0.2), {1, 0.2, -0.1}, {0.3, 2, 0.5}, {-1, -2, -3}}) {
    const VectorXd f = plastic_impulses(g, rate, 1e-12), left = rate - g * f;
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(f[i], 0);
      EXPECT_LT(left[i], 1e-12);
      EXPECT_NEAR(f[i] * left[i], 0, 1e-13) << "a separating contact takes no impulse";
    }
  }
}

// The first contact closes fastest and is pressed first, but the other two together separate it.
TEST(PlasticImpulses, LetAContactGoThatOthersRelieve) {
  MatrixXd g(3, 3);
  g << 1.02, 0.7, 0.7, 0.7, 1, 0, 0.7, 0, 1;
  const VectorXd f = plastic_impulses(g, Eigen::Vector3d(1.3, 1.2, 1.2), 1e-12);
  EXPECT_LT((f - Eigen::Vector3d(0, 1.2, 1.2)).norm(), 1e-14);
}

TEST(PlasticImpulses, ShareWhatTwoContactsOfTheSameBodiesTake) {
  const VectorXd f = plastic_impulses(MatrixXd::Ones(2, 2), VectorXd::Constant(2, 3.0), 1e-12);
  EXPECT_NEAR(f.sum(), 3, 1e-13);
}

TEST(SlowestBounce, LeavesAHopThatAStepCanSee) {
  const double press = 4, e = 0.6, displacement = 0.1;
  const double rate = e * slowest_bounce(press, e, displacement, 0);  // after the bounce
  EXPECT_NEAR(rate * rate / (2 * press), 4 * motion_noise * displacement, 1e-25);
  EXPECT_NEAR(2 * e * slowest_bounce(1e6, e, 1e-30, 50.0) / 1e6, 1e-13 * 50, 1e-20) << "or one that persists";
  EXPECT_EQ(slowest_bounce(-1, e, displacement, 0), 0) << "bodies without a pressing force separate permanently";
}

TEST(HoldContacts, TakesTheDriftOfAHeldContactOut) {
  const RigidContact contact(0.5, 0.02);
  System system;
  system.gap_jacobian.resize(0, 1);
  system.contacts = {&contact};
  system.initial_contacts = {contact.initial()};
  contact.jumped(system.initial_contacts[0], 0, {}, true);
  system.gap_by_ground = MatrixXd::Ones(1, 1);
  const LinkSet links(system);
  const RigidContacts rigid{MatrixXd::Constant(1, 1, 0.5), MatrixXd::Constant(1, 1, 0.5)};  // one body of 2 kg
  Instant begin, end;
  begin.relative = Eigen::RowVector3d(0.015, 0.1, 0);
  begin.by_ground = Eigen::RowVector3d(0.005, -0.1, 0);
  end.motion = Eigen::RowVector2d(0.016, 0.12);
  end.by_ground = Eigen::RowVector3d(0.0041, -0.13, 0);
  hold_contacts(rigid, links, begin, end.motion, {0}, end);
  EXPECT_NEAR(end.motion(0, 0) + end.by_ground(0, 0), 0.02, 1e-16) << "penetration as before";
  EXPECT_NEAR(end.motion(0, 1) + end.by_ground(0, 1), 0, 1e-16) << "rate zero";
}

}  // namespace rigid_impacts_test
}  // namespace pounding
