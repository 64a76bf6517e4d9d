#pragma once
/// Modes that stand for one structure.

#include <Eigen/Core>
#include <memory>

#include <pounding/model/reduction.hpp>

namespace pounding {

/// Mass-normalised modes of one group: shapes^T M shapes = 1 and shapes^T K shapes = squares. Unknowns without mass
/// follow those with mass statically.
struct GroupModes {
  Eigen::MatrixXd shapes;   ///< [unknown of the group, mode]
  Eigen::VectorXd squares;  ///< squares of the circular frequencies, ascending [rad^2/s^2]
};

/// Still fewer modes of a group, each a sum of those of the run: their shapes are shapes * in_modes, and in_modes^T
/// in_modes = 1.
struct ShadowModes {
  Eigen::MatrixXd in_modes;  ///< [mode of the run, mode of the shadow]
  Eigen::VectorXd squares;   ///< squares of the circular frequencies, ascending [rad^2/s^2]
};

/// A group in fewer modes than all. Groups with equal matrices that are driven alike share them.
struct ReducedGroup {
  std::shared_ptr<const GroupModes> modes;
  std::shared_ptr<const ShadowModes> shadow{};  ///< its motion tells the error of the modes; nothing for none
  ReducedStructure made{};                      ///< in words and numbers
};

}  // namespace pounding
