#pragma once
/// Reading devices between two structures and inside one.

#include <string>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads one device, the node under its name, and adds it to the model, which has its structures. Throws InputError.
void read_device(const std::string& name, const Input& node, Model& model);
/// Likewise inside a structure, which the model has.
void read_own_device(const std::string& name, const Input& node, const StructureHandle& structure, Model& model);

}  // namespace pounding
