#include <pounding/frames/static_solver.hpp>

#include <cmath>
#include <utility>

namespace pounding {

using Eigen::VectorXd;

namespace {

constexpr double rounding = 2e-14;
// Above this value, the matrix is regular in spite of round-off.
constexpr double beyond_doubt = 1e-12;

VectorXd unit_diagonal(const VectorXd& diagonal) {
  return diagonal.unaryExpr([](double k) { return k == 0 ? 1.0 : 1 / std::sqrt(std::abs(k)); });
}

}  // namespace

StaticSolver::StaticSolver(const Eigen::SparseMatrix<double>& stiffness) : scale_(unit_diagonal(stiffness.diagonal())) {
  const Eigen::Index n = stiffness.rows();
  if (n == 0) return;
  scaled_ = scale_.asDiagonal() * stiffness * scale_.asDiagonal();
  factors_.compute(scaled_);
  if (const Motion weakest = weakest_motion(); weakest.positive && weakest.eigenvalue > beyond_doubt) return;
  Eigen::SparseMatrix<double> unit(n, n);
  unit.setIdentity();
  // Shifted, so that a singular matrix can be factorized: inverse iteration then converges to its null vector.
  factors_.compute(scaled_ + rounding * unit);
  shifted_ = true;
  const Motion weakest = weakest_motion();
  if (!weakest.positive || weakest.eigenvalue < rounding) {
    mode_ = scale_.cwiseProduct(weakest.shape);
    buckles_ = weakest.eigenvalue < -rounding;
  }
}

StaticSolver::Motion StaticSolver::weakest_motion() const {
  Eigen::Index weakest = 0;
  Motion found;
  found.positive = factors_.info() == Eigen::Success && factors_.vectorD().minCoeff(&weakest) > 0;
  // With L^T x equal to the unit vector of the weakest pivot, x^T K x is this pivot.
  VectorXd& x = found.shape = VectorXd::Unit(scale_.size(), weakest);
  if (factors_.info() == Eigen::Success) {
    factors_.matrixU().solveInPlace(x);
    x = (factors_.permutationPinv() * x).eval();
  }
  for (int i = 0; found.positive && i < 4; ++i) x = factors_.solve(x).normalized();
  found.eigenvalue = x.dot(scaled_ * x) / x.squaredNorm();
  return found;
}

Eigen::MatrixXd StaticSolver::solve(const Eigen::MatrixXd& forces) {
  if (scale_.size() == 0) return forces;
  if (std::exchange(shifted_, false)) factors_.factorize(scaled_);
  const Eigen::MatrixXd f = scale_.asDiagonal() * forces;
  Eigen::MatrixXd x = factors_.solve(f);
  x += factors_.solve(f - scaled_ * x);
  return scale_.asDiagonal() * x;
}

}  // namespace pounding
