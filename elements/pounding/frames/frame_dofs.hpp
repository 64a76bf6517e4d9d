#pragma once
/// Helpers of Frame: index of a displacement, and kinematics of rigid bodies.

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include <pounding/frames/frame.hpp>

namespace pounding::frame_dofs {

/// Index of a displacement among those of a node; -1 if the node does not have it.
int place(int dimension, Dof dof);

/// True for a rotation [rad], false for a translation [m].
inline bool is_rotation(Dof dof) { return dof >= Dof::rx; }

/// Displacement of a point as a function of those of the node of a rigid body, u + r x arm: (displacement of the node,
/// factor).
std::vector<std::pair<Dof, double>> on_rigid_body(Dof dof, const Eigen::Vector3d& arm);

/// Throws for a node number out of range.
void require_node(int node, int nodes);
[[noreturn]] void refuse_out_of_plane(const std::string& node_name, Dof dof);

}  // namespace pounding::frame_dofs
