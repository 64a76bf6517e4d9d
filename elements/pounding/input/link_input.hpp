#pragma once
/// The `links:` section of an input file.

#include <utility>

#include <pounding/input/input.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Adds the links of one entry of the section to the model, which already has its structures. Throws InputError with
/// the location.
void read_link(const Input& node, Model& model);

/// The two ends under `between`, the left one first. Throws InputError.
std::pair<ContactLocation, ContactLocation> read_ends(const Input& between, const Model& model);

}  // namespace pounding
