#include <pounding/linear/column_sums.hpp>

#include <pounding/linear/wide_vectors.hpp>

namespace pounding {
namespace {

#ifdef POUNDING_HAS_FOUR
// 4 `blocks` rows from `row` on; the sums stay in registers.
template <int blocks>
POUNDING_INLINE Eigen::Index sum_rows(const double* a, Eigen::Index rows, Eigen::Index columns, const double* x, double* y, Eigen::Index row) {
  for (; row + 4 * blocks <= rows; row += 4 * blocks) {
    Four sum[blocks] = {};
    const double* of = a + row;
    for (Eigen::Index j = 0; j < columns; ++j, of += rows) {
      const Four factor{x[j], x[j], x[j], x[j]};
#pragma GCC unroll 4
      for (int k = 0; k < blocks; ++k) sum[k] += *reinterpret_cast<const Four*>(of + 4 * k) * factor;
    }
#pragma GCC unroll 4
    for (int k = 0; k < blocks; ++k) *reinterpret_cast<Four*>(y + row + 4 * k) = sum[k];
  }
  return row;
}
#else
template <int blocks>
Eigen::Index sum_rows(const double*, Eigen::Index, Eigen::Index, const double*, double*, Eigen::Index row) {
  return row;
}
#endif

POUNDING_INLINE void sum_all(const double* a, Eigen::Index rows, Eigen::Index columns, const double* x, double* y) {
  Eigen::Index row = sum_rows<4>(a, rows, columns, x, y, 0);
  row = sum_rows<2>(a, rows, columns, x, y, row);
  row = sum_rows<1>(a, rows, columns, x, y, row);
  for (; row < rows; ++row) {
    double sum = 0;
    for (Eigen::Index j = 0; j < columns; ++j) sum += a[row + j * rows] * x[j];
    y[row] = sum;
  }
}

POUNDING_WIDE void sum_by_wide_vectors(const double* a, Eigen::Index rows, Eigen::Index columns, const double* x, double* y) {
  sum_all(a, rows, columns, x, y);
}

}  // namespace

void sum_columns(const Eigen::MatrixXd& a, const double* x, double* y) {
  if (has_wide_vectors())
    sum_by_wide_vectors(a.data(), a.rows(), a.cols(), x, y);
  else
    sum_all(a.data(), a.rows(), a.cols(), x, y);
}

}  // namespace pounding
