/// Newton directions of LinkSolver.

#include <pounding/stepping/links/link_solver.hpp>

#include <algorithm>
#include <cmath>

namespace pounding {

// True for springs only, none of which is coupled, stiffer than its linear stiffness or has a dashpot.
bool LinkSolver::is_symmetric(const CondensedLinks& links) const {
  return coupled_.empty() && links.active.front() >= links_.contacts() &&
         links.active.back() < links_.frictions_from() && by_rate_.isZero(0) && by_penetration_.maxCoeff() <= 0;
}

// Rows of slopes_ except for friction and coupled elements, from the slopes of the last residual() call that computed
// them.
void LinkSolver::find_slopes(const CondensedLinks& links) {
  const Eigen::MatrixXd& g = links.flexibility;
  const double by_u = links.by_u * links.weight, by_v = links.by_v * links.weight;
  slopes_.resize(g.rows(), g.cols());
  for (const int i : scalars_) {
    if (links_.is_held(links.active[i])) {
      slopes_.row(i) = g.row(i) / g(i, i);
      continue;
    }
    slopes_.row(i) = (by_u * by_penetration_[i] + by_v * by_rate_[i]) * g.row(i);
    if (links.relief) slopes_.row(i) += by_penetration_[i] * links.relief->row(i);
    slopes_(i, i) += 1;
  }
}

// For contacts and springs whose forces increase with penetration and rate: with the slopes D, a Newton step is (1 + D
// G) dF = ..., which the roots R of D make symmetric and positive definite.
bool LinkSolver::find_direction_by_cholesky(const CondensedLinks& links) {
  const double by_u = links.by_u * links.weight, by_v = links.by_v * links.weight;
  const Eigen::VectorXd slopes = by_u * by_penetration_ + by_v * by_rate_;
  if (!(slopes.minCoeff() > 0)) return false;
  const Eigen::VectorXd roots = slopes.cwiseSqrt();
  if (!factors_.factorize(*links.blocks, links.flexibility, roots)) return false;
  direction_ = residual_.cwiseQuotient(roots);
  factors_.solve(direction_);
  direction_.array() *= roots.array();
  return true;
}

// Newton step by eliminating the springs first, if possible and efficient.
bool LinkSolver::eliminates_springs(const CondensedLinks& links) {
  int soft = 0;
  others_.clear();
  slopes_of_springs_.setZero(by_penetration_.size());
  for (int k = 0; k < by_penetration_.size(); ++k) {
    if (!links_.is_spring(links.active[k]) || links_.is_coupled(links.active[k]) || by_rate_[k] != 0 ||
        by_penetration_[k] > 0) {
      others_.push_back(k);
      continue;
    }
    slopes_of_springs_[k] = by_penetration_[k];
    if (by_penetration_[k] < 0) ++soft;
  }
  return soft >= SoftSprings::min_by_structure &&
         soft_springs_.solve_beside(links, others_, slopes_, slopes_of_springs_, residual_, direction_);
}

// A step along the Newton direction that reduces the slope of a potential of the forces, for cases in which no step
// reduces the residuals: yielding parts all around a massless joint leave its rotation almost free, and the first
// directions are a thousand times too long. The force of each link depends only on its own component of H F, and H is
// symmetric, so the residuals derive from a potential with slope -r H dF along dF. It is convex while the tangent of
// the step is positive definite; then steps that reduce this slope converge to the unique solution.
bool LinkSolver::descend(const CondensedLinks& links, Eigen::VectorXd& f) {
  const auto held = [this](int link) { return links_.is_held(link); };
  if (static_cast<Eigen::Index>(scalars_.size()) != f.size() ||
      std::any_of(links.active.begin(), links.active.end(), held))
    return false;
  Eigen::VectorXd relief = links.by_u * links.weight * (links.flexibility * direction_);
  if (links.relief) relief += *links.relief * direction_;
  residual(links, f, false);
  const double steepest = residual_.dot(relief);
  if (!(steepest > 0)) return false;
  double low = 0, high = 1, length = 1;
  for (int attempt = 0; attempt < 60; ++attempt) {
    trial_ = f + length * direction_;
    residual(links, trial_, false);
    const double slope = residual_.dot(relief);
    if (std::abs(slope) <= 0.5 * steepest || (length == 1 && slope > 0)) {
      f = trial_;
      return true;
    }
    (slope > 0 ? low : high) = length;
    length = low == 0 ? 0.1 * high : 0.5 * (low + high);
  }
  return false;
}

}  // namespace pounding
