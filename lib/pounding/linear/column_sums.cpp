#include <pounding/linear/column_sums.hpp>

#include <algorithm>
#include <vector>

#include <pounding/linear/wide_vectors.hpp>

namespace pounding {
namespace {

using Eigen::Index;

// From this number of columns of X, a panel of A is copied first, because its columns are far apart and each is read
// several times.
constexpr Index many_columns = 4;
// Rows and columns of such a panel, which stays in the cache. It is copied in pieces of `piece_rows` rows, with
// contiguous columns.
constexpr Index panel_rows = 64, panel_columns = 256, piece_rows = 16;
// With fewer columns of X and a tall A, this many columns of A are read in parallel streams.
constexpr Index tall = 256, streams = 8;

template <int columns>
POUNDING_INLINE void add_row(const Columns& a, const double* x, Index x_stride, double* y, Index y_stride, Index row) {
  double sum[columns];
  for (int c = 0; c < columns; ++c) sum[c] = y[row + c * y_stride];
  const double* of = a.values + row;
  for (Index j = 0; j < a.count; ++j, of += a.stride)
    for (int c = 0; c < columns; ++c) sum[c] += *of * x[j + c * x_stride];
  for (int c = 0; c < columns; ++c) y[row + c * y_stride] = sum[c];
}

#ifdef POUNDING_HAS_FOUR
template <class Vector>
POUNDING_INLINE Vector& vector(double* at) {
  return *reinterpret_cast<Vector*>(at);
}
template <class Vector>
POUNDING_INLINE const Vector& vector(const double* at) {
  return *reinterpret_cast<const Vector*>(at);
}

// Processes `blocks` vectors of rows from `row` on; the sums stay in registers.
template <class Vector, int blocks, int columns>
POUNDING_INLINE Index add_rows(const Columns& a, const double* x, Index x_stride, double* y, Index y_stride,
                               Index row) {
  constexpr Index width = sizeof(Vector) / sizeof(double);
  for (; row + width * blocks <= a.rows; row += width * blocks) {
    Vector sum[columns][blocks];
#pragma GCC unroll 8
    for (int c = 0; c < columns; ++c)
#pragma GCC unroll 4
      for (int k = 0; k < blocks; ++k) sum[c][k] = vector<Vector>(y + row + c * y_stride + width * k);
    const double* of = a.values + row;
    for (Index j = 0; j < a.count; ++j, of += a.stride) {
#pragma GCC unroll 4
      for (int k = 0; k < blocks; ++k) {
        const Vector value = vector<Vector>(of + width * k);
#pragma GCC unroll 8
        for (int c = 0; c < columns; ++c) sum[c][k] += value * x[j + c * x_stride];
      }
    }
#pragma GCC unroll 8
    for (int c = 0; c < columns; ++c)
#pragma GCC unroll 4
      for (int k = 0; k < blocks; ++k) vector<Vector>(y + row + c * y_stride + width * k) = sum[c][k];
  }
  return row;
}
#else
using Four = double;
template <class Vector, int blocks, int columns>
Index add_rows(const Columns&, const double*, Index, double*, Index, Index row) {
  return row;
}
#endif

template <int columns>
POUNDING_INLINE void add_few(const Columns& a, const double* x, Index x_stride, double* y, Index y_stride) {
  Index row = add_rows<Four, 4, columns>(a, x, x_stride, y, y_stride, 0);
  row = add_rows<Four, 2, columns>(a, x, x_stride, y, y_stride, row);
  row = add_rows<Four, 1, columns>(a, x, x_stride, y, y_stride, row);
  for (; row < a.rows; ++row) add_row<columns>(a, x, x_stride, y, y_stride, row);
}

// Processes the columns of X from `c` on.
POUNDING_INLINE void add_all(const Columns& a, const Columns& x, double* y, Index y_stride, Index c) {
  for (; c + 3 <= x.count; c += 3) add_few<3>(a, x.values + c * x.stride, x.stride, y + c * y_stride, y_stride);
  if (c + 2 == x.count) add_few<2>(a, x.values + c * x.stride, x.stride, y + c * y_stride, y_stride);
  if (c + 1 == x.count) add_few<1>(a, x.values + c * x.stride, x.stride, y + c * y_stride, y_stride);
}

POUNDING_WIDE void add_by_wide_vectors(const Columns& a, const Columns& x, double* y, Index y_stride, Index c) {
  add_all(a, x, y, y_stride, c);
}

// Processes whole pieces of rows with eight columns of X; returns the number of processed columns.
POUNDING_WIDEST Index add_by_widest_vectors(const Columns& a, const Columns& x, double* y, Index y_stride) {
  Index c = 0;
#ifdef POUNDING_HAS_FOUR
  for (; c + 8 <= x.count; c += 8)
    add_rows<Eight, 2, 8>(a, x.values + c * x.stride, x.stride, y + c * y_stride, y_stride, 0);
#endif
  return c;
}

void add(const Columns& a, const Columns& x, double* y, Index y_stride) {
  const Index done = a.rows == piece_rows && has_widest_vectors() ? add_by_widest_vectors(a, x, y, y_stride) : 0;
  if (has_wide_vectors())
    add_by_wide_vectors(a, x, y, y_stride, done);
  else
    add_all(a, x, y, y_stride, done);
}

POUNDING_INLINE void scale_all(std::span<const ScaledColumn> columns, Index rows, const double* weights, double* y) {
  Index k = 0;
#ifdef POUNDING_HAS_FOUR
  constexpr int blocks = 4;
  for (; k + 4 * blocks <= rows; k += 4 * blocks) {
    Four sum[blocks], weight[blocks];
#pragma GCC unroll 4
    for (int b = 0; b < blocks; ++b) {
      sum[b] = vector<Four>(y + k + 4 * b);
      weight[b] = weights ? vector<Four>(weights + k + 4 * b) : Four{1, 1, 1, 1};
    }
    for (const ScaledColumn& column : columns) {
      const Four factor{column.factor, column.factor, column.factor, column.factor};
#pragma GCC unroll 4
      for (int b = 0; b < blocks; ++b) sum[b] += factor * weight[b] * vector<Four>(column.values + k + 4 * b);
    }
#pragma GCC unroll 4
    for (int b = 0; b < blocks; ++b) vector<Four>(y + k + 4 * b) = sum[b];
  }
#endif
  for (; k < rows; ++k) {
    double sum = y[k];
    const double weight = weights ? weights[k] : 1;
    for (const ScaledColumn& column : columns) sum += column.factor * weight * column.values[k];
    y[k] = sum;
  }
}

POUNDING_WIDE void scale_by_wide_vectors(std::span<const ScaledColumn> columns, Index rows, const double* weights,
                                         double* y) {
  scale_all(columns, rows, weights, y);
}

}  // namespace

void sum_columns(const Eigen::MatrixXd& a, const double* x, double* y) {
  std::fill_n(y, a.rows(), 0.0);
  add_products({a.data(), a.rows(), a.cols(), a.rows()}, {x, a.cols(), 1, a.cols()}, y, a.rows());
}

void add_products(const Columns& a, const Columns& x, double* y, Index y_stride) {
  if (a.rows * a.count <= few_entries) {
    for (Index c = 0; c < x.count; ++c) {
      const double* const of = x.values + c * x.stride;
      for (Index i = 0; i < a.rows; ++i) {
        double sum = y[i + c * y_stride];
        for (Index j = 0; j < a.count; ++j) sum += a.values[i + j * a.stride] * of[j];
        y[i + c * y_stride] = sum;
      }
    }
    return;
  }
  if (x.count < many_columns || a.rows <= piece_rows) {
    const Index together = a.rows > tall ? streams : a.count;
    for (Index j = 0; j < a.count; j += together) {
      const Index count = std::min(together, a.count - j);
      add({a.values + j * a.stride, a.rows, count, a.stride}, {x.values + j, count, x.count, x.stride}, y, y_stride);
    }
    return;
  }
  std::vector<double> panel(static_cast<std::size_t>(panel_rows * std::min(panel_columns, a.count)));
  for (Index row = 0; row < a.rows; row += panel_rows)
    for (Index j = 0; j < a.count; j += panel_columns) {
      const Index rows = std::min(panel_rows, a.rows - row), count = std::min(panel_columns, a.count - j);
      for (Index k = 0; k < count; ++k)
        for (Index i = 0; i < rows; i += piece_rows) {
          const Index piece = std::min(piece_rows, rows - i);
          const double* const from = a.values + row + i + (j + k) * a.stride;
          double* const to = panel.data() + i * count + k * piece;
          for (Index r = 0; r < piece; ++r) to[r] = from[r];
        }
      for (Index i = 0; i < rows; i += piece_rows) {
        const Index piece = std::min(piece_rows, rows - i);
        add({panel.data() + i * count, piece, count, piece}, {x.values + j, count, x.count, x.stride}, y + row + i,
            y_stride);
      }
    }
}

void add_products(const Columns& a, const Columns& x, std::span<const int> rows, Eigen::MatrixXd& y,
                  Eigen::MatrixXd& room) {
  const int first = rows.front();
  if (rows.back() - first + 1 == a.rows) return add_products(a, x, y.data() + first, y.rows());
  room.resize(a.rows, x.count);
  for (Index i = 0; i < a.rows; ++i) room.row(i) = y.row(rows[static_cast<std::size_t>(i)]);
  add_products(a, x, room.data(), a.rows);
  for (Index i = 0; i < a.rows; ++i) y.row(rows[static_cast<std::size_t>(i)]) = room.row(i);
}

Eigen::MatrixXd summed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(a.rows(), x.cols());
  add_products({a.data(), a.rows(), a.cols(), a.rows()}, {x.data(), x.rows(), x.cols(), x.rows()}, made.data(),
               made.rows());
  return made;
}

void add_scaled(std::span<const ScaledColumn> columns, Index rows, const double* weights, double* y) {
  if (has_wide_vectors())
    scale_by_wide_vectors(columns, rows, weights, y);
  else
    scale_all(columns, rows, weights, y);
}

}  // namespace pounding
