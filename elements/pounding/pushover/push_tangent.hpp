#pragma once
/// Tangent of an equilibrium path.

#include <Eigen/Core>
#include <vector>

#include <pounding/pushover/static_yielding.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// Rates per unit of the controlled displacement.
struct PushTangent {
  bool exists = false;
  Eigen::VectorXd slopes;  ///< of the forces in addition to k d, on the side towards which each part moves
  Eigen::VectorXd rates;   ///< of the deformations
  double load_rate = 0;    ///< of the load factor
};

/// Minimum significant change of the deformation of a part: closer corners are merged.
double deformation_scale(const Spring& spring, double deformation);

/// Rates of the deformations for these slopes of the forces; does not exist if the slopes admit a mechanism.
PushTangent rates_of(const StaticYielding& statics, const Eigen::VectorXd& scales, Eigen::VectorXd slopes, double way);

/// Tangent at accepted deformations, for an increasing (way 1) or decreasing (-1) displacement. A slope depends on the
/// direction of its part, which depends on all slopes. The directions are found by trial: first all wrong ones are
/// changed together, then one at a time.
PushTangent tangent_at(const StaticYielding& statics, const std::vector<LoadedSpring>& springs,
                       const Eigen::VectorXd& deformations, double way);

}  // namespace pounding
