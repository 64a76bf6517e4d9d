#pragma once
/// Hinges of frames: hinges.cpp.

#include <vector>

#include <pounding/input/keys/key.hpp>

namespace pounding::keys {

/// One entry of a frame's hinges.
extern const Section hinge;
/// Keys of a spring in series by its law, in the order of the laws.
std::vector<const Section*> laws_of_hinges();

}  // namespace pounding::keys
