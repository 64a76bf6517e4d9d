/// Multiple-support excitation, and its contribution to quantities relative to the first support.

#include <pounding/ground/support_motion.hpp>

#include <gtest/gtest.h>

namespace pounding {
namespace support_motion_test {

using Indices = std::vector<std::array<int, 3>>;

const std::vector<GroundMotion> grounds{GroundMotion(Harmonic{.amplitude = 1, .period = 0.7, .duration = 3}),
                                        GroundMotion(Harmonic{.amplitude = 2, .period = 0.4, .duration = 3}),
                                        GroundMotion(Harmonic{.amplitude = 3, .period = 0.9, .duration = 3})};

// A distinct number for each support and axis.
double influence(std::size_t support, int axis) { return 1 + 10.0 * static_cast<double>(support) + axis; }

Eigen::RowVectorXd row_of(const SupportMotion& motion) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(3);
  motion.project(influence, row);
  return row;
}

TEST(SupportMotion, OfOneSupportAddsNothing) {
  const SupportMotion motion(grounds, Indices{{0, 1, -1}});
  EXPECT_EQ(motion.at_first(0), 0);
  EXPECT_EQ(motion.at_first(2), -1);
  EXPECT_EQ(row_of(motion), Eigen::RowVectorXd::Zero(3));
  motion.displacement(1, [](std::size_t, int, double) { FAIL() << "no term expected"; });
}

TEST(SupportMotion, CountsTheOtherSupportsAgainstTheFirst) {
  const SupportMotion motion(grounds, Indices{{0, -1, -1}, {1, -1, -1}, {2, -1, 1}});
  // Support 1 along x: influence 11; support 2 along x: 21, along z: 23; support 0 subtracts the sum along x.
  EXPECT_EQ(row_of(motion), Eigen::RowVector3d(-(11.0 + 21.0), 11.0 + 23.0, 21.0));
}

TEST(SupportMotion, OfSupportsThatMoveAlikeAddsUpToNothing) {
  const SupportMotion motion(grounds, Indices{{0, 1, -1}, {0, 1, -1}});
  EXPECT_EQ(row_of(motion), Eigen::RowVectorXd::Zero(3));
}

TEST(SupportMotion, KeepsGroundAtRestOut) {
  const SupportMotion motion(grounds, Indices{{-1, -1, -1}, {-1, 2, -1}});
  EXPECT_EQ(motion.at(1, 1), 2);
  EXPECT_EQ(row_of(motion), Eigen::RowVector3d(0, 0, 12));
}

TEST(SupportMotion, HasTermsInTimeThatAreItsRowTimesTheGrounds) {
  const SupportMotion motion(grounds, Indices{{0, 1, -1}, {1, 2, 0}, {2, -1, -1}});
  const Eigen::RowVectorXd row = row_of(motion);
  for (const double t : {0.1, 0.75, 2.9, 4.0}) {
    Eigen::Vector3d u, v, a;
    for (int g = 0; g < 3; ++g) {
      u[g] = grounds[g].displacement(t);
      v[g] = grounds[g].velocity(t);
      a[g] = grounds[g].acceleration(t);
    }
    double sum = 0;
    const auto add = [&](std::size_t support, int axis, double amount) { sum += influence(support, axis) * amount; };
    motion.displacement(t, add);
    EXPECT_NEAR(sum, row.dot(u), 1e-13 * row.norm() * u.norm());
    sum = 0;
    motion.velocity(t, add);
    EXPECT_NEAR(sum, row.dot(v), 1e-13 * row.norm() * v.norm());
    sum = 0;
    motion.acceleration(a, add);
    EXPECT_NEAR(sum, row.dot(a), 1e-13 * row.norm() * (1 + a.norm()));
  }
}

}  // namespace support_motion_test
}  // namespace pounding
