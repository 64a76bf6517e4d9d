#include <pounding/run/reduction_check.hpp>

#include <algorithm>
#include <cmath>

#include <pounding/model/reducible.hpp>
#include <pounding/run/window_steps.hpp>

namespace pounding {
namespace {

double over(double difference, double largest) { return difference > 0 ? difference / largest : difference; }

}  // namespace

ReductionCheck::ReductionCheck(const Model& model, const FloorResponse& response, const StepView& stepper)
    : model_(model),
      stepper_(stepper),
      checked_([&] {
        std::vector<Checked> checked;
        int group = -1;
        for (int k = 0; k < static_cast<int>(model.structures.size()); ++k) {
          const Structure& s = model.structures[static_cast<std::size_t>(k)];
          if (s.is_rigid()) continue;
          ++group;
          if (reduction_of(model, k).check &&
              std::ranges::count(stepper.base().layout().reduced, s.name, &ReducedStructure::name) > 0)
            checked.push_back({.structure = k, .group = group, .rows = response.translations(k)});
        }
        return checked;
      }()),
      windows_(stepper, contacts_that_count()) {}

std::vector<bool> ReductionCheck::contacts_that_count() const {
  std::vector<bool> counts(static_cast<std::size_t>(stepper_.system().contact_count()));
  for (std::size_t i = 0; i < counts.size(); ++i)
    counts[i] = std::ranges::any_of(checked_, [&](const Checked& one) { return model_.links[i].hits(one.structure); });
  return counts;
}

void ReductionCheck::step() {
  if (!checked_.empty()) windows_.step();
}

bool ReductionCheck::next() {
  windows_.end();
  const std::size_t structures = checked_.size(), all = structures * windows_.hardest().size();
  if (done_ == all) return false;
  const ImpactWindow& window = windows_.hardest()[done_ / structures];
  Checked& one = checked_[done_ % structures];
  const WindowDifferences found =
      differences_in_window(stepper_.system(), stepper_.base(), one.group, one.rows, window);
  if (found.outputs.size() > 0) one.displacement = std::max(one.displacement, found.outputs.cwiseAbs().maxCoeff());
  if (done_ % structures == 0) {
    closings_ = found.closings;
    rates_ = found.rates;
  } else {
    closings_ += found.closings;
    rates_ += found.rates;
  }
  if (++done_ % structures == 0) compare_forces(window);
  return done_ < all;
}

void ReductionCheck::compare_forces(const ImpactWindow& window) {
  const Eigen::Index contacts = closings_.rows(), steps = closings_.cols();
  Eigen::VectorXd peak = Eigen::VectorXd::Zero(contacts), of_all = peak;
  for (Eigen::Index k = 0; k < steps; ++k)
    for (const ImpactWindow::Force& f : window.steps[static_cast<std::size_t>(k)].forces) {
      if (f.link >= contacts) continue;
      // Positive differences in closing are penetrations that the modes miss.
      const double difference = f.by_penetration * closings_(f.link, k) + f.by_rate * rates_(f.link, k);
      peak[f.link] = std::max(peak[f.link], f.end);
      of_all[f.link] = std::max(of_all[f.link], f.end + difference);
    }
  for (Checked& one : checked_)
    for (Eigen::Index i = 0; i < contacts; ++i)
      if (peak[i] > 0 && model_.links[static_cast<std::size_t>(i)].hits(one.structure))
        one.force = std::fmax(one.force, std::abs(peak[i] - of_all[i]));
}

void ReductionCheck::tell(const Summary& summary, std::vector<ReducedStructure>& reduced) const {
  double peak_force = 0;
  for (const LinkSummary& link : summary.links) peak_force = std::fmax(peak_force, link.peak_force);
  for (const Checked& one : checked_) {
    const StructureSummary& s = summary.structures[static_cast<std::size_t>(one.structure)];
    ReducedStructure& reported = *std::ranges::find(reduced, s.name, &ReducedStructure::name);
    reported.checked_windows = static_cast<int>(done_ / checked_.size());
    if (reported.checked_windows == 0) continue;
    reported.check_force = over(one.force, peak_force);
    if (!one.rows.empty() && !s.peak_displacement.empty())
      reported.check_displacement = over(one.displacement, *std::ranges::max_element(s.peak_displacement));
  }
}

}  // namespace pounding
