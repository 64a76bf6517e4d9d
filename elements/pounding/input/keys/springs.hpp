#pragma once
/// The laws by which storeys yield: springs.cpp.

#include <vector>

#include <pounding/input/keys/key.hpp>

namespace pounding::keys {

/// The law of the storeys by its name.
extern const Section storey_spring;
/// Numbers and choices of each law, in the order of their list. The stiffness is that of the storey.
std::vector<const Section*> laws_of_springs();

}  // namespace pounding::keys
