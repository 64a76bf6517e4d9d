#include <pounding/frames/member_unknowns.hpp>

#include <algorithm>

namespace pounding {

MemberUnknowns::MemberUnknowns(const AssembledFrame& assembled, int start, int end) {
  const std::span<const Dof> dofs = dofs_of(assembled.dimension);
  const int count = static_cast<int>(dofs.size());
  using Transform = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  for (const int side : {0, 1})
    for (int at = 0; at < count; ++at)
      for (Transform::InnerIterator it(assembled.transform, (side == 0 ? start : end) * count + at); it; ++it)
        rows_.emplace_back(6 * side + static_cast<int>(dofs[static_cast<std::size_t>(at)]), static_cast<int>(it.col()),
                           it.value());
}

void MemberUnknowns::add_entries(const Matrix12& matrix, std::vector<Eigen::Triplet<double>>& entries) const {
  for (const auto& a : rows_)
    for (const auto& b : rows_)
      entries.emplace_back(a.col(), b.col(), a.value() * matrix(a.row(), b.row()) * b.value());
}

void MemberUnknowns::find_places(const Eigen::SparseMatrix<double>& of_frame) {
  places_.clear();
  for (const auto& b : rows_)
    for (const auto& a : rows_) {
      const int* const column = of_frame.innerIndexPtr() + of_frame.outerIndexPtr()[b.col()];
      const int* const end = of_frame.innerIndexPtr() + of_frame.outerIndexPtr()[b.col() + 1];
      places_.push_back(static_cast<int>(std::lower_bound(column, end, a.col()) - of_frame.innerIndexPtr()));
    }
}

}  // namespace pounding
