#pragma once
/// The bays of a grid frame's input.

#include <array>
#include <vector>

#include <pounding/input/input.hpp>

namespace pounding {

/// `bays` and `bay_width` of a grid: the widths along x and along y [m], none along y in the plane. Throws InputError.
std::array<std::vector<double>, 2> read_bays(const Input& grid, int dimension);

}  // namespace pounding
