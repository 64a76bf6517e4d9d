#pragma once
/// A structure at rest under gravity whose parts are not straight before they yield.

#include <Eigen/Core>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// How far a structure gives way under gravity beyond what its elastic stiffness says [m], [rad]: q with
///
///     K q + B F = 0,   F = phi(d0 + B^T q - R F),
///
/// where the loads bring the parts straight from nothing to their deformations; devices are put in afterwards. Zero
/// without such parts, and then empty. Puts the parts back to where they were made. Throws std::invalid_argument where
/// the laws find no equilibrium.
Eigen::VectorXd rest_by_yielding(const Structure& structure);

}  // namespace pounding
