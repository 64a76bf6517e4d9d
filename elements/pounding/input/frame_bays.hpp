#pragma once
/// The bays of a grid frame's input.

#include <array>
#include <vector>

#include <pounding/input/input.hpp>

namespace pounding {

/// The bays along one direction.
struct Bays {
  int count = 0;
  std::vector<double> at{0.0};     ///< coordinate of each column line [m]
  std::vector<double> share{1.0};  ///< part of the whole width that belongs to it
};

/// `bays` and `bay_width` of a grid, along x and along y; in the plane there is one line along y. Throws InputError.
std::array<Bays, 2> read_bays(const Input& grid, int dimension);

}  // namespace pounding
