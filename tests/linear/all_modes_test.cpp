// All modes in one call: mass-normalized, they diagonalize the stiffness and match the small solver.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <stdexcept>

#include <pounding/linear/all_modes.hpp>

namespace pounding {
namespace all_modes_test {

class AllModes : public testing::TestWithParam<bool> {};

TEST_P(AllModes, AreNormalAndThoseOfTheSmallSolver) {
  constexpr int n = 120;
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(n, n), c = Eigen::MatrixXd::Random(n, n);
  const Eigen::MatrixXd stiffness = b * b.transpose();
  Eigen::MatrixXd mass = Eigen::VectorXd::LinSpaced(n, 1, 5).asDiagonal();
  if (!GetParam()) mass += 0.01 * c * c.transpose();
  const Eigenpairs found = petsc::all_modes(mass, stiffness), small = eigenpairs(mass, stiffness);
  const double largest = small.values[n - 1];
  for (int i = 0; i < n; ++i) EXPECT_NEAR(found.values[i], small.values[i], 1e-12 * largest) << i;
  EXPECT_LT((found.vectors.transpose() * mass * found.vectors - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(),
            1e-11);
  EXPECT_LT((found.vectors.transpose() * stiffness * found.vectors - Eigen::MatrixXd(found.values.asDiagonal()))
                .cwiseAbs()
                .maxCoeff(),
            1e-11 * largest);
}

INSTANTIATE_TEST_SUITE_P(LumpedOrNot, AllModes, testing::Bool());

TEST(AllModesOfNoMass, AreRefused) {
  Eigen::MatrixXd mass = Eigen::Vector2d(1, 0).asDiagonal();
  EXPECT_THROW(petsc::all_modes(mass, Eigen::Matrix2d::Identity()), std::invalid_argument);
  mass << 1, 2, 2, 1;
  EXPECT_THROW(petsc::all_modes(mass, Eigen::Matrix2d::Identity()), std::invalid_argument);
}

}  // namespace all_modes_test
}  // namespace pounding
