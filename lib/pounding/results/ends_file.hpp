#pragma once
/// The two ends of a link or a device in the results file.

#include <vector>

#include <pounding/results/hdf5.hpp>
#include <pounding/results/results.hpp>

namespace pounding {

/// Writes the ends, position and direction of a LinkHistory or a DeviceHistory as attributes of its group.
template <class Joined>
void write_ends(hid_t place, const Joined& joined) {
  using hdf5::attribute;
  attribute(place, "left", joined.left.structure);
  attribute(place, "left_floor", joined.left.floor);
  attribute(place, "right", joined.right.structure);
  attribute(place, "right_floor", joined.right.floor);
  attribute(place, "left_end", joined.left.label);
  attribute(place, "right_end", joined.right.label);
  attribute(place, "position", std::vector<double>(joined.position.begin(), joined.position.end()));
  attribute(place, "direction", std::vector<double>(joined.direction.begin(), joined.direction.end()));
}

}  // namespace pounding
