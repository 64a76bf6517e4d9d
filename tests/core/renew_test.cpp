#include <pounding/core/renew.hpp>

#include <new>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace pounding {
namespace renew_test {

constexpr Eigen::Index huge = Eigen::Index{1} << 30;

// Eigen's own resize() leaves a matrix of the old size whose entries are freed.
TEST(Renew, LeavesAnEmptyMatrixWhereThereIsNoMemory) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Ones(3, 4);
  EXPECT_THROW(renew(m, 2 * huge, huge), std::bad_alloc);
  EXPECT_EQ(m.size(), 0);
  Eigen::VectorXd v = Eigen::VectorXd::Ones(3);
  EXPECT_THROW(renew(v, 2 * huge * huge), std::bad_alloc);
  EXPECT_EQ(v.size(), 0);
  Eigen::LLT<Eigen::MatrixXd> factor(Eigen::MatrixXd::Identity(3, 3));
  EXPECT_THROW(renew_factor(factor, 2 * huge), std::bad_alloc);
  EXPECT_EQ(factor.rows(), 3);
}

TEST(Renew, KeepsEntriesOfTheSameSizeAndTakesTheRoomOfAsMany) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Ones(3, 4);
  const double* const entries = m.data();
  renew(m, 3, 4);
  EXPECT_EQ(m.sum(), 12);
  renew(m, 6, 2);
  EXPECT_EQ(m.rows(), 6);
  EXPECT_EQ(m.data(), entries);
  renew(m, 2, 2);
  EXPECT_EQ(m.cols(), 2);
  Eigen::VectorXd v = Eigen::VectorXd::Ones(3);
  renew(v, 3);
  EXPECT_EQ(v.sum(), 3);
  renew(v, 5);
  EXPECT_EQ(v.size(), 5);
}

}  // namespace renew_test
}  // namespace pounding
