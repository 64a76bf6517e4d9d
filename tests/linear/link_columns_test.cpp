// Columns of B by blocks: sums are bitwise identical to a plain loop for any set of links.

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include <pounding/linear/link_columns.hpp>

namespace pounding {
namespace link_columns_test {

// Three structures of 7, 20 and 33 coordinates; nine links, mainly between two structures.
struct Links {
  static constexpr int count = 9, coordinates = 60;
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(coordinates, count);
  Eigen::VectorXd d;
  LinkColumns columns{count};

  Links() {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const auto add = [&](int first, int size, std::vector<int> links) {
      Eigen::MatrixXd own =
          Eigen::MatrixXd::NullaryExpr(size, static_cast<int>(links.size()), [&] { return normal(random); });
      for (std::size_t i = 0; i < links.size(); ++i)
        b.col(links[i]).segment(first, size) = own.col(static_cast<int>(i));
      columns.add_block(first, std::move(links), std::move(own));
    };
    add(0, 7, {0, 1, 2, 3, 4});
    add(7, 20, {0, 2, 5, 6, 7, 8});
    add(27, 33, {1, 3, 4, 5, 7});
    d = Eigen::VectorXd::NullaryExpr(coordinates, [&] { return std::abs(normal(random)); });
  }

  // Sums over the coordinates in order; those of another structure add zeros.
  double sum(int i, int j, bool weighed) const {
    double whole = 0;
    for (const auto& [first, size] : {std::pair(0, 7), {7, 20}, {27, 33}}) {
      double part = 0;
      for (int k = first; k < first + size; ++k) {
        const volatile double left = b(k, i) * (weighed ? d[k] : 1), product = left * b(k, j);
        part += product;
      }
      whole += part;
    }
    return whole;
  }
};

TEST(LinkColumns, GatherEachLinkWithTheSameBitsAloneAndAmongAll) {
  Links links;
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(Links::coordinates, 3);
  Eigen::MatrixXd all, some;
  links.columns.gather(x, all);
  for (int i = 0; i < Links::count; ++i)
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int k = 0; k < Links::coordinates; ++k) {
        const volatile double product = links.b(k, i) * x(k, c);
        sum += product;
      }
      EXPECT_EQ(all(i, c), sum) << i;
    }
  for (const std::vector<int>& chosen : {std::vector{5}, {0, 1, 8}, {2, 3, 4, 6}, {}}) {
    links.columns.choose(chosen);
    links.columns.gather_chosen(x, some);
    EXPECT_EQ(some, Eigen::MatrixXd(all(chosen, Eigen::all)));
  }
}

TEST(LinkColumns, AreAsFlexibleAmongAnyOthers) {
  Links links;
  Eigen::MatrixXd g;
  for (const std::vector<int>& chosen : {std::vector{0, 1, 2, 3, 4, 5, 6, 7, 8}, {4}, {0, 5, 7}}) {
    EXPECT_TRUE(links.columns.choose(chosen));
    EXPECT_FALSE(links.columns.choose(chosen));
    links.columns.flexibility(links.d, g);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      for (std::size_t j = i; j < chosen.size(); ++j) {
        EXPECT_EQ(g(i, j), links.sum(chosen[i], chosen[j], true)) << chosen[i] << " " << chosen[j];
        EXPECT_EQ(g(j, i), g(i, j));
      }
  }
}

TEST(LinkColumns, AddForcesAndResponses) {
  Links links;
  const Eigen::VectorXd f = Eigen::VectorXd::Random(Links::count);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(Links::coordinates), answer = y, solved = y;
  links.columns.add_forces(2, f, y);
  const Eigen::VectorXd expected = 2 * links.b * f;
  EXPECT_LT((y - expected).norm(), 1e-13 * expected.norm());
  const std::vector<int> chosen{1, 4, 7};
  links.columns.choose(chosen);
  const Eigen::VectorXd few = f(chosen);
  links.columns.add_response(2, few, links.d, answer);
  EXPECT_LT((answer - 2 * links.d.asDiagonal() * links.b(Eigen::all, chosen) * few).norm(), 1e-13 * answer.norm());
  const LinkColumns::Solve solve = [&](int first, Eigen::VectorXd& column) {
    column.array() *= links.d.segment(first, column.size()).array();
  };
  links.columns.add_response(2, few, solve, solved);
  EXPECT_LT((answer - solved).norm(), 1e-13 * answer.norm());
  Eigen::MatrixXd g, by_solves;
  links.columns.flexibility(links.d, g);
  links.columns.flexibility(solve, by_solves);
  EXPECT_LT((g - by_solves).norm(), 1e-13 * g.norm());
}

// Small blocks are summed link by link; a link without an end in any block is set to zero.
TEST(LinkColumns, GatherSmallBlocksWithTheSameBits) {
  for (const bool has_fixed_link : {false, true}) {
    const int count = has_fixed_link ? 3 : 2;
    LinkColumns columns(count);
    const Eigen::MatrixXd left = Eigen::MatrixXd::Random(2, 2), right = Eigen::MatrixXd::Random(3, 2),
                          x = Eigen::MatrixXd::Random(5, 4);
    columns.add_block(0, {0, 1}, left);
    columns.add_block(2, {0, 1}, right);
    Eigen::MatrixXd relative = Eigen::MatrixXd::Constant(count, 4, 7.0);
    columns.gather(x, relative);
    for (int c = 0; c < 4; ++c) {
      for (int i = 0; i < 2; ++i) {
        double sum = 0;
        for (int k = 0; k < 5; ++k) {
          const volatile double product = (k < 2 ? left(k, i) : right(k - 2, i)) * x(k, c);
          sum += product;
        }
        EXPECT_EQ(relative(i, c), sum) << i << " " << c;
      }
      EXPECT_EQ(relative.col(c).tail(count - 2).norm(), 0) << c;
    }
  }
}

}  // namespace link_columns_test
}  // namespace pounding
