#pragma once
/// Static equilibrium under gravity of a structure whose laws are nonlinear before yield.

#include <Eigen/Core>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// Displacement under gravity in addition to that of the elastic stiffness [m], [rad]: q with
///
///     K q + B F = 0,   F = phi(d0 + B^T q - R F),
///
/// for monotonic loading of the parts from zero to their deformations; devices are inserted afterwards. Zero without
/// such parts, and then empty. Resets the parts to their initial state. Throws std::invalid_argument if no
/// equilibrium is found.
Eigen::VectorXd rest_by_yielding(const Structure& structure);

}  // namespace pounding
