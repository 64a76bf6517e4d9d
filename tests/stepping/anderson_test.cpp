// The fixed-point iteration in isolation, on maps of two unknowns.

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include <pounding/stepping/anderson.hpp>

namespace pounding {
namespace anderson_test {

using Eigen::Matrix2d;
using Eigen::VectorXd;

struct Counted {
  VectorXd image;
  bool converged = false;
  int maps = 0;
};

template <class Map>
Counted fixed_point(const Map& map, const VectorXd& guess) {
  Counted run;
  VectorXd at;
  run.converged = solve_fixed_point(
      guess, run.image,
      [&](const VectorXd& x, VectorXd& image) {
        ++run.maps;
        at = x;
        return map(x, image);
      },
      [&](const VectorXd& residual) { return residual.norm() / at.norm(); },
      [](const VectorXd& p, const VectorXd& q) { return p.dot(q); });
  return run;
}

const Eigen::Vector2d offset(1, -2);

Counted linear(const Matrix2d& a) {
  return fixed_point(
      [&](const VectorXd& x, VectorXd& image) {
        image = a * x + offset;
        return true;
      },
      Eigen::Vector2d(5, 5));
}

TEST(FixedPoint, OfALinearMapOfTwoUnknownsNeedsTwoDifferences) {
  const Matrix2d a{{0.9, 0.3}, {-0.2, 0.5}};  // repetition alone would take about 150
  const Counted run = linear(a);
  ASSERT_TRUE(run.converged);
  EXPECT_LE(run.maps, 6);
  EXPECT_LT((run.image - (Matrix2d::Identity() - a).inverse() * offset).norm(), 1e-13 * run.image.norm());
}

TEST(FixedPoint, IsFoundWhereRepetitionDiverges) {
  const Matrix2d a{{-7, 1}, {0.5, 4}};
  const Counted run = linear(a);
  ASSERT_TRUE(run.converged);
  EXPECT_LE(run.maps, 8);
  EXPECT_LT((run.image - (Matrix2d::Identity() - a).inverse() * offset).norm(), 1e-12 * run.image.norm());
}

TEST(FixedPoint, OfANonlinearMapSatisfiesIt) {
  const auto map = [](const VectorXd& x, VectorXd& image) {
    image = Eigen::Vector2d(std::cos(x[1]), 0.5 + 0.5 * std::sin(x[0]));
    return true;
  };
  const Counted run = fixed_point(map, Eigen::Vector2d(1, 1));
  ASSERT_TRUE(run.converged);
  EXPECT_NEAR(run.image[0], std::cos(run.image[1]), 1e-13);
  EXPECT_NEAR(run.image[1], 0.5 + 0.5 * std::sin(run.image[0]), 1e-13);
  EXPECT_LT(run.maps, 15);
}

TEST(FixedPoint, OfAConstantMapIsItsFirstImage) {
  EXPECT_EQ(linear(Matrix2d::Zero()).image, offset);
  EXPECT_LE(linear(Matrix2d::Zero()).maps, 2);
}

TEST(FixedPoint, IsNotClaimedWhereThereIsNone) {
  const auto shift = [](const VectorXd& x, VectorXd& image) {
    image = x + offset;
    return true;
  };
  EXPECT_FALSE(fixed_point(shift, Eigen::Vector2d(1, 1)).converged);
  const auto fails = [](const VectorXd&, VectorXd&) { return false; };
  const Counted failed = fixed_point(fails, Eigen::Vector2d(1, 1));
  EXPECT_FALSE(failed.converged);
  EXPECT_EQ(failed.maps, 1);
  const auto lost = [](const VectorXd& x, VectorXd& image) {
    image = x * std::nan("");
    return true;
  };
  EXPECT_FALSE(fixed_point(lost, Eigen::Vector2d(1, 1)).converged);
}

}  // namespace anderson_test
}  // namespace pounding
