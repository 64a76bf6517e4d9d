#pragma once
/// The rows of a system on each process.

#include <vector>

#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// True if each process gets whole groups, because there are at least as many groups as processes.
bool shares_whole_groups(const System& system, int processes);

/// First row of each process, and last the number of all rows: length processes + 1. Whole groups, by the entries of
/// their stiffness, where shares_whole_groups; else even parts.
std::vector<int> first_rows(const System& system, int processes);

}  // namespace pounding::petsc
