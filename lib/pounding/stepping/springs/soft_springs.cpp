#include <pounding/stepping/springs/soft_springs.hpp>

#include <Eigen/LU>
#include <cmath>

#include <pounding/stepping/links/link_solver.hpp>

namespace pounding {

double SoftSprings::flexibility(const CondensedLinks& links, int i, int j) {
  return links.by_u * links.weight * links.flexibility(i, j) + (links.relief ? (*links.relief)(i, j) : 0);
}

// Selects the yielding springs and the roots of their D.
void SoftSprings::choose(const Eigen::VectorXd& slopes) {
  soft_.clear();
  for (int i = 0; i < slopes.size(); ++i)
    if (slopes[i] < 0) soft_.push_back(i);
  const auto count = static_cast<Eigen::Index>(soft_.size());
  root_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) root_[i] = std::sqrt(-slopes[soft_[i]]);
}

void SoftSprings::find_by_others(const CondensedLinks& links, const Eigen::VectorXd& forces) {
  by_others_.noalias() = links.by_u * links.weight * (links.flexibility * forces);
  if (!links.relief) return;
  relief_.noalias() = *links.relief * forces;
  by_others_ += relief_;
}

// Factorizes the block of `count` soft springs starting at `first`.
bool SoftSprings::factorize(const CondensedLinks& links, Eigen::Index first, Eigen::Index count) {
  const double by_u = links.by_u * links.weight;
  matrix_.resize(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const int column = soft_[first + j];
    for (Eigen::Index i = 0; i < count; ++i) {
      const int row = soft_[first + i];
      const double relief = links.relief ? (*links.relief)(row, column) : 0;
      matrix_(i, j) = root_[first + i] * (-by_u * links.flexibility(row, column) - relief) * root_[first + j];
    }
    matrix_(j, j) += 1;
  }
  if (!factor_ || factor_->rows() != count) factor_.emplace(count);
  factor_->compute(matrix_);
  return factor_->info() == Eigen::Success;
}

bool SoftSprings::solve(const CondensedLinks& links, const Eigen::VectorXd& slopes, const Eigen::VectorXd& residual,
                        Eigen::VectorXd& direction) {
  choose(slopes);
  direction = residual;
  const auto count = static_cast<Eigen::Index>(soft_.size());
  if (count == 0) return true;
  for (const int i : soft_) direction[i] = 0;
  find_by_others(links, direction);
  right_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) right_[i] = residual[soft_[i]] / root_[i] + root_[i] * by_others_[soft_[i]];
  if (count >= min_by_structure) {
    if (!solve_blocks(links, right_)) return false;
  } else {
    if (!factorize(links, 0, count)) return false;
    factor_->solveInPlace(right_);
  }
  for (Eigen::Index i = 0; i < count; ++i) direction[soft_[i]] = root_[i] * right_[i];
  return true;
}

// Springs of a structure are contiguous: number of soft springs, starting at `first`, that do not act on later ones.
Eigen::Index SoftSprings::block_from(const CondensedLinks& links, Eigen::Index first) const {
  const auto count = static_cast<Eigen::Index>(soft_.size());
  Eigen::Index last = first;
  for (Eigen::Index i = first; i <= last; ++i)
    for (Eigen::Index j = count - 1; j > last; --j)
      if (flexibility(links, soft_[i], soft_[j]) != 0) last = j;
  return last - first + 1;
}

bool SoftSprings::solve_blocks(const CondensedLinks& links, Eigen::Ref<Eigen::MatrixXd> right) {
  for (Eigen::Index first = 0, count = static_cast<Eigen::Index>(soft_.size()); first < count;) {
    const Eigen::Index block = block_from(links, first);
    if (!factorize(links, first, block)) return false;
    auto rows = right.middleRows(first, block);
    factor_->solveInPlace(rows);
    first += block;
  }
  return true;
}

bool SoftSprings::answer(const CondensedLinks& links, const Eigen::VectorXd& slopes, Eigen::MatrixXd& deformations) {
  choose(slopes);
  deformations.array().colwise() *= -root_.array();
  if (!solve_blocks(links, deformations)) return false;
  deformations.array().colwise() *= root_.array();
  return true;
}

bool SoftSprings::solve_beside(const CondensedLinks& links, const std::vector<int>& others,
                               const Eigen::MatrixXd& matrix, const Eigen::VectorXd& slopes,
                               const Eigen::VectorXd& residual, Eigen::VectorXd& direction) {
  choose(slopes);
  const auto count = static_cast<Eigen::Index>(soft_.size()), beside = static_cast<Eigen::Index>(others.size());
  direction = residual;
  for (const int i : soft_) direction[i] = 0;
  for (const int i : others) direction[i] = 0;
  find_by_others(links, direction);
  // One column for the residual and one for a unit force of each other link.
  by_links_.resize(count, 1 + beside);
  for (Eigen::Index i = 0; i < count; ++i) {
    by_links_(i, 0) = residual[soft_[i]] / root_[i] + root_[i] * by_others_[soft_[i]];
    for (Eigen::Index j = 0; j < beside; ++j) by_links_(i, 1 + j) = root_[i] * flexibility(links, soft_[i], others[j]);
  }
  if (!solve_blocks(links, by_links_)) return false;
  by_links_.array().colwise() *= root_.array();
  const Eigen::MatrixXd by_soft = matrix(others, soft_);
  Eigen::MatrixXd own = matrix(others, others);
  own.noalias() += by_soft * by_links_.rightCols(beside);
  Eigen::VectorXd right = residual(others) - matrix(others, Eigen::all) * direction;
  right.noalias() -= by_soft * by_links_.col(0);
  const Eigen::VectorXd forces = own.partialPivLu().solve(right);
  for (Eigen::Index j = 0; j < beside; ++j) direction[others[j]] = forces[j];
  right_.noalias() = by_links_.rightCols(beside) * forces;
  for (Eigen::Index i = 0; i < count; ++i) direction[soft_[i]] = by_links_(i, 0) + right_[i];
  return true;
}

}  // namespace pounding
