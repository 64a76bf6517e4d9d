#pragma once
/// Structures of a system with identical matrices.

#include <vector>

#include <pounding/model/system.hpp>

namespace pounding {

/// For each group, the index of the first group with bitwise identical masses, stiffness and rigid-body motions; its
/// own index if there is none before it.
std::vector<int> first_equal_groups(const System& system);

}  // namespace pounding
