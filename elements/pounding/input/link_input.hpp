#pragma once
/// The `links:` section of an input file.

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Adds the links of one entry of the section to the model, whose structures have been read. Throws InputError with the place.
void read_link(const Input& node, Model& model);

}  // namespace pounding
