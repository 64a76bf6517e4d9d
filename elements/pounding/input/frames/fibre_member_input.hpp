#pragma once
/// The key `fibres` of a frame.

#include <pounding/frames/frame_model.hpp>
#include <pounding/input/input.hpp>

namespace pounding {

/// Adds the members that yield along their length to a frame with all its members and hinges and its geometry. Throws
/// InputError, also for a softening section without a hinge length.
void read_fibre_members(const Input& node, FrameModel& model);

}  // namespace pounding
