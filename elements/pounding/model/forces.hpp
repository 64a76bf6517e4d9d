#pragma once
/// Forces that act on a structure over time.

#include <optional>
#include <string>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// A force on a floor or on a node of a frame.
struct ForceOptions {
  std::optional<int> floor{};  ///< from 1 at the lowest; optional if the structure has one floor
  std::string node{};          ///< of a frame, instead of a floor
  /// Displacement conjugate to the force: of a floor ux, in space also uy and rz; of a node any of its displacements.
  /// Forces are positive along x, y and z, moments about them.
  std::string dof = "ux";
  GroundMotion history;  ///< force [N], or moment [N m] for a rotation, instead of an acceleration
};

/// Force on a structure. Throws std::invalid_argument for a wall, for an unknown floor, node or displacement, and for
/// one that is fixed or massless.
AppliedForce applied_force(const Structure& structure, const ForceOptions& options);

}  // namespace pounding
