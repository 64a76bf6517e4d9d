#pragma once
/// Reads the hinges of a frame.

#include <pounding/input/frames/frame_input.hpp>

namespace pounding {

/// Adds the hinges to a frame with members and supports, and stores their locations. Throws InputError with the
/// location.
void read_hinges(const Input& hinges, FrameInput& frame);

}  // namespace pounding
