// Blocks of uncoupled links, found in a flexibility with zeros outside the blocks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <pounding/stepping/links/link_blocks.hpp>

namespace pounding {
namespace link_blocks_test {

using Eigen::Index;

/// As in a row of bodies, in which each link is coupled to its neighbours in the same block; blocks of one to five
/// links. Random, symmetric, positive definite.
struct Row {
  std::vector<Index> ends;
  Eigen::MatrixXd flexibility = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd x = Eigen::VectorXd::Random(count);
  LinkBlocks blocks;

  static constexpr Index count = 3 * LinkBlocks::many;

  Row() {
    const Eigen::VectorXd random = Eigen::VectorXd::Random(count);
    Index size = 1;
    for (Index first = 0; first < count; first += size, size = size % 5 + 1) {
      ends.push_back(std::min(first + size, count));
      for (Index i = first; i < ends.back(); ++i) {
        flexibility(i, i) = 3 + random[i];
        if (i > first) flexibility(i, i - 1) = flexibility(i - 1, i) = random[i];
      }
    }
    blocks.find(flexibility);
  }

  /// Block ends with those from `first` up to `last` removed.
  std::vector<Index> joined(std::size_t first, std::size_t last) const {
    std::vector<Index> left = ends;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(first), left.begin() + static_cast<std::ptrdiff_t>(last));
    return left;
  }

  double miss(const BlockFactors& factors, const Eigen::VectorXd& roots) const {
    Eigen::MatrixXd matrix = roots.asDiagonal() * flexibility * roots.asDiagonal();
    matrix.diagonal().array() += 1;
    Eigen::VectorXd found = x;
    factors.solve(found);
    const Eigen::VectorXd expected = matrix.partialPivLu().solve(x);
    return (found - expected).norm() / expected.norm();
  }
};

TEST(LinkBlocks, EndWhereNoLinkActsOnOneBefore) {
  Row row;
  EXPECT_EQ(row.blocks.ends(), row.ends);
  for (Index i = 0; i < Row::count; ++i) {
    const auto [first, end] = row.blocks.range(i);
    EXPECT_LE(first, i);
    EXPECT_LT(i, end);
    for (Index j = 0; j < Row::count; ++j)
      EXPECT_TRUE((j >= first && j < end) || row.flexibility(i, j) == 0) << i << ' ' << j;
  }
}

// From either half of the matrix, and across uncoupled blocks in between.
TEST(LinkBlocks, HoldAllLinksThatActOnEachOther) {
  for (const bool upper : {false, true})
    for (const auto& [first, last] : std::vector<std::pair<std::size_t, std::size_t>>{{3, 4}, {3, 9}, {0, 60}}) {
      Row row;
      const Index i = row.ends[first] - 1, j = row.ends[last] - 1;
      (upper ? row.flexibility(i, j) : row.flexibility(j, i)) = 1e-300;
      row.blocks.find(row.flexibility);
      EXPECT_EQ(row.blocks.ends(), row.joined(first, last)) << upper << first << last;
    }
}

TEST(LinkBlocks, OfFewLinksAreOne) {
  LinkBlocks blocks;
  for (const Index count : {Index{1}, LinkBlocks::many - 1}) {
    blocks.find(Eigen::MatrixXd::Identity(count, count));
    EXPECT_EQ(blocks.ends(), std::vector<Index>{count});
    EXPECT_EQ(blocks.range(count - 1), std::make_pair(Index{0}, count));
  }
  blocks.find(Eigen::MatrixXd::Identity(LinkBlocks::many, LinkBlocks::many));
  EXPECT_EQ(blocks.ends().size(), static_cast<std::size_t>(LinkBlocks::many));
}

TEST(LinkBlocks, MultiplyToTheBitsOfAllTerms) {
  const Row row;
  Eigen::VectorXd product, sizes;
  row.blocks.multiply(row.flexibility, row.x, product);
  row.blocks.multiply_sizes(row.flexibility, row.x, sizes);
  for (Index i = 0; i < Row::count; ++i) {
    double sum = 0, size = 0;
    for (Index j = 0; j < Row::count; ++j) {
      sum += row.flexibility(i, j) * row.x[j];
      size += std::abs(row.flexibility(i, j) * row.x[j]);
    }
    EXPECT_EQ(product[i], sum) << i;
    EXPECT_EQ(sizes[i], size) << i;
  }
}

TEST(BlockFactors, SolveForAllLinks) {
  Row row;
  Eigen::VectorXd roots = Eigen::VectorXd::Random(Row::count).array() + 2;
  BlockFactors factors;
  ASSERT_TRUE(factors.factorize(row.blocks, row.flexibility, roots));
  EXPECT_LT(row.miss(factors, roots), 1e-13);
  ASSERT_TRUE(factors.factorize(row.blocks, row.flexibility, roots));
  EXPECT_LT(row.miss(factors, roots), 1e-13) << "they stay";
}

TEST(BlockFactors, FollowEachNumberAndTheBlocks) {
  Row row;
  Eigen::VectorXd roots = Eigen::VectorXd::Constant(Row::count, 1.5);
  BlockFactors factors;
  ASSERT_TRUE(factors.factorize(row.blocks, row.flexibility, roots));
  for (Index i = 0; i < Row::count; i += 7) {
    roots[i] += 0.5;
    ASSERT_TRUE(factors.factorize(row.blocks, row.flexibility, roots));
    EXPECT_LT(row.miss(factors, roots), 1e-13) << "root " << i;
    row.flexibility(i, i) += 0.5;
    ASSERT_TRUE(factors.factorize(row.blocks, row.flexibility, roots));
    EXPECT_LT(row.miss(factors, roots), 1e-13) << "flexibility " << i;
  }
  row.flexibility(row.ends[3], row.ends[3] - 1) = row.flexibility(row.ends[3] - 1, row.ends[3]) = 0.5;
  row.blocks.find(row.flexibility);
  ASSERT_TRUE(factors.factorize(row.blocks, row.flexibility, roots));
  EXPECT_LT(row.miss(factors, roots), 1e-13) << "two blocks become one";
}

TEST(BlockFactors, SayThatABlockIsNotPositiveDefinite) {
  Row row;
  const Eigen::VectorXd roots = Eigen::VectorXd::Ones(Row::count);
  const double before = std::exchange(row.flexibility(Row::count - 1, Row::count - 1), -5);
  BlockFactors factors;
  for (const int time : {1, 2}) EXPECT_FALSE(factors.factorize(row.blocks, row.flexibility, roots)) << time;
  row.flexibility(Row::count - 1, Row::count - 1) = before;
  ASSERT_TRUE(factors.factorize(row.blocks, row.flexibility, roots));
  EXPECT_LT(row.miss(factors, roots), 1e-13);
}

}  // namespace link_blocks_test
}  // namespace pounding
