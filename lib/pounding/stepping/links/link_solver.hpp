#pragma once
/// Solves the few nonlinear equations for the link forces of one stage, after static condensation of the structures.

#include <Eigen/Core>
#include <span>
#include <vector>

#include <pounding/links/friction.hpp>
#include <pounding/stepping/links/link_blocks.hpp>
#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/springs/soft_springs.hpp>

namespace pounding {

/// Active links of one stage, independent of structural matrices and time. With the forces F [N],
///
///   penetration = free.penetration - (weight by_u G + S) F,     rate = free.rate - weight by_v G F,
///   closing acceleration = free_acceleration - weight G F.
struct CondensedLinks {
  std::span<const int> active;               ///< links whose force is unknown, in ascending order
  std::span<const LinkMotion> free;          ///< their motion without these forces
  const Eigen::VectorXd& free_acceleration;  ///< their closing acceleration without these forces, B^T x0 [m/s^2]
  const Eigen::MatrixXd& flexibility;        ///< G = B^T A^-1 B
  double by_u = 0, by_v = 0;  ///< displacement [s^2] and velocity [s] for a unit acceleration of the stage
  double weight = 1;          ///< weight of forces in the equations of the stage
  const Eigen::MatrixXd* relief = nullptr;  ///< S, static compliance of massless degrees of freedom; null if none
  const LinkBlocks* blocks = nullptr;       ///< of G; null if G is dense
};

/// Finds the forces that satisfy the laws at the motion they cause. A held contact takes the force that makes its
/// closing acceleration zero.
///
/// For springs with slopes -D, D > 0, a Newton step is (1/D - H) dF = ..., H = weight by_u G + S. By Woodbury's
/// formula, this matrix is positive definite if and only if the tangent of the step is: a Cholesky factor exists, or
/// the structure is unstable.
class LinkSolver {
 public:
  /// `links` must outlive this object.
  explicit LinkSolver(const LinkSet& links) : links_(links) {}

  /// Newton's method with exact slopes and a line search on the residual, then on the potential; as a fallback,
  /// Gauss-Seidel with bracketed scalar solves. `force` is the initial guess and becomes the solution, one entry per
  /// active link. Returns false if no method converges.
  bool solve(const CondensedLinks& links, Eigen::VectorXd& force);
  /// Link at which the last failed solve stopped; -1 if unknown.
  int failed_link() const { return failed_; }
  long iterations() const { return iterations_; }
  void archive(Archive& archive) { archive(iterations_); }

 private:
  // An active friction element; indices among the active links.
  struct Slider {
    const Friction* friction = nullptr;
    int contact = 0, first = 0;
  };
  // An active element with several deformations, and its response in the last residual().
  struct Coupled {
    const CoupledElement* element = nullptr;
    int first = 0;
    ElementResponse response{};
  };

  bool solve_one(const CondensedLinks& links, int k, double others, double others_relief, double& force);
  bool solve_many(const CondensedLinks& links, Eigen::VectorXd& force);
  double residual(const CondensedLinks& links, const Eigen::VectorXd& force, bool with_slopes);
  double rounding(const CondensedLinks& links, const Eigen::VectorXd& force);
  bool is_symmetric(const CondensedLinks& links) const;
  void find_slopes(const CondensedLinks& links);
  bool find_direction_by_cholesky(const CondensedLinks& links);
  bool eliminates_springs(const CondensedLinks& links);
  bool descend(const CondensedLinks& links, Eigen::VectorXd& force);
  bool sweep(const CondensedLinks& links, Eigen::VectorXd& force);
  void find_blocks(const CondensedLinks& links);
  ElementResponse deform(const CondensedLinks& links, const Coupled& coupled, const Eigen::VectorXd& relief,
                         const Eigen::VectorXd& at_once) const;
  void find_rows(const CondensedLinks& links, const Coupled& coupled);
  // Solves the directions of a slider or coupled element in turn by bisection, with all other forces fixed.
  // `force_of`: force of a direction from G F and S F.
  template <class ForceOf>
  bool solve_block(const CondensedLinks& links, int first, int count, Eigen::VectorXd& forces, ForceOf&& force_of);
  FrictionForce slide(const CondensedLinks& links, const Slider& slider, const Eigen::VectorXd& relief) const;

  const LinkSet& links_;
  int failed_ = -1;
  long iterations_ = 0;
  // Workspace of the current solve_many().
  std::vector<Slider> sliders_;
  std::vector<Coupled> coupled_;
  std::vector<int> scalars_;                            // active links whose force depends on their own motion only
  double terms_ = 0;                                    // magnitude of the terms of the last residual [N]
  Eigen::VectorXd residual_, relief_, relief_at_once_;  // the last two: G F and S F
  Eigen::VectorXd sizes_;                               // |G| |F|
  Eigen::VectorXd by_penetration_, by_rate_;            // slopes of the laws
  Eigen::MatrixXd slopes_;
  Eigen::VectorXd trial_, direction_;
  SoftSprings soft_springs_;
  std::vector<int> others_;  // active links other than softening springs
  Eigen::VectorXd slopes_of_springs_;
  BlockFactors factors_;  // used instead of slopes_ for many contacts and springs; R holds the roots of the slopes
};

}  // namespace pounding
