#pragma once
/// Modes that stand for one structure.

#include <Eigen/Core>

namespace pounding {

/// Mass-normalised modes of one group: shapes^T M shapes = 1 and shapes^T K shapes = squares. Unknowns without mass follow those with
/// mass statically.
struct GroupModes {
  Eigen::MatrixXd shapes;   ///< [unknown of the group, mode]
  Eigen::VectorXd squares;  ///< squares of the circular frequencies, ascending [rad^2/s^2]
};

}  // namespace pounding
