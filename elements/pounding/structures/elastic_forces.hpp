#pragma once
/// Elastic forces of a structure with large rotations: not proportional to its displacements.

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace pounding {

/// Path-independent forces as the gradient of an energy of the displacements u, which are relative to the state at
/// rest. There energy and force are exactly zero, loads at rest included, and the tangent is the stiffness K of the
/// structure. All functions are pure.
class ElasticForces {
 public:
  virtual ~ElasticForces() = default;

  /// Displacements at the reference state [m]; round-off of the forces scales with at_rest() + u.
  virtual const Eigen::VectorXd& at_rest() const = 0;
  virtual double energy(const Eigen::VectorXd& u) const = 0;          ///< [J]
  virtual Eigen::VectorXd force(const Eigen::VectorXd& u) const = 0;  ///< [N], [N m]
  /// Symmetric and compressed, with a constant sparsity pattern.
  virtual Eigen::SparseMatrix<double> tangent(const Eigen::VectorXd& u) const = 0;
};

}  // namespace pounding
