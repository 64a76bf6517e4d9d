#pragma once
/// Modal bases of one structure.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include <pounding/model/reduction.hpp>

namespace pounding {

/// Mass-normalised modes of one group: shapes^T M shapes = 1 and shapes^T K shapes = squares. Massless degrees of
/// freedom follow the others statically.
struct GroupModes {
  Eigen::MatrixXd shapes;   ///< [unknown of the group, mode]
  Eigen::VectorXd squares;  ///< squares of the circular frequencies, ascending [rad^2/s^2]
};

/// A smaller basis of a group, in terms of the modes of the run: the shapes are shapes * in_modes, and in_modes^T
/// in_modes = 1.
struct ShadowModes {
  Eigen::MatrixXd in_modes;  ///< [mode of the run, mode of the shadow]
  Eigen::VectorXd squares;   ///< squares of the circular frequencies, ascending [rad^2/s^2]
};

/// A group in a reduced basis. Groups with equal matrices and equal inputs share it.
struct ReducedGroup {
  std::shared_ptr<const GroupModes> modes;
  std::shared_ptr<const ShadowModes> shadow{};  ///< its motion estimates the reduction error; null if there is none
  ReducedStructure made{};                      ///< description and numbers for reports
};

/// By group of a system; nullopt for all natural modes.
using ReducedGroups = std::vector<std::optional<ReducedGroup>>;

}  // namespace pounding
