#pragma once
/// Bays of a grid.

#include <array>
#include <vector>

#include <pounding/input/input.hpp>

namespace pounding {

/// Reads `bays` and `bay_width` of a grid: widths along x and y [m], none along y in the plane. Throws InputError.
std::array<std::vector<double>, 2> read_bays(const Input& grid, int dimension);

}  // namespace pounding
