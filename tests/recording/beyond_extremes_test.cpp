#include <pounding/recording/beyond_extremes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <pounding/recording/linear_quantities.hpp>

namespace pounding {
namespace beyond_extremes_test {

constexpr int batch = LinearQuantities::batch;
using Batch = LinearQuantities::Instants<batch>;

Batch random_batch(int columns, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  return Batch::NullaryExpr(2 * batch, columns, [&] { return any(random); });
}

// Exceeded in the last digit, above or below, at any knot or at the previous one, with or without the rate.
TEST(BeyondExtremes, AreFoundWhereverTheyAre) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  constexpr int count = 40;
  for (int round = 0; round < 200; ++round) {
    const Batch evaluated = random_batch(count, random);
    const Eigen::VectorXd values = Eigen::VectorXd::NullaryExpr(count, [&] { return any(random); });
    const Eigen::VectorXd rates = Eigen::VectorXd::NullaryExpr(count, [&] { return any(random); });
    const Eigen::Array<double, batch, 1> third =
        Eigen::Array<double, batch, 1>::NullaryExpr([&] { return 0.1 * std::abs(any(random)); });
    const double third_begin = third[0];
    Extremes extremes(count);
    std::vector<int> wanted;
    for (int q = 0; q < count; ++q) {
      const auto at = evaluated.col(q).head<batch>().array();
      const Eigen::Array<double, batch, 1> away = third * evaluated.col(q).tail<batch>().array().abs();
      const double largest = std::max((at + away).maxCoeff(), values[q] + third_begin * std::abs(rates[q]));
      const double minimum = std::min((at - away).minCoeff(), values[q] - third_begin * std::abs(rates[q]));
      const int kind = static_cast<int>(random() % 4);
      extremes.update(q, 0, kind == 1 ? std::nextafter(largest, -9) : largest);
      extremes.update(q, 0, kind == 2 ? std::nextafter(minimum, 9) : minimum);
      if (kind == 1 || kind == 2) wanted.push_back(q);
    }
    std::vector<int> found;
    find_beyond({evaluated, values, rates, third, third_begin}, extremes, found);
    EXPECT_EQ(found, wanted);
  }
}

TEST(LinearQuantities, AreTheSameOneByOneAndInBatches) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  constexpr int rows = 9, unknowns = 12, first = 3;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < unknowns; ++j)
      if (random() % 3 == 0) entries.emplace_back(i, j, any(random));
  Eigen::SparseMatrix<double, Eigen::RowMajor> by_unknowns(rows, unknowns);
  by_unknowns.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd at_rest = Eigen::VectorXd::NullaryExpr(rows, [&] { return any(random); });
  const LinearQuantities quantities(
      by_unknowns, unknowns, first, at_rest, Eigen::MatrixXd(rows, 0), [](int) { return true; }, false);
  const Batch motions = random_batch(first + unknowns, random);
  const std::vector<double> times(batch, 0.0);
  Batch together;
  quantities.evaluate<batch>(motions, times, {}, together);
  for (int t = 0; t < batch; ++t) {
    LinearQuantities::Instants<1> motion(2, first + unknowns), alone;
    motion.row(0) = motions.row(t);
    motion.row(1) = motions.row(batch + t);
    quantities.evaluate<1>(motion, std::span(times).first(1), {}, alone);
    for (int q = 0; q < rows; ++q) {
      double value = at_rest[q], rate = 0;
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_unknowns, q); it; ++it) {
        value += it.value() * motions(t, first + it.col());
        rate += it.value() * motions(batch + t, first + it.col());
      }
      EXPECT_EQ(together(t, q), value);
      EXPECT_EQ(together(batch + t, q), rate);
      EXPECT_EQ(alone(0, q), value);
      EXPECT_EQ(alone(1, q), rate);
    }
  }
}

}  // namespace beyond_extremes_test
}  // namespace pounding
