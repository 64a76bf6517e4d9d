#pragma once
/// Shared by the sources of Frame: where a displacement stands, and how a rigid body carries it.

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include <pounding/frames/frame.hpp>

namespace pounding::frame_dofs {

/// Place of a displacement among those of a node, -1 if the node has it not.
int place(int dimension, Dof dof);

/// Whether it is a rotation [rad] rather than a translation [m].
inline bool is_rotation(Dof dof) { return dof >= Dof::rx; }

/// The displacement of a point by those of a rigid body's node, u + r x arm, as (displacement of the node, factor).
std::vector<std::pair<Dof, double>> on_rigid_body(Dof dof, const Eigen::Vector3d& arm);

/// Refuses a node that is not among so many.
void require_node(int node, int nodes);
[[noreturn]] void refuse_out_of_plane(const std::string& node_name, Dof dof);

}  // namespace pounding::frame_dofs
