#pragma once
/// Writers of the parts of a results file.

#include <hdf5.h>

#include <cstddef>
#include <string>
#include <vector>

#include <pounding/results/hdf5.hpp>
#include <pounding/results/results.hpp>

namespace pounding {

/// Writes the group /devices: histories at the output times, and the extremes over all steps under `envelope`. No
/// group without devices. Throws std::invalid_argument if a history does not have `samples` values.
void write_devices(hid_t file, const std::vector<DeviceHistory>& devices, std::size_t samples);

/// Writes the group /envelopes/structures/NAME of each structure: minimum and maximum of each quantity along the last
/// dimension, and their times in a second dataset. Throws std::runtime_error if HDF5 fails.
void write_envelopes(hid_t file, const std::vector<StructureHistory>& structures);

/// Writes the group `springs` of a structure: histories at the output times, and a few numbers per part under
/// `summary`. No group for a structure that remains elastic. Throws std::invalid_argument if a history does not have
/// `samples` values per part.
void write_springs(hid_t structure, const std::string& name, const SpringHistory& springs, std::size_t samples);

/// Writes the group /solver, with the reduction if structures are reduced.
void write_solver(hid_t file, const Results& results);

/// Writes the ends of a LinkHistory or a DeviceHistory, with position and direction, as attributes of its group.
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
