#pragma once
/// The `structures:` section of an input file.

#include <string>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads one structure with its kind and common keys, and adds it to the model. Throws InputError with the location.
void read_structure(const std::string& name, const Input& location, Model& model);

}  // namespace pounding
