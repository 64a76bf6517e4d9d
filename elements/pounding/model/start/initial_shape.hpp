#pragma once
/// Displacements of a frame at the start.

#include <Eigen/Core>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Displacements of all unknowns when forces hold the floors at these displacements along x, one a floor from the
/// ground up [m], and nothing else acts: K q = the forces. Relative to the state at rest. Throws std::invalid_argument
/// for a frame without floors, for a floor that moves as a node without mass does, and for a frame that nothing holds.
Eigen::VectorXd shape_of_floors(const Structure& frame, const std::vector<double>& displacements);

/// Shape by displacements of nodes. Throws std::invalid_argument, too, for a node or a displacement that is not there,
/// is held or has no mass, and for two that are the same unknown.
Eigen::VectorXd shape_of_nodes(const Structure& frame, const std::vector<NodeDisplacement>& displacements);

}  // namespace pounding
