#pragma once
/// Eigen's vectors and matrices in an Archive.

#include <cstddef>
#include <stdexcept>

#include <Eigen/Core>

#include <pounding/core/archive.hpp>

namespace pounding {

/// Rows, columns and entries, column by column. Throws like Archive.
template <int Columns>
void archive_value(Archive& archive, Eigen::Matrix<double, Eigen::Dynamic, Columns>& m) {
  const std::size_t rows = archive.count(static_cast<std::size_t>(m.rows()));
  const std::size_t columns = archive.count(static_cast<std::size_t>(m.cols()));
  // Eigen checks neither the number of columns of a vector nor the number of bytes for the entries.
  const bool fits = Columns == Eigen::Dynamic || static_cast<Eigen::Index>(columns) == Columns;
  if (archive.reading() && (!fits || rows * columns > archive.bytes().size()))
    throw std::runtime_error("the saved state is damaged");
  m.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  archive.raw(m.data(), sizeof(double) * static_cast<std::size_t>(m.size()));
}

}  // namespace pounding
