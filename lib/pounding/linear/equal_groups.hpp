#pragma once
/// Structures of a system with identical matrices.

#include <vector>

#include <pounding/model/system.hpp>

namespace pounding {

/// True if the diagonal blocks of two block-diagonal matrices are bitwise identical: `count` rows from the given ones
/// on.
bool equal_blocks(const SparseMatrix& a, int first_a, const SparseMatrix& b, int first_b, int count);

/// For each group, the index of the first group with bitwise identical masses, stiffness and rigid-body motions; its
/// own index if there is none before it.
std::vector<int> first_equal_groups(const System& system);

}  // namespace pounding
