// Sums over columns have the bits of a plain loop, whatever vectors the machine has.

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include <pounding/linear/column_sums.hpp>

namespace pounding {
namespace column_sums_test {

TEST(ColumnSums, HaveTheBitsOfOneLoopForEveryNumberOfRows) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int rows = 0; rows <= 45; ++rows)
    for (const int columns : {0, 1, 2, 7, 40, 130}) {
      const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
      const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(columns, [&] { return normal(random); });
      std::vector<double> y(static_cast<std::size_t>(rows) + 1, 7.0);
      sum_columns(a, x.data(), y.data());
      for (int i = 0; i < rows; ++i) {
        double sum = 0;
        for (int j = 0; j < columns; ++j) {
          const volatile double product = a(i, j) * x[j];  // no fused operation
          sum += product;
        }
        EXPECT_EQ(y[static_cast<std::size_t>(i)], sum) << rows << " x " << columns << ", row " << i;
      }
      EXPECT_EQ(y.back(), 7.0) << rows << " x " << columns;  // nothing is written behind the last row
    }
}

}  // namespace column_sums_test
}  // namespace pounding
