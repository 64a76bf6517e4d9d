#pragma once
/// Products of dense matrices with one vector or a few, many times over. Each number is one sum in a fixed order, so
/// all of them have the same bits on every machine and for any number of vectors at a time; they take fewer
/// instructions where vectors hold four numbers.

#include <Eigen/Core>
#include <span>

namespace pounding {

/// Up to this number of entries of A its products go by plain loops, which cost less than a choice of vectors and have
/// the same bits.
inline constexpr Eigen::Index few_entries = 16;

/// y = A x, the columns of A added one after the other. `y` has room for the rows of A and overlaps neither.
void sum_columns(const Eigen::MatrixXd& a, const double* x, double* y);

/// A matrix by columns, `stride` numbers from one to the next.
struct Columns {
  const double* values;
  Eigen::Index rows, count, stride;
};

/// Y += A X, the columns of A added one after the other to each column of Y, `y_stride` numbers from one to the next.
/// `x` has as many rows as A has columns. Y overlaps neither.
void add_products(const Columns& a, const Columns& x, double* y, Eigen::Index y_stride);
/// The same to some rows of Y, one for each row of A, ascending. `room` is overwritten where they do not follow each
/// other.
void add_products(const Columns& a, const Columns& x, std::span<const int> rows, Eigen::MatrixXd& y,
                  Eigen::MatrixXd& room);
/// A X, by the same sums.
Eigen::MatrixXd summed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& x);

/// y_k += (f_j w_k) a_kj for one column j of A after the other; without weights y_k += f_j a_kj. `weights` is one
/// number a row, or empty.
struct ScaledColumn {
  const double* values;
  double factor;
};
void add_scaled(std::span<const ScaledColumn> columns, Eigen::Index rows, const double* weights, double* y);

}  // namespace pounding
