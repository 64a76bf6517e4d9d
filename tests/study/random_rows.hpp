#pragma once
/// Random pairs of oscillators with every penalty law, by the study kernel and by the solver of runs.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/elements.hpp>
#include <pounding/run/run.hpp>
#include <pounding/study/kernel.hpp>
#include <pounding/study/modal_form.hpp>

namespace pounding::study {

/// Maximum relative differences of two results for the same model.
struct Differences {
  double displacement = 0, force = 0, impulse = 0, energy = 0,
         acceleration = 0;  ///< drifts are compared as displacements, penetrations as forces
  int impacts = 0, more_impacts = 0;
  double worst() const { return std::max({displacement, force, impulse, energy, acceleration}); }
};

/// The quantities common to both results: displacements, drifts and accelerations of all structures, and links.
struct Answer {
  std::vector<double> displacements, accelerations;
  std::vector<LinkPeaks> links;
};

inline double apart(double a, double b) { return a == b ? 0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b)); }

inline Differences differences(const Answer& a, const Answer& b) {
  if (a.displacements.size() != b.displacements.size() || a.accelerations.size() != b.accelerations.size() ||
      a.links.size() != b.links.size())
    throw std::logic_error("two results for the same model have different numbers of quantities");
  Differences all;
  for (std::size_t i = 0; i < a.displacements.size(); ++i)
    all.displacement = std::max(all.displacement, apart(a.displacements[i], b.displacements[i]));
  for (std::size_t i = 0; i < a.accelerations.size(); ++i)
    all.acceleration = std::max(all.acceleration, apart(a.accelerations[i], b.accelerations[i]));
  for (std::size_t l = 0; l < a.links.size(); ++l) {
    const LinkPeaks &p = a.links[l], &q = b.links[l];
    all.impacts += q.impacts, all.more_impacts += std::abs(p.impacts - q.impacts);
    all.force = std::max({all.force, apart(p.peak_force, q.peak_force), apart(p.peak_penetration, q.peak_penetration)});
    all.impulse = std::max(all.impulse, apart(p.impulse, q.impulse));
    // A spring loses no energy beyond round-off.
    if (std::max(std::abs(p.energy_lost), std::abs(q.energy_lost)) > 1e-3 * p.peak_force * p.peak_penetration)
      all.energy = std::max(all.energy, apart(p.energy_lost, q.energy_lost));
  }
  return all;
}

inline Answer by_kernel(const Model& model, double tolerance) {
  const Samples& samples = *model.ground.components[0].samples();
  const LinearModel modes = modal_form(model, true);
  const Peaks peaks = run(modes, {.accelerations = samples.accelerations, .step = samples.times[1]},
                          {.duration = model.analysis.duration, .tolerance = tolerance});
  Answer answer{.displacements = {}, .accelerations = {}, .links = peaks.links};
  for (std::size_t i = 0; i < peaks.outputs.size(); ++i)
    (modes.outputs[i].kind == Output::Kind::acceleration ? answer.accelerations : answer.displacements)
        .push_back(peaks.outputs[i]);
  return answer;
}

/// At the tolerance of the model, which must be complete.
inline Answer by_solver(const Model& model) {
  const Summary summary = pounding::run(model, {.numbers_only = true}).summary;
  Answer answer;
  for (const StructureSummary& s : summary.structures) {
    answer.displacements.insert(answer.displacements.end(), s.peak_displacement.begin(), s.peak_displacement.end());
    answer.displacements.insert(answer.displacements.end(), s.peak_drift.begin(), s.peak_drift.end());
    answer.accelerations.insert(answer.accelerations.end(), s.peak_acceleration.begin(), s.peak_acceleration.end());
  }
  for (const LinkSummary& link : summary.links)
    answer.links.push_back({.impacts = static_cast<int>(link.impacts),
                            .peak_force = link.peak_force,
                            .peak_penetration = link.peak_penetration,
                            .impulse = link.impulse,
                            .energy_lost = link.energy_lost});
  return answer;
}

/// Ten seconds of ground motion at 0.02 s, with several frequencies and phases from `phase`.
inline Samples shaking(double phase) {
  Samples samples;
  for (int i = 0; i <= 500; ++i) {
    const double t = 0.02 * i;
    samples.times.push_back(t);
    samples.accelerations.push_back(
        std::sin(0.3 * t) * (2.5 * std::sin(4.3 * t + phase) + 2 * std::sin(9.1 * t + 2 * phase) + std::sin(23 * t)));
  }
  samples.uniform = true;
  return samples;
}

/// One row: laws take turns; the rest depends on seed and number only.
class RandomRow {
 public:
  RandomRow(unsigned seed, unsigned number) : entry_(entry(number)) {
    std::seed_seq both{seed, number};
    std::mt19937 engine(both);
    const auto u = [&] { return static_cast<double>(engine()) / 4294967296.0; };
    t1_ = 0.2 * std::pow(10, u()), t2_ = 0.2 * std::pow(10, u()), m2_ = m1_ * std::pow(4, u() - 0.5);
    gap_ = 0.04 * u() * u(), phase_ = 6 * u();
    settings_ = laws::typical_settings(entry_);
    settings_.reduced_mass = m1_ * m2_ / (m1_ + m2_);
    const std::string_view first = entry_.parameters[0].name;
    const double factor = std::pow(4, u() - 0.5);
    for (auto& [name, value] : settings_.values)
      if (name == first || name.starts_with(fmt::format("{}[", first))) value *= factor;  // all items of a list
    if (settings_.restitution) settings_.restitution = 0.4 + 0.5 * u();
    // adams_impact integrates impacts at every touch to meet a restitution, which costs a hundred times the rest: one
    // row in twenty does so.
    if (entry_.name == "adams_impact" && u() < 0.95) {
      settings_.restitution.reset();
      settings_.values.emplace("damping_coefficient", 6e5 * std::pow(4, u() - 0.5));
    }
  }

  std::string_view law() const { return entry_.name; }

  /// A complete model that has not been run.
  Model model(double tolerance) const {
    Model model;
    const auto left = model.add("left", make_oscillator({.mass = m1_, .period = t1_, .damping_ratio = 0.05}));
    const auto right = model.add("right", make_oscillator({.mass = m2_, .period = t2_, .damping_ratio = 0.05}));
    model.link(left.floor(1), right.floor(1), {.gap = gap_}, laws::make_law(settings_));
    model.ground = GroundMotion(shaking(phase_));
    model.analysis = {.duration = 10, .tolerance = tolerance};
    model.complete();
    return model;
  }

 private:
  static const laws::Entry& entry(unsigned number) {
    static const std::vector<const laws::Entry*> penalty = [] {
      std::vector<const laws::Entry*> all;
      for (const laws::Entry& entry : laws::catalogue())
        if (!entry.instantaneous) all.push_back(&entry);
      return all;
    }();
    return *penalty[number % penalty.size()];
  }

  const laws::Entry& entry_;
  double t1_, t2_, m1_ = 1e5, m2_, gap_, phase_;
  laws::Settings settings_;
};

/// The value below which this fraction of the values lies.
inline double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

}  // namespace pounding::study
