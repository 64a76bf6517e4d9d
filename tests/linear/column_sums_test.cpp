// Sums over columns are bitwise identical to a plain loop, whatever the vector width of the machine.

#include <gtest/gtest.h>

#include <algorithm>
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
          const volatile double product = a(i, j) * x[j];  // prevents a fused operation
          sum += product;
        }
        EXPECT_EQ(y[static_cast<std::size_t>(i)], sum) << rows << " x " << columns << ", row " << i;
      }
      EXPECT_EQ(y.back(), 7.0) << rows << " x " << columns;  // rows after the last one are not written
    }
}

TEST(ColumnSums, HaveTheSameBitsForAnyNumberOfVectorsAtATime) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (const int rows : {1, 3, 4, 15, 16, 17, 40, 100})
    for (const int columns : {1, 5, 130, 700}) {
      const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(rows + 2, columns, [&] { return normal(random); });
      const Eigen::MatrixXd x = Eigen::MatrixXd::NullaryExpr(columns, 16, [&] { return normal(random); });
      const Eigen::MatrixXd begin = Eigen::MatrixXd::NullaryExpr(rows + 1, 16, [&] { return normal(random); });
      Eigen::MatrixXd loop = begin;
      for (int c = 0; c < 16; ++c)
        for (int j = 0; j < columns; ++j)
          for (int i = 0; i < rows; ++i) {
            const volatile double product = a(i, j) * x(j, c);
            loop(i, c) += product;
          }
      for (const int together : {1, 2, 3, 4, 5, 16}) {
        Eigen::MatrixXd y = begin;
        for (int c = 0; c < 16; c += together)
          add_products({a.data(), rows, columns, a.rows()},
                       {x.data() + c * x.rows(), columns, std::min(together, 16 - c), x.rows()},
                       y.data() + c * y.rows(), y.rows());
        EXPECT_EQ(y, loop) << rows << " x " << columns << ", " << together << " vectors";
      }
    }
}

TEST(ScaledColumns, HaveTheBitsOfOneLoopWithWeightsAndWithout) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const int rows : {1, 4, 15, 16, 37})
    for (const bool weighed : {false, true}) {
      const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(rows, 5, [&] { return normal(random); });
      const Eigen::VectorXd w = Eigen::VectorXd::NullaryExpr(rows, [&] { return normal(random); });
      Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(rows + 1, [&] { return normal(random); }), loop = y;
      std::vector<ScaledColumn> columns;
      for (const int j : {3, 0, 4}) {
        const double factor = normal(random);
        columns.push_back({a.col(j).data(), factor});
        for (int i = 0; i < rows; ++i) {
          const volatile double scale = factor * (weighed ? w[i] : 1), product = scale * a(i, j);
          loop[i] += product;
        }
      }
      add_scaled(columns, rows, weighed ? w.data() : nullptr, y.data());
      EXPECT_EQ(y, loop) << rows;
    }
}

}  // namespace column_sums_test
}  // namespace pounding
