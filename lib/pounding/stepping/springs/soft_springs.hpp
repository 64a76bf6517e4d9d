#pragma once
/// Newton's step for the forces of springs, of which some yield.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace pounding {

struct CondensedLinks;

/// Springs that are softer than their linear stiffness by D > 0 solve (D^-1 - (c G + S)) dF = D^-1 r, scaled by the
/// roots of D; all others take their residual r. The matrix is positive definite exactly where the tangent stiffness of
/// the step is.
class SoftSprings {
 public:
  /// `slopes` of all active links, none of them positive [N/m]; `residual` r [N] becomes the step `direction` [N].
  /// False where the structure is unstable.
  bool solve(const CondensedLinks& links, const Eigen::VectorXd& slopes, const Eigen::VectorXd& residual,
             Eigen::VectorXd& direction);

  /// As solve(), beside links that are no such springs, `others`, whose equations are rows of `matrix` [link, link]:
  /// the springs of one structure after another are eliminated. Springs of different structures meet in the others
  /// alone.
  bool solve_beside(const CondensedLinks& links, const std::vector<int>& others, const Eigen::MatrixXd& matrix,
                    const Eigen::VectorXd& slopes, const Eigen::VectorXd& residual, Eigen::VectorXd& direction);

  /// Forces that the springs, all of which yield with these slopes, answer with to deformations or their rates without
  /// these forces [spring, column]: of the unknowns without mass alone where links.by_u is 0. They take the place of
  /// the deformations.
  bool answer(const CondensedLinks& links, const Eigen::VectorXd& slopes, Eigen::MatrixXd& deformations);

  /// Fewer springs that yield are solved for with all other links at once, and those of all structures together.
  static constexpr int min_by_structure = 16;

 private:
  bool solve_blocks(const CondensedLinks& links, Eigen::Ref<Eigen::MatrixXd> right);
  void choose(const Eigen::VectorXd& slopes);
  // by_u G + S, and what forces take off all deformations by it.
  static double flexibility(const CondensedLinks& links, int i, int j);
  void find_by_others(const CondensedLinks& links, const Eigen::VectorXd& forces);
  bool factorize(const CondensedLinks& links, Eigen::Index first, Eigen::Index count);
  Eigen::Index block_from(const CondensedLinks& links, Eigen::Index first) const;

  // Room to work in.
  std::vector<int> soft_;
  Eigen::VectorXd root_, by_others_, relief_, right_;
  Eigen::MatrixXd matrix_, by_links_;
  std::optional<Eigen::LLT<Eigen::MatrixXd>> factor_;
};

}  // namespace pounding
