#pragma once
/// Active links in independent groups.

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace pounding {

/// Diagonal blocks of a flexibility G; all other entries are zero. Links are ordered by structure: a block ends where
/// no later link acts on an earlier one. In a row of buildings with hundreds of simultaneous contacts, few links share
/// a building. Products and factorizations then cost the squares and cubes of the block sizes, not of the number of
/// links.
class LinkBlocks {
 public:
  /// Index of a link among the active ones.
  using Index = Eigen::Index;
  /// With fewer links than this, all form one block and G is not examined.
  static constexpr Index many = 64;

  /// Finds the blocks of this flexibility.
  void find(const Eigen::MatrixXd& flexibility);
  /// End index of each block.
  const std::vector<Index>& ends() const { return ends_; }
  /// First and end index of the block that contains this link.
  std::pair<Index, Index> range(Index link) const;

  /// y = G x.
  void multiply(const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// y = |G| |x|, the magnitude of these terms.
  void multiply_sizes(const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

 private:
  std::vector<Index> ends_;
  std::vector<Index> block_;  // block of each link; empty if there is only one
  std::vector<Index> reach_;  // last link that acts on this link or on an earlier one
};

/// Cholesky factors of the blocks of 1 + R G R, where R is diagonal.
class BlockFactors {
 public:
  /// Factorizes, or reuses the factors if G and R are unchanged. False if a block is not positive definite.
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
