#pragma once
/// Products of dense matrices for single use.

#include <Eigen/Core>

namespace pounding::petsc {

/// A B, A^T B, and symmetric A^T B; sizes must match. If any dimension exceeds 1000, BLAS is used: three times faster,
/// but round-off differs between machines. Smaller products use column_sums.hpp and are bitwise identical on every
/// machine.
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd symmetric_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace pounding::petsc
