#pragma once
/// Steps from a FrameModel to a Structure: supports, floors, hinges and isolators.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pounding/frames/frame.hpp>
#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// What to type instead of the nonlinear key of a model, or of these parts.
inline std::string instead_of_nonlinear(const FrameModel& model, std::string_view parts) {
  return std::string(model.fibres.empty() ? "type geometry: p_delta" : "remove fibres") + ", or remove " +
         std::string(parts);
}

/// Adds the supports that move together, and the default list of reported nodes. Throws std::invalid_argument for a
/// frame without supports, for properties that require supports in a free frame, and for a support motion out of the
/// plane.
void complete(FrameModel& model);

/// For each floor and node, true if the node is above the mid-height of the storey below the floor.
std::vector<std::vector<bool>> storey_cuts(const FrameModel& model);

/// Sections of fibres of the members, in the order of the members.
std::vector<FibreSectionReport> report_fibre_sections(const FrameModel& model);

/// Floors as reported by a structure, see make_structure.
std::vector<Floor> make_floors(const FrameModel& model, const AssembledFrame& frame);

/// Storey shears due to enforced support displacements of all nodes (Frame::SupportMotion), floor by floor, along x,
/// and y in space [N/m].
Eigen::MatrixX3d enforced_shears(const FrameModel& model, const Eigen::MatrixX3d& enforced);

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

/// Adds the isolators to an otherwise complete model: each is added to the frame as a spring with the initial stiffness
/// of its law. If a law requires a weight that is not given, it is the load at rest of its node, from the members and
/// weights before p_delta.
///
/// Throws std::invalid_argument, starting with "isolator NAME: ", for invalid parameters of the law, an isolator in
/// tension or without vertical support, a weight that cannot be determined, a law that cannot be coupled in space, a
/// corotational frame, and supports with different motions.
void place_isolators(FrameModel& model);

/// Adds the isolators to a structure with known state at rest, internal forces and hinges. Also throws for a massless
/// node and for an isolator that yields at rest.
void let_isolators_yield(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                         Structure& s);

/// Adds the springs that act in compression only to a model before complete(), as ordinary springs: at rest they are
/// compressed. Throws std::invalid_argument, starting with "support NAME: ", for a free or corotational frame, and
/// without gravity or loads.
void place_uplifts(FrameModel& model);

/// Makes these springs lift off when their compression at rest is exhausted, in a structure with known state at rest,
/// internal forces, hinges and isolators. Throws std::invalid_argument, starting with "support NAME: ", for a spring
/// without compression at rest, a massless node, and supports with different motions.
void let_supports_uplift(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                         Structure& s);

/// Adds to the reactions of the ground the forces of the last parts in addition to k d. Each part from `first_part` on
/// is a spring between the ground and a displacement of a node.
void add_part_reactions(const FrameModel& model, const Frame::Reactions& reactions,
                        const std::vector<std::pair<int, Dof>>& springs, int first_part, Structure& s);

/// Fraction of its elastic stiffness that a hinge without hardening retains at such a joint, which would otherwise
/// rotate freely. Moments increase by this fraction of the ductility.
inline constexpr double min_hardening = 1e-8;

/// For each hinge, true if its joint can rotate and all member ends there are released or have hinges about all axes
/// without post-yield stiffness, as given by `keeps_nothing` per hinge.
std::vector<bool> at_loose_joints(const Frame& frame, const AssembledFrame& assembled,
                                  const std::vector<bool>& keeps_nothing);

}  // namespace pounding
