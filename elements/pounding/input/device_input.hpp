#pragma once
/// Reads devices between two structures and inside one.

#include <string>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads a device and adds it to the model, which already has its structures. Throws InputError.
void read_device(const std::string& name, const Input& node, Model& model);
/// Reads a device inside a structure of the model and adds it. Throws InputError.
void read_own_device(const std::string& name, const Input& node, const StructureHandle& structure, Model& model);

}  // namespace pounding
