#pragma once
/// Initial displacements of a frame.

#include <Eigen/Core>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Displacements of all unknowns for forces that hold the floors at these displacements along x, one per floor from the
/// ground up [m], without other loads: K q = the forces. Relative to the state at rest. Throws std::invalid_argument
/// for a frame without floors, for a floor whose motion follows a massless node, and for a frame without supports.
Eigen::VectorXd shape_of_floors(const Structure& frame, const std::vector<double>& displacements);

/// Shape by displacements of nodes. Also throws std::invalid_argument for an unknown node or displacement, for one that
/// is fixed or massless, and for two that are the same unknown.
Eigen::VectorXd shape_of_nodes(const Structure& frame, const std::vector<NodeDisplacement>& displacements);

}  // namespace pounding
