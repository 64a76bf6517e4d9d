#include <pounding/linear/row_ranges.hpp>

#include <cmath>

namespace pounding::petsc {
namespace {

// Boundaries between groups that balance the nonzeros of the stiffness matrix.
std::vector<int> rows_by_groups(const System& system, int processes) {
  const int groups = static_cast<int>(system.groups.size());
  std::vector<double> entries(groups + 1, 0.0);
  for (int k = 0; k < groups; ++k) {
    const Group& group = system.groups[k];
    entries[k + 1] = entries[k] + 1;
    for (int j = group.first; j < group.first + group.count; ++j)
      for (SparseMatrix::InnerIterator it(system.stiffness, j); it; ++it) entries[k + 1] += 1;
  }
  std::vector<int> first{0};
  int border = 0;
  for (int r = 1; r < processes; ++r) {
    const double even = entries[groups] * r / processes;
    ++border;
    while (border < groups - (processes - r) && std::abs(entries[border + 1] - even) < std::abs(entries[border] - even))
      ++border;
    first.push_back(system.groups[border].first);
  }
  first.push_back(system.size());
  return first;
}

}  // namespace

bool shares_whole_groups(const System& system, int processes) {
  return static_cast<int>(system.groups.size()) >= processes;
}

std::vector<int> first_rows(const System& system, int processes) {
  if (shares_whole_groups(system, processes)) return rows_by_groups(system, processes);
  std::vector<int> first;
  for (int r = 0; r <= processes; ++r)
    first.push_back(static_cast<int>(static_cast<long>(system.size()) * r / processes));
  return first;
}

}  // namespace pounding::petsc
