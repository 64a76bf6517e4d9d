#pragma once
/// Modes that stand for one structure.

#include <Eigen/Core>
#include <optional>

#include <pounding/model/reduction.hpp>

namespace pounding {

/// Mass-normalised modes of one group: shapes^T M shapes = 1 and shapes^T K shapes = squares. Unknowns without mass follow those with
/// mass statically.
struct GroupModes {
  Eigen::MatrixXd shapes;   ///< [unknown of the group, mode]
  Eigen::VectorXd squares;  ///< squares of the circular frequencies, ascending [rad^2/s^2]
};

/// A group in fewer modes than all.
struct ReducedGroup {
  GroupModes modes;
  std::optional<GroupModes> shadow{};  ///< still fewer modes, whose motion tells the error of these
  ReducedStructure made{};             ///< in words and numbers
};

}  // namespace pounding
