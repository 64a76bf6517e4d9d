#pragma once
/// Reported quantities of a frame that follow linearly from its motion, beside those of its floors.

#include <Eigen/Core>
#include <vector>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// At an output time, without what parts that yield or turn add to the forces, and without what loads add while the
/// unknowns rest.
struct FrameQuantities {
  Eigen::VectorXd displacement, velocity, acceleration;  ///< of the reported nodes, direction by direction
  Eigen::VectorXd shears;                                ///< floor by floor and direction by direction [N]
  Eigen::VectorXd forces;  ///< rows of InternalForces that reported_forces() names [N], [N m]
};

/// Rows of InternalForces that are kept over time: those of the reported members, then the reactions.
std::vector<int> reported_forces(const Structure& structure);

/// From displacements, those at rest included, velocities and accelerations of all unknowns.
FrameQuantities frame_quantities(const Structure& structure, const std::vector<int>& reported, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& v, const Eigen::VectorXd& a);

/// Quantities of a frame with few modes as sums over these: the displacements of all its unknowns are not needed.
class FrameRows {
 public:
  FrameRows(const Structure& structure, const std::vector<int>& reported, const StructureSolver::FewModes& modes);

  /// From the coordinates of all structures [coordinate, u v a].
  FrameQuantities at(const Eigen::MatrixXd& coordinates) const;

 private:
  Eigen::Index first_;              // of the coordinates
  Eigen::MatrixXd nodes_, others_;  // [quantity, mode]
  FrameQuantities at_rest_;
};

}  // namespace pounding
