#include <pounding/stepping/soft_springs.hpp>

#include <cmath>

#include <pounding/stepping/link_solver.hpp>

namespace pounding {

bool SoftSprings::solve(const CondensedLinks& links, const Eigen::VectorXd& slopes, const Eigen::VectorXd& residual, Eigen::VectorXd& direction) {
  soft_.clear();
  for (int i = 0; i < slopes.size(); ++i)
    if (slopes[i] < 0) soft_.push_back(i);
  direction = residual;
  const auto count = static_cast<Eigen::Index>(soft_.size());
  if (count == 0) return true;
  const double by_u = links.by_u * links.weight;
  root_.resize(count);
  right_.resize(count);
  matrix_.resize(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    root_[i] = std::sqrt(-slopes[soft_[i]]);
    direction[soft_[i]] = 0;
  }
  by_others_.noalias() = by_u * (links.flexibility * direction);
  if (links.relief) {
    relief_.noalias() = *links.relief * direction;
    by_others_ += relief_;
  }
  for (Eigen::Index j = 0; j < count; ++j) {
    const int column = soft_[j];
    for (Eigen::Index i = 0; i < count; ++i) {
      const double relief = links.relief ? (*links.relief)(soft_[i], column) : 0;
      matrix_(i, j) = root_[i] * (-by_u * links.flexibility(soft_[i], column) - relief) * root_[j];
    }
    matrix_(j, j) += 1;
  }
  factor_.compute(matrix_);
  if (factor_.info() != Eigen::Success) return false;
  for (Eigen::Index i = 0; i < count; ++i) right_[i] = residual[soft_[i]] / root_[i] + root_[i] * by_others_[soft_[i]];
  factor_.solveInPlace(right_);
  for (Eigen::Index i = 0; i < count; ++i) direction[soft_[i]] = root_[i] * right_[i];
  return true;
}

}  // namespace pounding
