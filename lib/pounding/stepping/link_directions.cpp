/// Newton steps of LinkSolver by symmetric factors.

#include <pounding/stepping/link_solver.hpp>

#include <vector>

namespace pounding {

// Springs alone, none of which is stiffer than its linear stiffness or has a dashpot.
bool LinkSolver::is_symmetric(const CondensedLinks& links) const {
  return links.active.front() >= links_.contacts() && links.active.back() < links_.frictions_from() && by_rate_.isZero(0) &&
         by_penetration_.maxCoeff() <= 0;
}

// The Newton step over the springs that are softer, scaled by the roots of D; the others take their residual. False where the
// structure is unstable.
bool LinkSolver::symmetric_direction(const CondensedLinks& links, Eigen::VectorXd& direction) {
  std::vector<int> soft;
  for (int i = 0; i < by_penetration_.size(); ++i)
    if (by_penetration_[i] < 0) soft.push_back(i);
  direction = residual_;
  if (soft.empty()) return true;
  const double by_u = links.by_u * links.weight;
  const Eigen::VectorXd root = (-by_penetration_(soft)).cwiseSqrt();
  direction(soft).setZero();
  Eigen::VectorXd by_others = by_u * (links.flexibility * direction);
  if (links.relief) by_others += *links.relief * direction;
  const Eigen::VectorXd given = by_others(soft);
  Eigen::MatrixXd matrix = -by_u * links.flexibility(soft, soft);
  if (links.relief) matrix -= (*links.relief)(soft, soft);
  matrix = root.asDiagonal() * matrix * root.asDiagonal();
  matrix.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  if (factor.info() != Eigen::Success) return false;
  const Eigen::VectorXd right = residual_(soft).cwiseQuotient(root) + root.cwiseProduct(given);
  direction(soft) = root.cwiseProduct(factor.solve(right));
  return true;
}

// Contacts and springs whose forces grow with penetration and rate: with the slopes D a Newton step is (1 + D G) dF = ..., which the roots R of D
// make symmetric and positive definite.
bool LinkSolver::direction_by_cholesky(const CondensedLinks& links, Eigen::VectorXd& direction) {
  const double by_u = links.by_u * links.weight, by_v = links.by_v * links.weight;
  const Eigen::VectorXd slopes = by_u * by_penetration_ + by_v * by_rate_;
  if (!(slopes.minCoeff() > 0)) return false;
  const Eigen::VectorXd roots = slopes.cwiseSqrt();
  if (roots.size() != roots_.size() || roots != roots_ || factored_flexibility_ != links.flexibility) {
    roots_ = roots;
    factored_flexibility_ = links.flexibility;
    Eigen::MatrixXd matrix = roots.asDiagonal() * links.flexibility * roots.asDiagonal();
    matrix.diagonal().array() += 1;
    factor_.compute(matrix);
    if (factor_.info() != Eigen::Success) roots_.resize(0);
  }
  if (roots_.size() == 0) return false;
  direction = roots.cwiseProduct(factor_.solve(residual_.cwiseQuotient(roots)));
  return true;
}

void LinkSolver::fill_slopes(const CondensedLinks& links) {
  const double by_u = links.by_u * links.weight, by_v = links.by_v * links.weight;
  slopes_ = (by_u * by_penetration_ + by_v * by_rate_).asDiagonal() * links.flexibility;
  slopes_.diagonal().array() += 1;
}

}  // namespace pounding
