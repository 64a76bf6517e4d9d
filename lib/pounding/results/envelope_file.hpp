#pragma once
/// Envelopes in the results file.

#include <hdf5.h>

#include <vector>

#include <pounding/results/results.hpp>

namespace pounding {

/// Writes the group /envelopes/structures/NAME of each structure: for each quantity least and largest value in the last
/// place, and beside it their times. Throws std::runtime_error when HDF5 fails.
void write_envelopes(hid_t file, const std::vector<StructureHistory>& structures);

}  // namespace pounding
