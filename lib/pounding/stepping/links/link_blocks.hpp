#pragma once
/// Active links in groups that do not act on one another.

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace pounding {

/// The blocks along the diagonal of a flexibility G, outside of which it has zeros. Links follow each other by
/// structures: a block ends where no link behind it acts on one before. In a row of bodies of which some hundreds press
/// at once few links share a body, and the squares and cubes of the number of all links, which products and factors
/// cost, become those of the blocks.
class LinkBlocks {
 public:
  /// Number of a link among the active ones.
  using Index = Eigen::Index;
  /// Fewer links than this are one block, without a look at G.
  static constexpr Index many = 64;

  /// Looks for the blocks of this flexibility.
  void find(const Eigen::MatrixXd& flexibility);
  /// The numbers of links up to the end of each block.
  const std::vector<Index>& ends() const { return ends_; }
  /// First link of the block of this link, and its end.
  std::pair<Index, Index> range(Index link) const;

  /// y = G x.
  void multiply(const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// y = |G| |x|, the sizes of these terms.
  void multiply_sizes(const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

 private:
  std::vector<Index> ends_;
  std::vector<Index> block_;  // of each link; empty for one block
  std::vector<Index> reach_;  // the last link that acts on this one or on one before it
};

/// Cholesky factors of 1 + R G R, one a block, with a diagonal R. The factor of all links costs the cube of their
/// number.
class BlockFactors {
 public:
  /// They stay while G and R do. False if a block is not positive definite.
  bool factorize(const LinkBlocks& blocks, const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& roots);
  /// Replaces x by (1 + R G R)^-1 x.
  void solve(Eigen::VectorXd& x) const;

 private:
  bool stays(const LinkBlocks& blocks, const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& roots) const;

  std::vector<Eigen::Index> ends_;
  Eigen::VectorXd roots_;
  Eigen::VectorXd flexibility_, factors_;  // columns of each block, one block after the other
};

}  // namespace pounding
