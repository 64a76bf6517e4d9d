#pragma once
/// Products of dense matrices with one or a few vectors, for repeated use. Each result is one sum in a fixed order, so
/// results are bitwise identical on every machine and for any number of vectors. Wide vector instructions are used
/// where available.

#include <Eigen/Core>
#include <span>

namespace pounding {

/// Matrices with at most this many entries use plain loops, which avoid the overhead of dispatch and give bitwise
/// identical results.
inline constexpr Eigen::Index few_entries = 16;

/// y = A x, summed column by column. `y` has room for the rows of A and overlaps neither argument.
void sum_columns(const Eigen::MatrixXd& a, const double* x, double* y);

/// A matrix stored by columns, `stride` numbers apart.
struct Columns {
  const double* values;
  Eigen::Index rows, count, stride;
};

/// Y += A X, summed over the columns of A in order. `y_stride` is the distance between columns of Y. `x` has as many
/// rows as A has columns. Y overlaps neither argument.
void add_products(const Columns& a, const Columns& x, double* y, Eigen::Index y_stride);
/// Same, adding row i of A X to row rows[i] of Y; `rows` is ascending. `room` is a work array, overwritten if the rows
/// are not contiguous.
void add_products(const Columns& a, const Columns& x, std::span<const int> rows, Eigen::MatrixXd& y,
                  Eigen::MatrixXd& room);
/// A X, by the same sums.
Eigen::MatrixXd summed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& x);

/// y_k += (f_j w_k) a_kj, column by column; y_k += f_j a_kj without weights. `weights` has one number per row, or is
/// empty.
struct ScaledColumn {
  const double* values;
  double factor;
};
void add_scaled(std::span<const ScaledColumn> columns, Eigen::Index rows, const double* weights, double* y);

}  // namespace pounding
