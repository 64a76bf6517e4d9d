#pragma once
/// Reported quantities of a frame that are linear in its motion, except those of its floors.

#include <Eigen/Core>
#include <vector>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Values at an output time, without the contributions of yielding parts, large rotations, and loads on undeformed
/// members.
struct FrameQuantities {
  Eigen::VectorXd displacement, velocity, acceleration;  ///< of the reported nodes, direction by direction
  Eigen::VectorXd shears;                                ///< by floor and direction [N]
  Eigen::VectorXd forces;  ///< rows of InternalForces listed by reported_forces() [N], [N m]
};

/// Rows of InternalForces recorded over time: those of the reported members, then the reactions.
std::vector<int> reported_forces(const Structure& structure);

/// From displacements (including those at rest), velocities and accelerations of all unknowns.
FrameQuantities frame_quantities(const Structure& structure, const std::vector<int>& reported, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& v, const Eigen::VectorXd& a);

/// Quantities of a frame with few modes as sums over the modes, without the displacements of all unknowns.
class FrameRows {
 public:
  /// `modes`: coordinates of the structure, with its modes.
  FrameRows(const Structure& structure, const std::vector<int>& reported, const StructureSolver::Segment& modes);

  /// From the coordinates of all structures [coordinate, u v a].
  FrameQuantities at(const Eigen::MatrixXd& coordinates) const;

 private:
  Eigen::Index first_;              // first coordinate
  Eigen::MatrixXd nodes_, others_;  // [quantity, mode]
  FrameQuantities at_rest_;
};

}  // namespace pounding
