#pragma once
/// Completion of a frame with defaults.

#include <pounding/frames/frame_model.hpp>

namespace pounding {

/// Adds the supports that move together, and the default list of reported nodes. Throws std::invalid_argument for a
/// frame without supports, for properties that require supports in a free frame, and for a support motion out of the
/// plane.
void complete(FrameModel& model);

}  // namespace pounding
