#pragma once
/// State of a model at the start.

#include <Eigen/Core>
#include <vector>

#include <pounding/model/model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Displacements of all unknowns when forces hold the floors at these displacements along x, one a floor from the
/// ground up [m], and nothing else acts: K q = the forces. Relative to the state at rest. Throws std::invalid_argument
/// for a frame without floors, for a floor that moves as a node without mass does, and for a frame that nothing holds.
Eigen::VectorXd shape_of_floors(const Structure& frame, const std::vector<double>& displacements);

/// Shape by displacements of nodes. Throws std::invalid_argument, too, for a node or a displacement that is not there,
/// is held or has no mass, and for two that are the same unknown.
Eigen::VectorXd shape_of_nodes(const Structure& frame, const std::vector<NodeDisplacement>& displacements);

/// Static equilibrium of the structures under the contacts that are preloaded, which is where the run begins. A link
/// with a gap of -p presses by p where its structures are undeformed; they give way until the forces balance:
///
///     K u + B F(p + B^T u) = 0,
///
/// with the law's force F of a first slow loading. Sets the structures' preload_displacement and presses the contacts.
/// Throws ModelError for a structure that nothing holds, that starts displaced, yields, or has elastic forces beyond K
/// u, for a law that has no force at rest, and where a preloaded link would start open or another one closed.
void press_preloaded(std::vector<Structure>& structures, std::vector<Link>& links);

/// How far a structure gives way under gravity beyond what its elastic stiffness says [m], [rad]: q with
///
///     K q + B F = 0,   F = phi(d0 + B^T q - R F),
///
/// where the loads bring the parts straight from nothing to their deformations; devices are put in afterwards. Zero
/// without such parts, and then empty. Puts the parts back to where they were made. Throws std::invalid_argument where
/// the laws find no equilibrium.
Eigen::VectorXd rest_by_yielding(const Structure& structure);

}  // namespace pounding
