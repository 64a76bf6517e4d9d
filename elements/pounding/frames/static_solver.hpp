#pragma once
/// K q = f for a stiffness that must be positive, and what gives way where it is not.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace pounding {

/// Sparse factors L D L^T of K, scaled to a unit diagonal so that forces and moments weigh alike.
class StaticSolver {
 public:
  /// K is symmetric, n x n; n may be 0.
  explicit StaticSolver(const Eigen::SparseMatrix<double>& stiffness);

  /// The smallest eigenvalue of the scaled K is above its rounding, 2e-14. (A cantilever divided into 500 beams has
  /// 8e-12.)
  bool holds() const { return mode_.size() == 0; }
  /// It does not, and the eigenvalue is negative.
  bool buckles() const { return buckles_; }
  /// Displacements that meet no stiffness or a negative one, length n; empty where K holds.
  const Eigen::VectorXd& mode() const { return mode_; }
  /// For a K that holds. n x k. Where the smallest eigenvalue is so near to its rounding that only a shifted K told it,
  /// the first call factors K once more.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& forces);

 private:
  // By the factors of the scaled K: the motion of the smallest eigenvalue, and whether all pivots are positive.
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
