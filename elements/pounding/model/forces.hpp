#pragma once
/// Forces that act on a structure over time.

#include <optional>
#include <string>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// A force on a floor or on a node of a frame.
struct ForceOptions {
  std::optional<int> floor{};  ///< from 1 at the lowest; may be left out where the structure has one
  std::string node{};          ///< of a frame, instead of a floor
  /// The displacement on which the force works: of a floor ux, in space also uy and rz; of a node any of its
  /// displacements. Forces are positive along x, y and z, moments about them.
  std::string dof = "ux";
  GroundMotion history;  ///< force [N], or moment [N m] on a rotation, in the place of an acceleration
};

/// The force on a structure. Throws std::invalid_argument for a wall, a floor, a node or a displacement that is not
/// there, and for one that is held or has no mass.
AppliedForce applied_force(const Structure& structure, const ForceOptions& options);

}  // namespace pounding
