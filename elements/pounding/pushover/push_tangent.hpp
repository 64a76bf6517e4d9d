#pragma once
/// The direction in which a path of equilibrium goes on.

#include <Eigen/Core>
#include <vector>

#include <pounding/pushover/static_yielding.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// Rates by a unit way of the displacement that is followed.
struct PushTangent {
  bool exists = false;
  Eigen::VectorXd slopes;  ///< of the forces on top of k d, on the side to which each part goes
  Eigen::VectorXd rates;   ///< of the deformations
  double load_rate = 0;    ///< of the factor of the load
};

/// Smallest change of the deformation of a part that counts: corners that are nearer are one.
double deformation_scale(const Spring& spring, double deformation);

/// Rates of the deformations where the forces have these slopes; does not exist where these let the parts move by
/// themselves.
PushTangent rates_of(const StaticYielding& statics, const Eigen::VectorXd& scales, Eigen::VectorXd slopes, double way);

/// The tangent at deformations that are kept, for a displacement that grows (way 1) or falls (-1). A slope depends on
/// the side to which its part goes, and that on all slopes: the sides are found by trial, first all that are wrong at
/// once, then one at a time.
PushTangent tangent_at(const StaticYielding& statics, const std::vector<Spring*>& springs,
                       const Eigen::VectorXd& deformations, double way);

}  // namespace pounding
