#pragma once
/// The elastic forces of a structure that turns: not proportional to its displacements.

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace pounding {

/// Forces that follow from the displacements u of the unknowns without any memory, as the gradient of an energy. u
/// counts from the state at rest: there energy and force are exactly zero, what acts at rest included, and the tangent
/// is the stiffness K of the structure. Every function is pure.
class ElasticForces {
 public:
  virtual ~ElasticForces() = default;

  /// Displacements at the reference state [m]; round-off of the forces scales with at_rest() + u.
  virtual const Eigen::VectorXd& at_rest() const = 0;
  virtual double energy(const Eigen::VectorXd& u) const = 0;          ///< [J]
  virtual Eigen::VectorXd force(const Eigen::VectorXd& u) const = 0;  ///< [N], [N m]
  /// Symmetric and compressed, its entries always at the same places.
  virtual Eigen::SparseMatrix<double> tangent(const Eigen::VectorXd& u) const = 0;
};

}  // namespace pounding
