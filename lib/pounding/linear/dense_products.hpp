#pragma once
/// Products of dense matrices, once each.

#include <Eigen/Core>

namespace pounding::petsc {

/// A B, A^T B, and A^T B where it is symmetric. With more than 1000 rows or columns anywhere they go by BLAS, whose
/// bits differ between machines: three times as fast. Smaller ones are the sums of column_sums.hpp, which have the same
/// bits everywhere. Sizes must fit.
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd symmetric_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace pounding::petsc
