#pragma once
/// Reads the hinges of a frame.

#include <pounding/input/frames/frame_input.hpp>

namespace pounding {

/// Adds what stands under `hinges` to a frame that has its members and supports, and notes the places of the hinges.
/// Throws InputError at the place of what is wrong.
void read_hinges(const Input& hinges, FrameInput& frame);

}  // namespace pounding
