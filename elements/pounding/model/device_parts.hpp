#pragma once
/// Parts of devices from the options of a model.

#include <optional>

#include <pounding/model/model.hpp>

namespace pounding {

/// Checked. `length` that is drawn [m], for bars by their section. Throws ModelError.
DeviceParts parts_of(const DeviceOptions& options, std::optional<double> length);

}  // namespace pounding
