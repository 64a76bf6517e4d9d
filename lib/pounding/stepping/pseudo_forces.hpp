#pragma once
/// Nonlinear elastic forces beyond K u, as forces on the linear system.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <memory>
#include <span>
#include <vector>

#include <pounding/model/system.hpp>

namespace pounding {

/// Steps use the tangent stiffness at rest, where massless degrees of freedom (s) depend linearly on those with mass
/// (m): u_s = -K_ss^-1 K_sm u_m. The exact solution u' satisfies static equilibrium f_s(u_m, u_s) = 0. With the linear
/// u and the exact u',
///
///   e = f_m(u') - (K u)_m,   E = energy(u') - u.K u/2,   e = dE/du_m.
///
/// Therefore e is zero at massless degrees of freedom, and the equations of motion of all others are unchanged except
/// for the additional force e. If f_s = 0 has several solutions, u' is the one that Newton's method finds from u.
class PseudoForces {
 public:
  /// `system` must outlive this object. Throws std::invalid_argument if a massless degree of freedom has no stiffness.
  explicit PseudoForces(const System& system);
  ~PseudoForces();

  /// True if any group has elastic forces beyond K u.
  bool any() const { return !parts_.empty(); }
  /// Sets e at u for these groups and zero for the others; both have all degrees of freedom [N], [m]. NaN in a group if
  /// its massless degrees of freedom have no equilibrium.
  void evaluate(std::span<const int> groups, const Eigen::VectorXd& u, Eigen::VectorXd& e) const;
  /// E of all groups [J].
  double energy(const Eigen::VectorXd& u) const;

  /// True if a nonempty row of this matrix belongs to a degree of freedom that complete() changes.
  bool corrects(const SparseMatrix& of_unknowns) const;
  /// Computes displacements, velocities and accelerations of massless degrees of freedom from the others: static
  /// equilibrium and its time derivatives.
  void complete(Eigen::VectorXd& u) const;
  void complete(Eigen::VectorXd& u, Eigen::VectorXd& v) const;
  void complete(Eigen::VectorXd& u, Eigen::VectorXd& v, Eigen::VectorXd& a) const;

 private:
  struct Part;

  std::vector<std::unique_ptr<Part>> parts_;
};

}  // namespace pounding
