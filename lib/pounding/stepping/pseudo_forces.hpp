#pragma once
/// Elastic forces beyond K u as forces on the linear system.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <memory>
#include <span>
#include <vector>

#include <pounding/model/system.hpp>

namespace pounding {

/// Steps use the stiffness at rest, where massless degrees of freedom (s) depend linearly on those with mass (m):
/// u_s = -K_ss^-1 K_sm u_m. Their exact position u' is the static equilibrium f_s(u_m, u_s) = 0. With u linear and u'
/// exact
///
///   e = f_m(u') - (K u)_m,   E = energy(u') - u.K u/2,   e = dE/du_m.
///
/// So e has no part at massless degrees of freedom, and the equations of motion hold for the others as they stand, with
/// e as one more force. Where f_s = 0 has several solutions, u' is the one that Newton's method finds from u.
class PseudoForces {
 public:
  /// `system` must outlive it. Throws std::invalid_argument where the stiffness leaves a massless degree of freedom
  /// loose.
  explicit PseudoForces(const System& system);
  ~PseudoForces();

  /// Whether any group has elastic forces beyond K u.
  bool any() const { return !parts_.empty(); }
  /// e at u for these groups, zero for the others; both for all degrees of freedom [N], [m]. NaN in a group whose
  /// massless degrees of freedom find no equilibrium.
  void evaluate(std::span<const int> groups, const Eigen::VectorXd& u, Eigen::VectorXd& e) const;
  /// E of all groups [J].
  double energy(const Eigen::VectorXd& u) const;

  /// Whether a row of this matrix that is not empty belongs to a degree of freedom that complete() changes.
  bool corrects(const SparseMatrix& of_unknowns) const;
  /// Sets displacements, velocities and accelerations of massless degrees of freedom from the others: static
  /// equilibrium and its derivatives in time.
  void complete(Eigen::VectorXd& u) const;
  void complete(Eigen::VectorXd& u, Eigen::VectorXd& v) const;
  void complete(Eigen::VectorXd& u, Eigen::VectorXd& v, Eigen::VectorXd& a) const;

 private:
  struct Part;

  std::vector<std::unique_ptr<Part>> parts_;
};

}  // namespace pounding
