#include <pounding/core/renew.hpp>

#include <new>
#include <optional>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

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
  std::optional<Eigen::LLT<Eigen::MatrixXd>> factor(Eigen::MatrixXd::Identity(3, 3));
  EXPECT_THROW(renew_factor(factor, 2 * huge), std::bad_alloc);
  EXPECT_FALSE(factor.has_value());
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

// One of Eigen's that has not factorized yet has members without a value; to move them is not defined.
TEST(Renew, MakesAFactorInItsPlace) {
  struct Factor {
    explicit Factor(Eigen::Index size) : size_(size) {}
    Factor(const Factor&) = delete;
    Eigen::Index rows() const { return size_; }
    Eigen::Index size_;
  };
  std::optional<Factor> factor;
  renew_factor(factor, 3);
  factor->size_ = 4;
  renew_factor(factor, 4);
  EXPECT_EQ(factor->rows(), 4) << "one of the right size stays";
  renew_factor(factor, 5);
  EXPECT_EQ(factor->rows(), 5);
}

}  // namespace renew_test
}  // namespace pounding
