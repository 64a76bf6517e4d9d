#pragma once
/// Hinges of a frame as yielding parts.

#include <vector>

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Adds the hinges to a structure with known state at rest, floors and internal forces: its yielding parts with their
/// flexibility, and their contributions to storey shears, member end forces and reactions.
///
/// K is the stiffness of the member with condensed end springs, in local axes, and D its block for the hinge rotations.
/// The deformation of a hinge is defined with the stiffness k [N m/rad]: that of its spring, or for a rigid-plastic
/// hinge the moment D_ii for a unit rotation of this end alone (4EI/L). It is d_i = m_i/k_i - F_i/k_i, where m_i is the
/// end moment and F_i the force of its law in addition to k d. Hence its moment is k_i d_i + F_i and its plastic
/// rotation -F_i/k_i. With b_i, row i of K as factors of the unknowns, d_i = b_i q/k_i - sum_j R_ij F_j, where R =
/// diag(1/k) - k^-1 D k^-1. The members transmit K q + sum_i (column i of K) F_i/k_i.
///
/// `above`: storey_cuts. Throws std::invalid_argument, starting with "hinge NAME: ", for a hinge that yields at rest,
/// for a corotational frame, and for supports with different motions.
void let_hinges_yield(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                      const std::vector<std::vector<bool>>& above, Structure& s);

}  // namespace pounding
