#include <pounding/structures/massless.hpp>

#include <cstddef>

namespace pounding {
namespace {

// Calls add(row, column, value) for each entry of the submatrix, with indices of the submatrix.
template <class Add>
void for_each_entry(const SparseMatrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns,
                    int first, Add&& add) {
  std::vector<int> row_of(static_cast<std::size_t>(matrix.rows() - first), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) row_of[rows[i]] = static_cast<int>(i);
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, first + columns[j]); it; ++it)
      if (it.row() >= first && row_of[it.row() - first] >= 0)
        add(row_of[it.row() - first], static_cast<int>(j), it.value());
}

}  // namespace

bool has_mass(const SparseMatrix& mass, int dof) {
  for (SparseMatrix::InnerIterator it(mass, dof); it; ++it)
    if (it.value() != 0) return true;
  return false;
}

MassSplit split_by_mass(const SparseMatrix& mass, int first, int count) {
  MassSplit split;
  for (int i = 0; i < count; ++i) (has_mass(mass, first + i) ? split.dynamic : split.massless).push_back(i);
  return split;
}

MassSplit split_by_mass(const SparseMatrix& mass) { return split_by_mass(mass, 0, static_cast<int>(mass.cols())); }

SparseMatrix submatrix(const SparseMatrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns,
                       int first) {
  std::vector<Eigen::Triplet<double>> entries;
  for_each_entry(matrix, rows, columns, first,
                 [&](int row, int column, double value) { entries.emplace_back(row, column, value); });
  return sparse_matrix(static_cast<int>(rows.size()), static_cast<int>(columns.size()), entries);
}

Eigen::MatrixXd dense_submatrix(const SparseMatrix& matrix, const std::vector<int>& rows,
                                const std::vector<int>& columns, int first) {
  Eigen::MatrixXd part = Eigen::MatrixXd::Zero(static_cast<int>(rows.size()), static_cast<int>(columns.size()));
  for_each_entry(matrix, rows, columns, first, [&](int row, int column, double value) { part(row, column) = value; });
  return part;
}

}  // namespace pounding
