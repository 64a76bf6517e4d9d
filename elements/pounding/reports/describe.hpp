#pragma once
/// A summary of a model in text.

#include <string>

#include <pounding/model/model.hpp>

namespace pounding {

/// A model in a few lines, one each: title, project, ground motions, structures with floors, masses and first periods,
/// links with their laws, gaps and masses, devices.
std::string describe(const Model& model);

/// One end of a link or device: "left.3", or "left, node b" for ends without a floor.
std::string end_name(const Model& model, const LinkEnd& end);

}  // namespace pounding
