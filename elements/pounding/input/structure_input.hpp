#pragma once
/// The `structures:` section of an input file.

#include <string>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Reads one structure, its kind and what stands beside it, and adds it to the model. Throws InputError with the place.
void read_structure(const std::string& name, const Input& location, Model& model);

}  // namespace pounding
