#pragma once
/// Periods, mode shapes and participation of one structure.

#include <Eigen/Core>
#include <string>
#include <vector>

#include <pounding/model.hpp>

namespace pounding {

struct Mode {
  double period = 0;          ///< [s]
  double damping_ratio = 0;   ///< of the mode, from the structure's damping matrix
  double participation = 0;   ///< phi^T M 1 / phi^T M phi with the top floor's amplitude 1
  double effective_mass = 0;  ///< (phi^T M 1)^2 / phi^T M phi [kg]
  Eigen::VectorXd shape;      ///< amplitude of the top floor is 1
};

/// The modes of a structure, longest period first; none for a wall. A body has one of infinite period.
std::vector<Mode> modes(const Structure& structure);

/// One table a structure: periods, damping ratios, participation, effective masses, shapes.
std::string modes_table(const Model& model);
std::string modes_json(const Model& model);

}  // namespace pounding
