#pragma once
/// Structure with yielding parts, at rest under a load of constant pattern.

#include <Eigen/Core>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// Equilibrium K u + B F = factor p with the deformations d = B^T u - R F + d0 of the yielding parts, their forces F in
/// addition to K, and a prescribed displacement c^T u instead of the factor. The unknowns are condensed by static
/// solves, one per part and one for the load:
///
///     d = d0 + displacement g - H F,     factor = (displacement + z^T F)/cp
///
/// with a = K^-1 p, Z = K^-1 B, cp = c^T a, z = Z^T c, g = B^T a/cp, H = B^T Z + R - g z^T. The condensation is exact
/// for any law.
class StaticYielding {
 public:
  /// `load` p has one value per unknown, `control` c and the rows of `follow` are displacements in terms of the
  /// unknowns. Throws std::invalid_argument if K is singular, and if the load does not move the displacement in its
  /// positive direction.
  StaticYielding(const Structure& structure, const Eigen::VectorXd& load, const Row& control,
                 const Eigen::MatrixXd& follow = {});

  int parts() const noexcept { return static_cast<int>(at_rest_.size()); }
  /// d0 [m] or [rad].
  const Eigen::VectorXd& at_rest() const noexcept { return at_rest_; }
  /// g: deformations per unit displacement without yielding.
  const Eigen::VectorXd& by_displacement() const noexcept { return by_displacement_; }
  /// H: reduction of the deformations by unit forces of the parts at constant displacement.
  const Eigen::MatrixXd& flexibility() const noexcept { return flexibility_; }

  /// d, with the forces F of the parts.
  Eigen::VectorXd deformations(double displacement, const Eigen::VectorXd& forces) const;
  /// Load factor. It is linear in both arguments, so it also maps rates to rates.
  double factor(double displacement, const Eigen::VectorXd& forces) const;
  /// Recorded displacements.
  Eigen::VectorXd followed(double displacement, const Eigen::VectorXd& forces) const;

 private:
  double by_load_ = 0;                                // cp
  Eigen::VectorXd at_rest_, by_displacement_, held_;  // held_: z
  Eigen::MatrixXd flexibility_;
  Eigen::VectorXd followed_by_load_;
  Eigen::MatrixXd followed_by_parts_;
};

}  // namespace pounding
