#pragma once
/// Springs with relief: forces at a given motion, and rates of deformation.

#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>
#include <span>
#include <vector>

#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/links/link_solver.hpp>

namespace pounding {

/// S among these springs [index, index]; zero for negative indices.
Eigen::MatrixXd relief_among(const SparseMatrix& flexibility, std::span<const int> springs);

/// The deformation is d = B^T u - S F + c and the force satisfies the law, F = phi(d). With the slopes phi' of the
/// laws, the rate of d is (I + S phi')^-1 B^T v. Slopes jump at the corners of a law, where steps end; the slopes at
/// mid-step apply to the whole step. phi' is diagonal, with a block for each coupled element: row by row, the slopes by
/// the deformations of the element.
class SpringForces {
 public:
  /// `links` must outlive this object.
  explicit SpringForces(const LinkSet& links);

  /// True if any spring has relief; otherwise the functions below need not be called.
  bool any() const { return any_; }
  /// Columns of the slopes: the largest number of deformations of an element.
  int width() const { return width_; }

  /// Solves for the spring forces [N]. `motions` are those without relief and become those with relief. `force` has one
  /// entry per link: an initial guess for springs, unchanged for other links. False if the laws have no equilibrium.
  bool settle(std::vector<LinkMotion>& motions, Eigen::VectorXd& force);

  /// Sets the relief S F.
  void relieve(Instant& x) const;

  /// Slopes of all springs at these motions, the first of which belongs to link `from` [N/m].
  void slopes(std::span<const LinkMotion> motions, int from, Eigen::MatrixXd& slopes) const;
  /// phi' times rates of deformation, one row per spring.
  Eigen::MatrixXd force_rates(const Eigen::MatrixXd& slopes, const Eigen::MatrixXd& of_springs) const;
  /// Replaces the columns of B^T v by rates of deformation, one row per spring.
  void rates(const Eigen::MatrixXd& slopes, Eigen::MatrixXd& of_springs);
  /// Sets Instant::force_rates from the motion and the slopes of an instant.
  void find_force_rates(Instant& x);
  /// Sets the rates and slopes of a trial from its middle.
  void find_rates(const Instant& begin, Trial& trial);

  /// Motions of all springs at both ends of a trial as if each law kept its slope at the beginning of the step. Up to
  /// the first corner of any spring force, the cubic through them equals that of the trial.
  void follow_first_slopes(const Instant& begin, const Trial& trial, std::vector<LinkMotion>& first,
                           std::vector<LinkMotion>& last);

 private:
  bool solve(const std::vector<LinkMotion>& motions, Eigen::VectorXd& force);
  void set_no_flexibility(Eigen::Index count);
  void rates_of_coupled(const Eigen::MatrixXd& slopes, Eigen::MatrixXd& of_springs);
  bool answer_by_structure(const Eigen::VectorXd& slopes, Eigen::MatrixXd& rates);

  const LinkSet& links_;
  const bool any_;
  int width_ = 1;
  LinkSolver solver_;
  // Workspace.
  Eigen::VectorXd relief_, none_;
  Eigen::MatrixXd flexibility_, zero_;
  Eigen::MatrixXd right_, solved_;
  Eigen::VectorXd change_;
  std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> lu_;
  SoftSprings soft_springs_;
  std::vector<int> soft_;    // springs
  std::vector<int> active_;  // links
  std::vector<LinkMotion> free_;
};

}  // namespace pounding
