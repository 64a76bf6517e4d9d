#pragma once
/// The structure of a frame.

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Matrices, floors, supports, state at rest and reports of a frame. The caller sets the lowest frequencies, damping,
/// name and initial state.
///
/// Motion of a floor: that of its master if it is rigid; otherwise in the plane that of its first node, and in space
/// the mean of its nodes weighted by their masses (ux, uy) and the best-fit rotation rz with the same weights.
///
/// Shear of a storey: sum of the horizontal forces on the upper ends of all members, and of the springs between nodes,
/// that cross the mid-height below the floor. Positive if the floor has moved along the axis relative to the storey
/// below, like stiffness times drift. The mid-height is that between the mean heights of the nodes of the two floors;
/// below the first floor, the lower one is the lowest support. Springs to the ground are not included.
///
/// Unknowns are named "node 3.1 ux", those of masters "floor 3 rz". Rows of members exclude the effect of loads between
/// their ends.
///
/// Corotational frames: the stiffness is the tangent at rest, shears and end forces are those of the rotated members,
/// and supports with different motions are rejected.
///
/// Throws std::invalid_argument like Frame, also for a frame without supports and, with nonlinear geometry, for one
/// that buckles.
Structure make_structure(FrameModel model);

/// The structure of a grid with fixed bases. Throws like the function above and make_frame.
Structure make_structure(const GridFrame& grid);

}  // namespace pounding
