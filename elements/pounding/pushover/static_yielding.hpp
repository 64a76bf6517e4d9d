#pragma once
/// A structure with parts that yield, at rest under a load of one pattern.

#include <Eigen/Core>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// Equilibrium K u + B F = factor p with the deformations d = B^T u - R F + d0 of the yielding parts, their forces F on
/// top of K, and a displacement c^T u that is given instead of the factor. The unknowns are condensed out by static
/// solves, one a part and one for the load:
///
///     d = d0 + displacement g - H F,     factor = (displacement + z^T F)/cp
///
/// with a = K^-1 p, Z = K^-1 B, cp = c^T a, z = Z^T c, g = B^T a/cp, H = B^T Z + R - g z^T. What the load does is exact
/// for any law.
class StaticYielding {
 public:
  /// `load` p has one value an unknown, `control` c and the rows of `follow` are displacements in their terms. Throws
  /// std::invalid_argument where K does not hold the structure, and where the load does not move the displacement its
  /// own way.
  StaticYielding(const Structure& structure, const Eigen::VectorXd& load, const Row& control,
                 const Eigen::MatrixXd& follow = {});

  int parts() const noexcept { return static_cast<int>(at_rest_.size()); }
  /// d0 [m] or [rad].
  const Eigen::VectorXd& at_rest() const noexcept { return at_rest_; }
  /// g: deformations by a unit displacement without yielding.
  const Eigen::VectorXd& by_displacement() const noexcept { return by_displacement_; }
  /// H: by how much unit forces of the parts shorten the deformations while the displacement stays.
  const Eigen::MatrixXd& flexibility() const noexcept { return flexibility_; }

  /// d, with the forces F of the parts.
  Eigen::VectorXd deformations(double displacement, const Eigen::VectorXd& forces) const;
  /// The factor of the load. It is linear in both, and so gives rates of rates.
  double factor(double displacement, const Eigen::VectorXd& forces) const;
  /// The displacements that are followed.
  Eigen::VectorXd followed(double displacement, const Eigen::VectorXd& forces) const;

 private:
  double by_load_ = 0;                                // cp
  Eigen::VectorXd at_rest_, by_displacement_, held_;  // held_: z
  Eigen::MatrixXd flexibility_;
  Eigen::VectorXd followed_by_load_;
  Eigen::MatrixXd followed_by_parts_;
};

}  // namespace pounding
