#pragma once
/// Structures of a system that are built alike.

#include <vector>

#include <pounding/model/system.hpp>

namespace pounding {

/// For each group the number of the first one with the same masses, stiffness and rigid motions, to the last bit: its
/// own where there is none before it.
std::vector<int> first_equal_groups(const System& system);

}  // namespace pounding
