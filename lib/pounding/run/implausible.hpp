#pragma once
/// Warnings about results that are far from those of real buildings, or beyond the capacity of a part.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/links/contact.hpp>
#include <pounding/reports/plausible.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {

/// Warnings about implausible results of this model, except those that the model suppresses.
inline std::vector<std::string> implausible(const Model& model, const Summary& summary) {
  std::vector<double> penetrations;
  // Soil deforms more than bodies overlap.
  for (std::size_t i = 0; i < summary.links.size(); ++i)
    penetrations.push_back(model.links[i].law == "backfill" ? 0 : summary.links[i].peak_penetration);
  // An unfinished run may still move; frames without floors have no such peaks.
  bool moved = summary.status != "done";
  std::size_t floors = 0;
  for (const StructureSummary& structure : summary.structures) {
    floors += structure.peak_displacement.size();
    moved = moved || std::any_of(structure.peak_displacement.begin(), structure.peak_displacement.end(),
                                 [](double peak) { return peak != 0; });
  }
  std::vector<std::string> texts = implausible(model, moved || floors == 0, penetrations);
  // A run that ends by collapse_drift reaches the drift that it allows.
  std::vector<std::vector<double>> drifts;
  for (const StructureSummary& structure : summary.structures) drifts.push_back(structure.peak_drift);
  if (model.analysis.collapse_drift > 0) drifts.clear();
  std::ranges::move(implausible_drifts(model, drifts), std::back_inserter(texts));
  return texts;
}

/// One line for each isolator that moved beyond its capacity.
inline std::vector<std::string> beyond_capacity(const Model& model, const Summary& summary) {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < summary.structures.size(); ++k)
    for (std::size_t i = 0; i < summary.structures[k].springs.size(); ++i) {
      const YieldingPart& part = model.structures[k].yielding[i];
      const SpringSummary& moved = summary.structures[k].springs[i];
      const std::string name = part.has_spring() ? part.name : part.name.substr(0, part.name.rfind(' '));
      if (const double capacity = part.parameter("capacity");
          isolates(part) && moved.resultant > capacity && part.direction == 0)
        texts.push_back(fmt::format(
            "structure {}, {}: {} at {:.4g} s exceeds the capacity of {}; the model is not valid beyond it. Type a "
            "larger "
            "capacity if the isolator has one, or a link to a wall with that gap if a stop limits it",
            model.structures[k].name, name, format_quantity(moved.resultant, dimension::length, 4),
            moved.resultant_time, format_quantity(capacity, dimension::length)));
    }
  return texts;
}

/// One line for each link that opened beyond its seat, unless the model suppresses them.
inline std::vector<std::string> unseated(const Model& model, const Summary& summary) {
  std::vector<std::string> texts;
  if (std::ranges::find(model.accept, "seat") != model.accept.end()) return texts;
  for (const LinkSummary& link : summary.links)
    if (link.unseated())
      texts.push_back(
          fmt::format("link {}: opens by {} at {:.4g} s, beyond its seat of {}; the supported end falls, and "
                      "the results after this time are not valid. Type a longer seat, or add a restrainer "
                      "(to suppress this warning: accept: [seat])",
                      link.name, format_quantity(link.largest_opening, dimension::length, 4), link.t_opening,
                      format_quantity(*link.seat, dimension::length)));
  return texts;
}

/// Number of impacts of a lossless rigid contact above which its bodies are considered pressed together.
inline constexpr int many_bounces = 10'000;

/// One line for each lossless rigid contact whose bodies are pressed together: they bounce at an ever higher frequency
/// and never come to rest.
inline std::vector<std::string> endless_bounces(const Model& model, const Summary& summary) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < summary.links.size(); ++i) {
    const Contact& contact = *model.links[i].contact;
    if (contact.is_rigid() && contact.restitution() == 1 && summary.links[i].impacts > many_bounces)
      texts.push_back(
          fmt::format("link {}: {} impacts; bodies that are pressed together bounce ever faster with restitution 1 and "
                      "never rest, and a run computes every bounce; type restitution: 0.95, or a law with a "
                      "stiffness if they should come to rest",
                      summary.links[i].name, summary.links[i].impacts));
  }
  return texts;
}

}  // namespace pounding
