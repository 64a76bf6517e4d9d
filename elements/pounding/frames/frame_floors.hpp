#pragma once
/// Floors of a frame: their motion, and the shear forces of the storeys below.

#include <vector>

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// For each floor and node, true if the node is above the mid-height of the storey below the floor.
std::vector<std::vector<bool>> storey_cuts(const FrameModel& model);

/// Floors as reported by a structure, see make_structure.
std::vector<Floor> make_floors(const FrameModel& model, const AssembledFrame& frame);

/// Storey shears due to enforced support displacements of all nodes (Frame::SupportMotion), floor by floor, along x,
/// and y in space [N/m].
Eigen::MatrixX3d enforced_shears(const FrameModel& model, const AssembledFrame& frame,
                                 const Eigen::MatrixX3d& enforced);

}  // namespace pounding
