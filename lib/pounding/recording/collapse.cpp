#include <pounding/recording/collapse.hpp>

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/results/spring_history.hpp>
#include <pounding/structures/storey_heights.hpp>

namespace pounding {
namespace {

// The yielded parts: up to six names, ordered by ductility.
std::string yielded_parts(const SpringHistory& springs) {
  constexpr std::size_t most_named = 6;
  std::vector<SpringSummary> all = summaries(springs);
  std::erase_if(all, [](const SpringSummary& part) { return !part.yielded(); });
  if (all.empty()) return "no parts yielded";
  std::ranges::stable_sort(all, std::ranges::greater{}, &SpringSummary::ductility);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(all.size(), most_named); ++i) names.push_back(all[i].name);
  return fmt::format("{} of {} parts yielded; largest ductility: {}", all.size(), springs.size(),
                     fmt::join(names, ", "));
}

}  // namespace

Collapse::Collapse(const Model& model, const FloorEnvelopes& floors, const std::vector<StructureHistory>& histories)
    : model_(model), floors_(floors), histories_(histories), limit_(model.analysis.collapse_drift) {
  if (is_requested())
    for (const Structure& s : model.structures) heights_.push_back(storey_heights(s));
}

bool Collapse::has_come() const { return is_requested() && worst().drift > limit_; }

Collapse::Worst Collapse::worst() const {
  Worst maximum;
  for (int k = 0; k < static_cast<int>(heights_.size()); ++k)
    for (int i = 0; i < static_cast<int>(heights_[k].size()); ++i)
      if (const double drift = floors_.peak_drift(k, i) / heights_[k][i]; drift > maximum.drift)
        maximum = {k, i, drift};
  return maximum;
}

std::string Collapse::text(double time) const {
  const Worst maximum = worst();
  const Structure& s = model_.structures[maximum.structure];
  return fmt::format(
      "collapse at t = {:.6g} s: storey {} of {} has drifted {:.3g} % of its height, more than the collapse_drift of "
      "{:.3g} %; {}",
      time, s.floors[maximum.storey].label, s.name, 100 * maximum.drift, 100 * limit_,
      yielded_parts(histories_[maximum.structure].springs));
}

}  // namespace pounding
