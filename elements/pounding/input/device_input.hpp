#pragma once
/// Reads devices between two structures and inside one.

#include <string>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads one device between two structures of the model and adds it. Throws InputError.
void read_device(const std::string& name, const Input& node, Model& model);
/// Reads one device inside a structure of the model and adds it. Throws InputError.
void read_own_device(const std::string& name, const Input& node, const StructureHandle& structure, Model& model);

}  // namespace pounding
