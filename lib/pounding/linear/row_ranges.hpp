#pragma once
/// Distribution of the rows of a system over processes.

#include <vector>

#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// True if each process gets whole groups: there are at least as many groups as processes.
bool shares_whole_groups(const System& system, int processes);

/// First row of each process, and the total number of rows: length processes + 1. With shares_whole_groups(), whole
/// groups are balanced by the nonzeros of their stiffness; otherwise the rows are divided evenly.
std::vector<int> first_rows(const System& system, int processes);

}  // namespace pounding::petsc
