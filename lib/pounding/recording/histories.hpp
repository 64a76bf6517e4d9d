#pragma once
/// Link forces inside a step; truncation of histories that grow independently of the output times.

#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/tables.hpp>
#include <pounding/stepping/links/link_set.hpp>

namespace pounding {

/// Force of a yielding part inside its last accepted step, at a deformation [m], as by Spring::evaluate() [N].
inline double spring_force(const LinkSet& links, int link, const LinkStep& step, double time, double deformation) {
  return links.inside(link, step, (time - step.begin) / (step.end - step.begin), deformation).force;
}

/// Contribution of yielding parts and devices to the shear of a storey that is a spring [N]; `force(part)` is the force
/// of a part [N].
template <class ForceOf>
double shear_by_devices(const Floor& floor, const ForceOf& force) {
  double sum = 0;
  if (!floor.storey_shear_by_yielding.empty())
    for (Row::InnerIterator it(floor.storey_shear_by_yielding.front()); it; ++it)
      sum += it.value() * force(static_cast<std::size_t>(it.index()));
  return sum;
}

/// Writes the length of the histories of an object over the time of a group, or truncates them to it when reading.
/// Throws std::runtime_error if they are shorter.
template <class T>
void archive_length(Archive& archive, const tables::Table<T>& table, T& object, std::string_view group,
                    const std::vector<double>& time) {
  std::size_t length = time.size();
  archive(length);
  if (length > time.size()) throw std::runtime_error("a history is shorter than it was");
  tables::cut_histories(table, object, group, length);
}

}  // namespace pounding
