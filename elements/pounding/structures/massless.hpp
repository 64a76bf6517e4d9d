#pragma once
/// Degrees of freedom with and without mass. Only those with mass are dynamic: they have inertia and modes. The
/// massless ones follow by static condensation, K_ss u_s = -K_sm u_m.

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace pounding {

/// Matrices of structures, in compressed column format.
using SparseMatrix = Eigen::SparseMatrix<double>;

/// Sparse matrix of these entries; duplicate entries are added.
template <class Matrix = SparseMatrix>
Matrix sparse_matrix(Eigen::Index rows, Eigen::Index columns, const std::vector<Eigen::Triplet<double>>& entries) {
  Matrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Adds the nonzero entries of a block whose first row and column is `first`.
inline void add_entries(std::vector<Eigen::Triplet<double>>& entries, const SparseMatrix& block, int first) {
  for (int j = 0; j < block.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(block, j); it; ++it)
      if (it.value() != 0) entries.emplace_back(first + static_cast<int>(it.row()), first + j, it.value());
}

/// Degrees of freedom by mass, both lists increasing.
struct MassSplit {
  std::vector<int> dynamic;   ///< with mass
  std::vector<int> massless;  ///< without
};

/// True if a degree of freedom has mass. The mass matrix column of a massless one is empty or zero.
bool has_mass(const SparseMatrix& mass, int dof);
/// Splits the degrees of freedom first .. first + count - 1, numbered from 0 at `first`.
MassSplit split_by_mass(const SparseMatrix& mass, int first, int count);
/// Splits all degrees of freedom.
MassSplit split_by_mass(const SparseMatrix& mass);

/// Submatrix of these rows and columns, in their order. Indices are relative to `first`, the first row and column of a
/// diagonal block; entries above the block are omitted.
SparseMatrix submatrix(const SparseMatrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns,
                       int first = 0);
/// submatrix() as a dense matrix.
Eigen::MatrixXd dense_submatrix(const SparseMatrix& matrix, const std::vector<int>& rows,
                                const std::vector<int>& columns, int first = 0);

}  // namespace pounding
