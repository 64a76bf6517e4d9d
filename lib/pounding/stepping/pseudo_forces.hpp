#pragma once
/// What the elastic forces of a system have beyond K u.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <memory>
#include <span>
#include <vector>

#include <pounding/model/system.hpp>

namespace pounding {

/// The steps are made with the stiffness at rest, and in them the unknowns without mass follow the others linearly:
/// u_s = -K_ss^-1 K_sm u_m. In truth they stand where no force is left on them, f_s(u_m, u_s) = 0. With u linear and u' true
///
///   e = f_m(u') - (K u)_m,   E = energy(u') - u.K u/2,   e = dE/du_m,
///
/// so that e has no part at the unknowns without mass and the equations of motion hold for those with mass as they stand,
/// with e as one more force. Of the branches of u' it is the one that Newton's method finds from u.
class PseudoForces {
 public:
  /// `system` must outlive it. Throws std::invalid_argument where the stiffness leaves an unknown without mass loose.
  explicit PseudoForces(const System& system);
  ~PseudoForces();

  /// Whether any group has forces of its own.
  bool any() const { return !parts_.empty(); }
  /// e (n) at u (n) of these groups, zero at the others; not a number where the unknowns without mass find no equilibrium.
  void evaluate(std::span<const int> groups, const Eigen::VectorXd& u, Eigen::VectorXd& e) const;
  /// E of all groups.
  double energy(const Eigen::VectorXd& u) const;

  /// Whether rows of this matrix that are not empty belong to unknowns that `complete` moves.
  bool corrects(const SparseMatrix& of_unknowns) const;
  /// Sets the unknowns without mass to where they stand, how they move, and how that changes; from the others.
  void complete(Eigen::VectorXd& u) const;
  void complete(Eigen::VectorXd& u, Eigen::VectorXd& v) const;
  void complete(Eigen::VectorXd& u, Eigen::VectorXd& v, Eigen::VectorXd& a) const;

 private:
  struct Part;

  std::vector<std::unique_ptr<Part>> parts_;
};

}  // namespace pounding
