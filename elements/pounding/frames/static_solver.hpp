#pragma once
/// Solves K q = f for a stiffness that must be positive definite, and finds the mode without stiffness if it is not.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace pounding {

/// Sparse factors L D L^T of K, scaled to a unit diagonal so that forces and moments have equal weight.
class StaticSolver {
 public:
  /// K is symmetric, n x n; n may be 0.
  explicit StaticSolver(const Eigen::SparseMatrix<double>& stiffness);

  /// True if the smallest eigenvalue of the scaled K is above its round-off, 2e-14. (For a cantilever divided into 500
  /// beams it is 8e-12.)
  bool holds() const { return mode_.size() == 0; }
  /// True if holds() is false and the eigenvalue is negative.
  bool buckles() const { return buckles_; }
  /// Displacements with zero or negative stiffness, length n; empty if holds() is true.
  const Eigen::VectorXd& mode() const { return mode_; }
  /// Requires holds(). n x k. If the smallest eigenvalue is so close to round-off that K was factorized with a shift,
  /// the first call factorizes K again.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& forces);

 private:
  // From the factors of the scaled K: the mode of the smallest eigenvalue, and whether all pivots are positive.
  struct Motion {
    Eigen::VectorXd shape;
    double eigenvalue = 0;
    bool positive = false;
  };
  Motion weakest_motion() const;

  Eigen::SparseMatrix<double> scaled_;
  Eigen::VectorXd scale_;  // K = S^-1 scaled S^-1
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  Eigen::VectorXd mode_;
  bool buckles_ = false, shifted_ = false;
};

}  // namespace pounding
