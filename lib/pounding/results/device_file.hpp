#pragma once
/// Bars and dampers between structures in the results file.

#include <hdf5.h>

#include <cstddef>
#include <vector>

#include <pounding/results/results.hpp>

namespace pounding {

/// Writes the group /devices: histories at the output times, and the extremes over all steps under `envelope`. Does
/// nothing without devices. Throws std::invalid_argument if a history does not have `samples` values.
void write_devices(hid_t file, const std::vector<DeviceHistory>& devices, std::size_t samples);

}  // namespace pounding
