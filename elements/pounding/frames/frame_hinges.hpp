#pragma once
/// Hinges of a frame as parts of its structure that yield.

#include <vector>

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Adds the hinges to a structure that has its state at rest, its floors and its internal forces: its yielding parts
/// and how they give way, and what they add to storey shears, to end forces of members and to reactions.
///
/// K is the stiffness of the member with the springs of its ends condensed, in local axes, and D its part of the hinged
/// rotations. A hinge counts its deformation with the stiffness k [N m/rad]: of its spring, or where it is
/// rigid-plastic the moment D_ii by a unit rotation of this end alone (4EI/L). It follows d_i = m_i/k_i - F_i/k_i,
/// where m_i is the end moment and F_i the force of its law on top of k d. So its moment is k_i d_i + F_i, its plastic
/// rotation -F_i/k_i, and with b_i, row i of K as factors of the unknowns, d_i = b_i q/k_i - sum_j R_ij F_j with R =
/// diag(1/k) - k^-1 D k^-1. The members pass on K q + sum_i (column i of K) F_i/k_i.
///
/// `above`: storey_cuts. Throws std::invalid_argument, beginning with "hinge NAME: ", for one that yields at rest, one
/// of a member that turns by large angles, and where supports move differently.
void let_hinges_yield(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                      const std::vector<std::vector<bool>>& above, Structure& s);

}  // namespace pounding
