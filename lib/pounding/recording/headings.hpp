#pragma once
/// Entries of a results file before any history: names, geometry, laws.

#include <pounding/model/model.hpp>
#include <pounding/results/results.hpp>

namespace pounding {

/// A structure, without its yielding parts.
StructureHistory heading(const Structure& s);
/// The yielding parts of a structure, all elastic.
SpringHistory spring_heading(const Structure& s);
/// A link of a model.
LinkHistory heading(const Link& link, const Model& model);
/// A device between two structures of a model.
DeviceHistory heading(const Device& device, const Model& model);

/// All structures, links and devices of a model without output times, for pictures of a model that was not run.
Results results_at_rest(const Model& model);

}  // namespace pounding
