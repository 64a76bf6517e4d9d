#pragma once
/// Degrees of freedom with and without mass. Only those with mass are dynamic: they have inertia and modes of their
/// own. The massless ones follow them by the stiffness, K_ss u_s = -K_sm u_m.

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace pounding {

/// The matrices of structures, column by column.
using SparseMatrix = Eigen::SparseMatrix<double>;

/// The matrix of these entries; entries at the same place are added.
template <class Matrix = SparseMatrix>
Matrix sparse_matrix(Eigen::Index rows, Eigen::Index columns, const std::vector<Eigen::Triplet<double>>& entries) {
  Matrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Degrees of freedom by their mass, both lists increasing.
struct MassSplit {
  std::vector<int> dynamic;   ///< with mass
  std::vector<int> massless;  ///< without
};

/// Whether a degree of freedom has mass. One without has an empty column in the mass matrix, or one of zeros.
bool has_mass(const SparseMatrix& mass, int dof);
/// The split of the degrees of freedom first .. first + count - 1, numbered from 0 at `first`.
MassSplit split_by_mass(const SparseMatrix& mass, int first, int count);
/// The split of all degrees of freedom.
MassSplit split_by_mass(const SparseMatrix& mass);

/// The entries of a matrix at these rows and columns, in their order. Both count from `first`, the first row and column
/// of a block on the diagonal: entries above the block are left out.
SparseMatrix submatrix(const SparseMatrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns,
                       int first = 0);
/// As submatrix, as a dense matrix.
Eigen::MatrixXd dense_submatrix(const SparseMatrix& matrix, const std::vector<int>& rows,
                                const std::vector<int>& columns, int first = 0);

}  // namespace pounding
