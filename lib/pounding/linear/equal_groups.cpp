#include <pounding/linear/equal_groups.hpp>

namespace pounding {
namespace {

// Compares diagonal blocks of a matrix.
bool equal_blocks(const SparseMatrix& matrix, const Group& a, const Group& b) {
  for (int j = 0; j < a.count; ++j) {
    SparseMatrix::InnerIterator of_a(matrix, a.first + j), of_b(matrix, b.first + j);
    for (; of_a && of_b; ++of_a, ++of_b)
      if (of_a.row() - a.first != of_b.row() - b.first || of_a.value() != of_b.value()) return false;
    if (of_a || of_b) return false;
  }
  return true;
}

bool equal_groups(const System& system, const Group& a, const Group& b) {
  return a.count == b.count && a.rigid_motions == b.rigid_motions && equal_blocks(system.mass, a, b) &&
         equal_blocks(system.stiffness, a, b);
}

}  // namespace

std::vector<int> first_equal_groups(const System& system) {
  std::vector<int> first;
  for (int k = 0; k < static_cast<int>(system.groups.size()); ++k) {
    int equal = 0;
    while (equal < k && !(first[static_cast<std::size_t>(equal)] == equal &&
                          equal_groups(system, system.groups[equal], system.groups[k])))
      ++equal;
    first.push_back(equal);
  }
  return first;
}

}  // namespace pounding
