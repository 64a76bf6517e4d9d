#include <pounding/linear/damping_matrix.hpp>

#include <vector>

#include <pounding/structures/damping.hpp>

namespace pounding::petsc {

SparseMatrix damping_matrix(const System& system) {
  SparseMatrix all = system.formed_damping();
  std::vector<Eigen::Triplet<double>> entries;
  for (const Group& group : system.groups) {
    if (group.modal_ratio == 0 || system.has_modal_matrix(group)) continue;
    const auto part = [&](const SparseMatrix& whole) {
      return SparseMatrix(whole.block(group.first, group.first, group.count, group.count));
    };
    const SparseMatrix own = modal_damping_matrix(part(system.mass), part(system.stiffness), group.modal_ratio);
    for (int j = 0; j < own.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(own, j); it; ++it)
        entries.emplace_back(group.first + static_cast<int>(it.row()), group.first + j, it.value());
  }
  if (entries.empty()) return all;
  SparseMatrix modal(system.size(), system.size());
  modal.setFromTriplets(entries.begin(), entries.end());
  return all.size() > 0 ? SparseMatrix(all + modal) : modal;
}

}  // namespace pounding::petsc
