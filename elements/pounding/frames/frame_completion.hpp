#pragma once
/// Completion of a frame by all that a caller may leave out.

#include <pounding/frames/frame_model.hpp>

namespace pounding {

/// Fills in the supports that move together, and the nodes that are reported where nothing is said. Throws
/// std::invalid_argument for a frame that nothing holds, for what a frame without supports cannot take, and for a
/// motion of a support out of the plane.
void complete(FrameModel& model);

}  // namespace pounding
