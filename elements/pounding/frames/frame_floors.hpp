#pragma once
/// The floors of a frame: how they move, and the shear forces of the storeys below them.

#include <vector>

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// For each floor, whether each node lies above the middle height of the storey below it.
std::vector<std::vector<bool>> storey_cuts(const FrameModel& model);

/// The floors as a structure reports them, see make_structure.
std::vector<Floor> make_floors(const FrameModel& model, const AssembledFrame& frame);

/// Storey shears by the displacements of all nodes that supports enforce (Frame::SupportMotion), floor by floor, along
/// x, and y in space [N/m].
Eigen::MatrixX3d enforced_shears(const FrameModel& model, const AssembledFrame& frame,
                                 const Eigen::MatrixX3d& enforced);

}  // namespace pounding
