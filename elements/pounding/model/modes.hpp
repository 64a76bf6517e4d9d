#pragma once
/// Natural modes of structures: periods, damping ratios, shapes, participation.

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// One natural mode of a structure.
struct Mode {
  double period = 0;         ///< [s]; infinity for a free body
  double damping_ratio = 0;  ///< from the structure's damping matrix [-]
  /// Participation factors phi^T p / phi^T M phi for ground motion along x, y, z, with phi scaled as `shape`.
  Eigen::Vector3d participation = Eigen::Vector3d::Zero();
  Eigen::Vector3d effective_mass = Eigen::Vector3d::Zero();  ///< (phi^T p)^2 / phi^T M phi [kg]
  /// Motion of the floors: [floor, direction]. Scaled to 1 at the top floor of a structure along x, and at the maximum
  /// floor translation of a frame.
  Eigen::MatrixXd shape;
  Eigen::VectorXd unknowns;  ///< shape at all unknowns, in the same scale
};

/// Lowest modes of a structure, longest period first. A wall has none; a free body has one with an infinite period.
std::vector<Mode> modes(const Structure& structure, int count = std::numeric_limits<int>::max(),
                        const ModeSolver& solver = dense_modes);

/// Damping ratios of the modes at `frequencies` of a structure. Those of damping that is not a combination of M and K,
/// and not modal, follow from mode shapes; empty if these are not available at low cost, above 200 unknowns.
std::vector<double> damping_ratios(const Structure& structure);

/// Text with one table per structure: periods, damping ratios, participation, effective masses, shapes. Frames show at
/// most `max_count` modes, other structures all.
std::string modes_table(const Model& model, int max_count, const ModeSolver& solver = dense_modes);
/// JSON object with a list of modes per structure. With `for_pictures` it is one of four members, the others being the
/// data for pictures of frames: {"modes": this object, "geometry": {NAME: {dimension, nodes, members}}, "node_shapes":
/// {NAME: [mode][node][x y z]}, "elevations": {NAME: []}}.
std::string modes_json(const Model& model, int max_count, const ModeSolver& solver = dense_modes,
                       bool for_pictures = false);

}  // namespace pounding
