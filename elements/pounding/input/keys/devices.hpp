#pragma once
/// Devices between two structures and inside one: devices.cpp.

#include <vector>

#include <pounding/input/keys/key.hpp>

namespace pounding::keys {

/// One entry of the model's devices, whose ends are those of links; one inside a structure; their parts.
extern const Section device, own_device, bar, damper;
/// Numbers and choices of each law of yielding of a device, in the order of the laws.
std::vector<const Section*> laws_of_devices();

}  // namespace pounding::keys
