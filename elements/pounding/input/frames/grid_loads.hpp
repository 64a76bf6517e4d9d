#pragma once
/// Loads on the beams of a grid.

#include <pounding/frames/frame.hpp>
#include <pounding/input/input.hpp>

namespace pounding {

/// Reads beams_load, or dead_load and live_load with their combination, and mass_from_loads. Throws InputError.
void read_loads(const Input& node, GridFrame& grid);

}  // namespace pounding
