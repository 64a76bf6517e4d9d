#include <pounding/linear/equal_groups.hpp>

namespace pounding {

bool equal_blocks(const SparseMatrix& a, int first_a, const SparseMatrix& b, int first_b, int count) {
  for (int j = 0; j < count; ++j) {
    SparseMatrix::InnerIterator of_a(a, first_a + j), of_b(b, first_b + j);
    for (; of_a && of_b; ++of_a, ++of_b)
      if (of_a.row() - first_a != of_b.row() - first_b || of_a.value() != of_b.value()) return false;
    if (of_a || of_b) return false;
  }
  return true;
}

std::vector<int> first_equal_groups(const System& system) {
  const auto equal_groups = [&](const Group& a, const Group& b) {
    return a.count == b.count && a.rigid_motions == b.rigid_motions &&
           equal_blocks(system.mass, a.first, system.mass, b.first, a.count) &&
           equal_blocks(system.stiffness, a.first, system.stiffness, b.first, a.count);
  };
  std::vector<int> first;
  for (int k = 0; k < static_cast<int>(system.groups.size()); ++k) {
    int equal = 0;
    while (equal < k &&
           !(first[static_cast<std::size_t>(equal)] == equal && equal_groups(system.groups[equal], system.groups[k])))
      ++equal;
    first.push_back(equal);
  }
  return first;
}

}  // namespace pounding
