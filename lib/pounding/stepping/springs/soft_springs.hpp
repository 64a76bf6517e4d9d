#pragma once
/// Newton step for the forces of springs, some of which yield.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace pounding {

struct CondensedLinks;

/// Springs whose stiffness is reduced by D > 0 solve (D^-1 - (c G + S)) dF = D^-1 r, scaled by the roots of D; all
/// others take their residual r. The matrix is positive definite if and only if the tangent stiffness of the step is.
class SoftSprings {
 public:
  /// `slopes` of all active links, none positive [N/m]. Replaces the residual r [N] by the step `direction` [N]. False
  /// if the structure is unstable.
  bool solve(const CondensedLinks& links, const Eigen::VectorXd& slopes, const Eigen::VectorXd& residual,
             Eigen::VectorXd& direction);

  /// As solve(), together with other links, `others`, whose equations are rows of `matrix` [link, link]. The springs
  /// are eliminated structure by structure; springs of different structures interact only through the others.
  bool solve_beside(const CondensedLinks& links, const std::vector<int>& others, const Eigen::MatrixXd& matrix,
                    const Eigen::VectorXd& slopes, const Eigen::VectorXd& residual, Eigen::VectorXd& direction);

  /// Replaces deformations, or their rates, without spring forces by the resulting forces [spring, column] of springs
  /// that all yield with these slopes. If links.by_u is 0, only the massless degrees of freedom respond.
  bool answer(const CondensedLinks& links, const Eigen::VectorXd& slopes, Eigen::MatrixXd& deformations);

  /// With fewer yielding springs, these are solved together with all other links, and the springs of all structures
  /// together.
  static constexpr int min_by_structure = 16;

 private:
  bool solve_blocks(const CondensedLinks& links, Eigen::Ref<Eigen::MatrixXd> right);
  void choose(const Eigen::VectorXd& slopes);
  // by_u G + S, and the reduction of all deformations by the forces through it.
  static double flexibility(const CondensedLinks& links, int i, int j);
  void find_by_others(const CondensedLinks& links, const Eigen::VectorXd& forces);
  bool factorize(const CondensedLinks& links, Eigen::Index first, Eigen::Index count);
  Eigen::Index block_from(const CondensedLinks& links, Eigen::Index first) const;

  // Workspace.
  std::vector<int> soft_;
  Eigen::VectorXd root_, by_others_, relief_, right_;
  Eigen::MatrixXd matrix_, by_links_;
  std::optional<Eigen::LLT<Eigen::MatrixXd>> factor_;
};

}  // namespace pounding
