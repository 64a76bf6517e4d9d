#include <pounding/ground/harmonic_sum.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pounding {

double HarmonicSum::acceleration(double after_start) const noexcept {
  double sum = 0;
  for (const Part& part : parts) sum += part.amplitude * std::sin(2 * std::numbers::pi * after_start / part.period + part.phase);
  return sum;
}

double HarmonicSum::shortest_period() const noexcept {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Part& part : parts) shortest = std::min(shortest, part.period);
  return shortest;
}

double HarmonicSum::peak() const {
  constexpr double most_periods = 1e4, values_per_period = 64;
  const double periods = duration / shortest_period();
  if (periods > most_periods) {
    double sum = 0;
    for (const Part& part : parts) sum += std::abs(part.amplitude);
    return sum;
  }
  // A parabola through three values finds the crest between them.
  const auto count = std::max(4.0, std::ceil(periods * values_per_period));
  double before = acceleration(0), here = acceleration(duration / count);
  double largest = std::max(std::abs(before), std::abs(here));
  for (double i = 2; i <= count; ++i) {
    const double after = acceleration(i / count * duration), bend = before - 2 * here + after, slope = (after - before) / 2;
    largest = std::max(largest, std::abs(after));
    if (std::abs(slope) <= std::abs(bend)) largest = std::max(largest, std::abs(here - slope * slope / (2 * bend)));
    before = here;
    here = after;
  }
  return largest;
}

}  // namespace pounding
