#pragma once
/// Parts of devices from the options of a model.

#include <Eigen/Core>
#include <optional>

#include <pounding/model/model.hpp>

namespace pounding {

/// Validated parts. `length` is the distance in the drawing [m], for bars by section. Throws ModelError.
DeviceParts parts_of(const DeviceOptions& options, std::optional<double> length);

/// Rejects parts that are so stiff compared with the structures they connect that their forces are round-off: a force
/// is the product of a stiffness and a displacement with 16 digits. `stiffness` [N/m] and `mass` [kg] are those of the
/// structures for the elongation. Throws ModelError.
void require_digits(const DeviceParts& parts, double stiffness, double mass);

/// v'Av/v'v: stiffness or mass of a structure for a motion v of its unknowns; 0 for none.
double against(const SparseMatrix& matrix, const Row& motion);

/// Unit vector along a line, without the round-off of its coordinates: a device does not act along an axis
/// perpendicular to it.
Eigen::Vector3d unit_vector(const Eigen::Vector3d& line);

}  // namespace pounding
