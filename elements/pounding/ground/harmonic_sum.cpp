#include <pounding/ground/harmonic_sum.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/ground/closed_forms.hpp>
#include <pounding/ground/ground_motion.hpp>

namespace pounding {

double HarmonicSum::acceleration(double after_start) const noexcept {
  double sum = 0;
  for (const Part& part : parts)
    sum += part.amplitude * std::sin(2 * std::numbers::pi * after_start / part.period + part.phase);
  return sum;
}

double HarmonicSum::shortest_period() const noexcept {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Part& part : parts) shortest = std::min(shortest, part.period);
  return shortest;
}

double HarmonicSum::peak() const {
  constexpr double max_periods = 1e4, values_per_period = 64;
  const double periods = duration / shortest_period();
  if (periods > max_periods) {
    double sum = 0;
    for (const Part& part : parts) sum += std::abs(part.amplitude);
    return sum;
  }
  // The maximum between samples, from a parabola through three values.
  const auto count = std::max(4.0, std::ceil(periods * values_per_period));
  double before = acceleration(0), here = acceleration(duration / count);
  double largest = std::max(std::abs(before), std::abs(here));
  for (double i = 2; i <= count; ++i) {
    const double after = acceleration(i / count * duration), bend = before - 2 * here + after,
                 slope = (after - before) / 2;
    largest = std::max(largest, std::abs(after));
    if (std::abs(slope) <= std::abs(bend)) largest = std::max(largest, std::abs(here - slope * slope / (2 * bend)));
    before = here;
    here = after;
  }
  return largest;
}

GroundMotion::GroundMotion(HarmonicSum motion, const Dimension& values) {
  if (motion.parts.empty())
    throw std::invalid_argument("ground motion: a sum of harmonics must not be empty; give at least one harmonic");
  std::vector<std::string> texts;
  for (const auto& [amplitude, period, phase] : motion.parts) {
    closed_forms::require_finite(amplitude, "amplitude");
    closed_forms::require_positive(period, "period");
    closed_forms::require_finite(phase, "phase");
    texts.push_back(closed_forms::described(amplitude, period, phase, values));
  }
  closed_forms::require_positive(motion.duration, "duration");
  closed_forms::require_finite(motion.start, "start");
  peak_ = motion.peak();
  start_ = motion.start;
  duration_ = closed_forms::end_of(motion);
  const closed_forms::Moved largest = closed_forms::largest_of(motion);
  peak_velocity_ = largest.velocity;
  peak_displacement_ = largest.displacement;
  source_ = fmt::format("sum of harmonics, {}, for {:g} s", fmt::join(texts, ", "), motion.duration);
  motion_ = std::move(motion);
}

}  // namespace pounding
