#pragma once
/// Springs that give way to their own forces at once: forces for a given motion, and rates of deformations.

#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>
#include <span>
#include <vector>

#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/links/link_solver.hpp>

namespace pounding {

/// S of these springs [position, position]; zero at positions of negative numbers.
Eigen::MatrixXd relief_among(const SparseMatrix& flexibility, std::span<const int> springs);

/// The deformation is d = B^T u - S F + c and the force that of the law, F = phi(d). With the slopes phi' of the laws
/// the rate of d is (I + S phi')^-1 B^T v, the derivative of this. Slopes jump at the corners of a law, where steps
/// end; those of the middle of a step hold all through it.
class SpringForces {
 public:
  /// `links` must outlive it.
  explicit SpringForces(const LinkSet& links) : links_(links), any_(links.relief().any()), solver_(links) {}

  /// Whether any spring gives way; without, the functions below need not be called.
  bool any() const { return any_; }

  /// Forces of all links [N] for `motions`, those of springs without relief; they become those with it. `force` is a
  /// guess. Forces of links that are no springs stay. False where the laws find no equilibrium.
  bool settle(std::vector<LinkMotion>& motions, Eigen::VectorXd& force) const;

  /// S F.
  void relieve(Instant& x) const;

  /// Slopes of all springs at these motions [N/m].
  void slopes(const std::vector<LinkMotion>& motions, Eigen::VectorXd& slopes) const;
  /// Replaces columns of B^T v by rates of deformations, one row a spring.
  void rates(const Eigen::VectorXd& slopes, Eigen::MatrixXd& of_springs) const;
  /// Instant::force_rates of an instant with its motion and its slopes.
  void find_force_rates(Instant& x) const;
  /// Rates in a trial, and its slopes, from its middle.
  void find_rates(const Instant& begin, Trial& trial) const;

  /// Motions of all springs at both ends of a trial as if each law kept the slope that it has where the step begins: up
  /// to the first corner of any force the cubic through them is that of the trial.
  void follow_first_slopes(const Instant& begin, const Trial& trial, std::vector<LinkMotion>& first,
                           std::vector<LinkMotion>& last) const;

 private:
  bool solve(const std::vector<LinkMotion>& motions, Eigen::VectorXd& force) const;
  void set_no_flexibility(Eigen::Index count) const;
  bool answer_by_structure(const Eigen::VectorXd& slopes, Eigen::MatrixXd& rates) const;

  const LinkSet& links_;
  const bool any_;
  mutable LinkSolver solver_;
  // Room to work in.
  mutable Eigen::VectorXd relief_, none_;
  mutable Eigen::MatrixXd flexibility_, zero_;
  mutable Eigen::MatrixXd right_, solved_;
  mutable Eigen::VectorXd change_;
  mutable std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> lu_;
  mutable SoftSprings soft_springs_;
  mutable std::vector<int> soft_;    // springs
  mutable std::vector<int> active_;  // links
  mutable std::vector<LinkMotion> free_;
};

}  // namespace pounding
