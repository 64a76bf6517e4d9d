#include <pounding/linear/dense_products.hpp>

#include <gtest/gtest.h>

#include <random>

namespace pounding {
namespace dense_products_test {

using Eigen::MatrixXd;

class DenseProducts : public testing::TestWithParam<int> {
 protected:
  MatrixXd random(Eigen::Index rows, Eigen::Index columns) {
    return MatrixXd::NullaryExpr(rows, columns, [this] { return normal_(source_); });
  }

 private:
  std::mt19937 source_{4};
  std::normal_distribution<double> normal_;
};

// On both sides of the size from which BLAS is used.
INSTANTIATE_TEST_SUITE_P(Rows, DenseProducts, testing::Values(200, 1000, 1001, 1700));

TEST_P(DenseProducts, AreSumsOfProducts) {
  const int rows = GetParam();
  const MatrixXd a = random(rows, 70), b = random(rows, 33), c = random(70, 33);
  using Long = Eigen::Matrix<long double, -1, -1>;
  const Long a_long = a.cast<long double>(), b_long = b.cast<long double>(), c_long = c.cast<long double>();
  const MatrixXd transposed = (a_long.transpose() * b_long).cast<double>(), plain = (a_long * c_long).cast<double>();
  // The round-off of a sum grows with its length and the size of its terms, a few units here.
  EXPECT_LT((petsc::transposed_product(a, b) - transposed).lpNorm<Eigen::Infinity>(), 1e-15 * rows);
  EXPECT_LT((petsc::product(a, c) - plain).lpNorm<Eigen::Infinity>(), 1e-15 * 70 * 4);
}

TEST_P(DenseProducts, AreComputedOnOneSideOfTheDiagonalWhereTheyAreSymmetric) {
  const int rows = GetParam();
  for (const int count : {1, 3, 47, 48, 49, 191, 192, 193, 400}) {
    const MatrixXd a = random(rows, count);
    const MatrixXd b = a.array().colwise() * Eigen::ArrayXd::LinSpaced(rows, 1, 3);
    const MatrixXd whole = petsc::transposed_product(a, b), half = petsc::symmetric_product(a, b);
    EXPECT_EQ(half, half.transpose()) << count;
    EXPECT_LT((half - whole).lpNorm<Eigen::Infinity>(), 1e-14 * rows) << count;
  }
}

TEST_P(DenseProducts, OfNothingAreEmptyOrZero) {
  const int rows = GetParam();
  EXPECT_EQ(petsc::product(MatrixXd(rows, 0), MatrixXd(0, 2)), MatrixXd::Zero(rows, 2));
  EXPECT_EQ(petsc::transposed_product(MatrixXd(rows, 0), MatrixXd(rows, 3)).size(), 0);
  EXPECT_EQ(petsc::symmetric_product(MatrixXd(rows, 0), MatrixXd(rows, 0)).size(), 0);
}

}  // namespace dense_products_test
}  // namespace pounding
