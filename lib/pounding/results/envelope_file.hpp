#pragma once
/// Envelopes in the results file.

#include <hdf5.h>

#include <vector>

#include <pounding/results/results.hpp>

namespace pounding {

/// Writes the group /envelopes/structures/NAME of each structure: minimum and maximum of each quantity along the last
/// axis, and a second dataset with their times. Throws std::runtime_error if HDF5 fails.
void write_envelopes(hid_t file, const std::vector<StructureHistory>& structures);

}  // namespace pounding
