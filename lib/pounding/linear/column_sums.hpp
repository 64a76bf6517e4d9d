#pragma once
/// A small dense matrix times a vector, many times over.

#include <Eigen/Core>

namespace pounding {

/// y = A x, the columns of A added one after the other: the same bits on every machine, by fewer instructions where its vectors hold four
/// numbers. `y` has room for the rows of A and overlaps neither.
void sum_columns(const Eigen::MatrixXd& a, const double* x, double* y);

}  // namespace pounding
