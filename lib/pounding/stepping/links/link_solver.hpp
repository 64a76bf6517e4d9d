#pragma once
/// The few nonlinear equations for the link forces of one stage, left over when the structures are condensed out.

#include <Eigen/Core>
#include <span>
#include <vector>

#include <pounding/links/friction.hpp>
#include <pounding/stepping/links/link_blocks.hpp>
#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/springs/soft_springs.hpp>

namespace pounding {

/// The active links of one stage. Knows neither matrices of structures nor time: with the forces F [N],
///
///   penetration = free.penetration - (weight by_u G + S) F,     rate = free.rate - weight by_v G F,
///   closing acceleration = free_acceleration - weight G F.
struct CondensedLinks {
  std::span<const int> active;               ///< links whose force is sought, in ascending order
  std::span<const LinkMotion> free;          ///< their motion without these forces
  const Eigen::VectorXd& free_acceleration;  ///< and their closing acceleration, B^T x0 [m/s^2]
  const Eigen::MatrixXd& flexibility;        ///< G = B^T A^-1 B
  double by_u = 0, by_v = 0;  ///< displacement [s^2] and velocity [s] for a unit acceleration of the stage
  double weight = 1;          ///< weight of forces in the equations of the stage
  const Eigen::MatrixXd* relief = nullptr;  ///< S, how far unknowns without mass give way at once; none without it
  const LinkBlocks* blocks = nullptr;       ///< of G; none: every number of it counts
};

/// Finds forces that are those of their laws at the motion that they leave. A held contact takes the force that leaves
/// no closing acceleration.
///
/// With the slopes -D of springs alone, each where D > 0, a Newton step is (1/D - H) dF = ..., H = weight by_u G + S.
/// This matrix is positive definite where the tangent of the step is, by Woodbury's formula: it has a Cholesky factor,
/// or the structure is unstable.
class LinkSolver {
 public:
  /// `links` must outlive it.
  explicit LinkSolver(const LinkSet& links) : links_(links) {}

  /// Newton's method with exact slopes, its steps shortened by the residuals, else by their potential, else
  /// Gauss-Seidel with bracketed scalar solves. `force` is a guess and becomes the solution, one entry an active link.
  /// False if none converges.
  bool solve(const CondensedLinks& links, Eigen::VectorXd& force);
  /// The link that the last failed solve gave up at; -1 if it could not tell.
  int failed_link() const { return failed_; }
  long iterations() const { return iterations_; }
  void archive(Archive& archive) { archive(iterations_); }

 private:
  // An active friction; positions among the active links.
  struct Slider {
    const Friction* friction = nullptr;
    int contact = 0, first = 0;
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
  void find_sliders(const CondensedLinks& links);
  FrictionForce slide(const CondensedLinks& links, const Slider& slider, const Eigen::VectorXd& relief) const;
  bool solve_slider(const CondensedLinks& links, const Slider& slider, Eigen::VectorXd& forces);

  const LinkSet& links_;
  int failed_ = -1;
  long iterations_ = 0;
  // Work of the present solve_many().
  std::vector<Slider> sliders_;
  int plain_ = 0;                                       // active links before the first direction of a friction
  double terms_ = 0;                                    // size of the terms of the last residual [N]
  Eigen::VectorXd residual_, relief_, relief_at_once_;  // the last two: G F and S F
  Eigen::VectorXd sizes_;                               // |G| |F|
  Eigen::VectorXd by_penetration_, by_rate_;            // slopes of the laws
  Eigen::MatrixXd slopes_;
  Eigen::VectorXd trial_, direction_;
  SoftSprings soft_springs_;
  std::vector<int> others_;  // active links that are no springs which only soften
  Eigen::VectorXd slopes_of_springs_;
  BlockFactors
      factors_;  // many contacts and springs alone: with R, the roots of the slopes, they take the place of slopes_
};

}  // namespace pounding
