#pragma once
/// Parts of devices from the options of a model.

#include <Eigen/Core>
#include <optional>

#include <pounding/model/model.hpp>

namespace pounding {

/// Checked. `length` that is drawn [m], for bars by their section. Throws ModelError.
DeviceParts parts_of(const DeviceOptions& options, std::optional<double> length);

/// The unit vector along a line, without the rounding of the coordinates that it was drawn by: a device does not act along an axis
/// that it is square to.
Eigen::Vector3d unit_vector(const Eigen::Vector3d& line);

}  // namespace pounding
