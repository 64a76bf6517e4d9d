#pragma once
/// Initial state of a model.

#include <Eigen/Core>
#include <vector>

#include <pounding/model/model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Displacements of all degrees of freedom if forces hold the floors at the given displacements along x (one per floor,
/// from the ground up [m]) and no other loads act. Relative to the state at rest. Throws std::invalid_argument for a
/// frame without floors, a floor that moves with a massless node, and an unsupported frame. Includes the displacements
/// due to parts that yield on the way, see yielding_while_held().
Eigen::VectorXd shape_of_floors(const Structure& frame, const std::vector<double>& displacements);

/// The same for displacements of nodes. Also throws std::invalid_argument for an unknown node, for a displacement that
/// is fixed or massless, and for two displacements of one degree of freedom.
Eigen::VectorXd shape_of_nodes(const Structure& frame, const std::vector<NodeDisplacement>& displacements);

/// Static equilibrium of the structures under preloaded contacts: the initial state of the run. A link with a gap of -p
/// has the penetration p for undeformed structures; these deform until the forces balance:
///
///     K u + B F(p + B^T u) = 0,
///
/// with the force F of the law for a first slow loading. Sets preload_displacement of the structures and closes the
/// contacts. Throws ModelError for a structure that is unsupported, initially displaced, yields, or has elastic forces
/// other than K u, for a law without force at rest, and if a preloaded link would start open or another one closed.
void press_preloaded(std::vector<Structure>& structures, std::vector<Link>& links);

/// Displacements q of a structure under gravity due to yielding, in addition to its elastic response [m], [rad]:
///
///     K q + B F = 0,   F = phi(d0 + B^T q - R F),
///
/// where the loads deform the parts monotonically from zero; devices are installed afterwards. Empty without such
/// parts. Resets the parts to their initial state. Throws std::invalid_argument if the laws have no equilibrium.
Eigen::VectorXd rest_by_yielding(const Structure& structure);

/// Deformations of all parts under gravity [m], [rad]: d above; 0 for devices. Throws like rest_by_yielding().
Eigen::VectorXd deformations_at_rest(const Structure& structure);

/// Displacements of a structure due to yielding in addition to a given elastic shape u0, which forces hold at the
/// displacements `held` of the unknowns [m], [rad]:
///
///     K q + B F = H l,   H^T q = 0,   F = phi(d0 + B^T (u0 + q) - R F),
///
/// from the state under gravity; u0 and q are relative to it. Each part is loaded monotonically from there. Zero if no
/// part yields. Resets the parts to their initial state. Throws std::invalid_argument if the laws have no equilibrium.
Eigen::VectorXd yielding_while_held(const Structure& structure, const Eigen::VectorXd& elastic_shape,
                                    const std::vector<Row>& held);

}  // namespace pounding
