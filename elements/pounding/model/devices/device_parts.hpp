#pragma once
/// Parts of devices from the options of a model.

#include <Eigen/Core>
#include <optional>

#include <pounding/model/model.hpp>

namespace pounding {

/// Checked. `length` that is drawn [m], for bars by their section. Throws ModelError.
DeviceParts parts_of(const DeviceOptions& options, std::optional<double> length);

/// Refuses parts that are so much stiffer than what they join that their forces are round-off: a force is the product
/// of a stiffness and a displacement, which has 16 digits. `stiffness` [N/m] and `mass` [kg] are those of the
/// structures against the elongation. Throws ModelError.
void require_digits(const DeviceParts& parts, double stiffness, double mass);

/// v'Av/v'v: the stiffness or the mass of a structure against a motion v of its unknowns; 0 for none.
double against(const SparseMatrix& matrix, const Row& motion);

/// The unit vector along a line, without the rounding of the coordinates that it was drawn by: a device does not act
/// along an axis that it is square to.
Eigen::Vector3d unit_vector(const Eigen::Vector3d& line);

}  // namespace pounding
