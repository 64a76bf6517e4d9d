#pragma once
/// Periods, mode shapes and participation of one structure.

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// One natural mode of a structure.
struct Mode {
  double period = 0;         ///< [s]; infinity for a free body
  double damping_ratio = 0;  ///< of the mode, from the structure's damping matrix
  /// phi^T p / phi^T M phi for the ground along x, y, z, of the shape as it stands here.
  Eigen::Vector3d participation = Eigen::Vector3d::Zero();
  Eigen::Vector3d effective_mass = Eigen::Vector3d::Zero();  ///< (phi^T p)^2 / phi^T M phi [kg]
  /// [floor, direction] of the floors' reported motion. The top floor is 1 in a structure along x, the largest translation of a
  /// floor in a frame.
  Eigen::MatrixXd shape;
  Eigen::VectorXd unknowns;  ///< the same, of all unknowns
};

/// The lowest modes of a structure, longest period first; none for a wall. A body has one of infinite period.
std::vector<Mode> modes(const Structure& structure, int count = std::numeric_limits<int>::max(),
                        const ModeSolver& solver = dense_modes);

/// One table a structure: periods, damping ratios, participation, effective masses, shapes. `most` modes of a frame, all of
/// the others.
std::string modes_table(const Model& model, int most, const ModeSolver& solver = dense_modes);
/// One object with a list of modes a structure; `for_pictures` puts it beside what pictures of frames need: {"modes": the
/// object, "geometry": {NAME: {dimension, nodes, members}}, "node_shapes": {NAME: [mode][node][x y z]}, "elevations": {NAME: []}}.
std::string modes_json(const Model& model, int most, const ModeSolver& solver = dense_modes, bool for_pictures = false);

}  // namespace pounding
