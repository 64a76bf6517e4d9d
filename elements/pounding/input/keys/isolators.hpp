#pragma once
/// Isolators under frames and shear buildings: isolators.cpp.

#include <vector>

#include <pounding/input/keys/key.hpp>

namespace pounding::keys {

/// The isolators of a foot, or all of a shear building.
extern const Section isolator;
/// Keys of an isolator by its law, in the order of the laws. They are called isolator_LAW.
std::vector<const Section*> laws_of_isolators();

}  // namespace pounding::keys
