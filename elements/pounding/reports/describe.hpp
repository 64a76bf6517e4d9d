#pragma once
/// A summary of a model in text.

#include <string>

#include <pounding/model/model.hpp>

namespace pounding {

/// A model in a few lines, one each: title, ground motions, structures with floors, masses and first periods, links
/// with their laws, gaps and masses, devices.
std::string describe(const Model& model);

}  // namespace pounding
