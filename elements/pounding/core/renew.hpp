#pragma once
/// Room to work in whose size changes during a run.

#include <optional>

#include <Eigen/Core>

namespace pounding {

/// Gives a matrix a size; its entries are lost if that is another one. Eigen 3.4 frees the old entries in `resize`,
/// `setZero` and assignments, and once more in the destructor when there was no memory for the new ones; here the
/// matrix is empty in between. Throws std::bad_alloc.
template <class Matrix>
void renew(Matrix& m, Eigen::Index rows, Eigen::Index columns) {
  if (m.rows() == rows && m.cols() == columns) return;
  if (m.size() != rows * columns) m = Matrix();
  m.resize(rows, columns);
}

/// A vector likewise.
template <class Vector>
void renew(Vector& v, Eigen::Index size) {
  if (v.size() == size) return;
  v = Vector();
  v.resize(size);
}

/// Makes a factor with room for matrices of this size; none is left where there is no memory. Throws std::bad_alloc.
template <class Factor>
void renew_factor(std::optional<Factor>& factor, Eigen::Index size) {
  // Made in its place: one that has not factorized yet has members without a value, which must not be moved.
  if (!factor || factor->rows() != size) factor.emplace(size);
}

}  // namespace pounding
