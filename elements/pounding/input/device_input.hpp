#pragma once
/// Reading bars and dampers between two structures.

#include <string>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads one device, the node under its name, and adds it to the model, which has its structures. Throws InputError.
void read_device(const std::string& name, const Input& node, Model& model);

}  // namespace pounding
