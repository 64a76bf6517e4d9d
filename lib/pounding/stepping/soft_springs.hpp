#pragma once
/// Newton's step for the forces of springs alone, of which some yield.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace pounding {

struct CondensedLinks;

/// Springs that are softer than their linear stiffness by D > 0 solve (D^-1 - (c G + S)) dF = D^-1 r, scaled by the roots of D; all others
/// take their residual r. The matrix is positive definite exactly where the tangent stiffness of the step is.
class SoftSprings {
 public:
  /// `slopes` of all active links, none of them positive [N/m]; `residual` r [N] becomes the step `direction` [N]. False where the structure
  /// is unstable.
  bool solve(const CondensedLinks& links, const Eigen::VectorXd& slopes, const Eigen::VectorXd& residual, Eigen::VectorXd& direction);

 private:
  // Room to work in.
  std::vector<int> soft_;
  Eigen::VectorXd root_, by_others_, relief_, right_;
  Eigen::MatrixXd matrix_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace pounding
