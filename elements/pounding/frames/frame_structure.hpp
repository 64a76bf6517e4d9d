#pragma once
/// The structure that a frame is.

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Matrices, floors, supports, state at rest and reports of a frame; first frequency and Rayleigh damping are left to
/// the caller, as are the name and the initial state.
///
/// Motion of a floor: of its master when it is rigid; else of its first node in the plane, and in space the mean of its
/// nodes, weighted by their masses (ux, uy), and the turn rz that fits their motions best by the same weights.
///
/// Shear of a storey: the sum over all members that cross the middle height below the floor, and the springs between
/// nodes that do, of the horizontal forces on their upper ends; positive when the floor has moved along the axis
/// against what is below, as stiffness times drift. The middle is that between the mean heights of the nodes of the two
/// floors, under the first floor that of the lowest support. Springs to the ground have no part in it.
///
/// Unknowns are called "node 3.1 ux", those of masters "floor 3 rz". Rows of members are without what a load between
/// their ends adds.
///
/// Members that turn by large angles: the stiffness is the tangent at rest, shears and end forces are those of the
/// turned members, and supports that move differently are refused.
///
/// Throws std::invalid_argument as Frame does, also for a frame that nothing holds and, other than linear, one that
/// buckles.
Structure make_structure(FrameModel model);

/// The structure of a grid with fixed feet. Throws as the above, and as make_frame.
Structure make_structure(const GridFrame& grid);

}  // namespace pounding
