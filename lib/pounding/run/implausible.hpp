#pragma once
/// Warnings of numbers in the answers of a run that are far from those of buildings.

#include <string>
#include <vector>

#include <pounding/model/plausible.hpp>
#include <pounding/results/summary.hpp>

namespace pounding {

/// One line each, of a run of this model; none of those that the model accepts.
inline std::vector<std::string> implausible(const Model& model, const Summary& summary) {
  std::vector<double> penetrations;
  for (const LinkSummary& link : summary.links) penetrations.push_back(link.peak_penetration);
  return implausible(model, penetrations);
}

}  // namespace pounding
