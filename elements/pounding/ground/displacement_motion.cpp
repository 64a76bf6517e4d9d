#include <pounding/ground/displacement_motion.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace pounding {
namespace {

// Throws for invalid harmonics, in metres as well as in m/s^2.
template <class Harmonics>
void check(const Harmonics& displacement) {
  static_cast<void>(GroundMotion(displacement));
  if (displacement.start != 0) throw std::invalid_argument("ground motion: displacement harmonics must start at 0");
}

// Exactly zero at a phase of 90 degrees, at which the ground starts from rest.
double cosine(double phase) {
  const double value = std::cos(phase);
  return std::abs(value) < 4 * std::numeric_limits<double>::epsilon() ? 0 : value;
}

}  // namespace

GroundMotion motion_of_displacement(const HarmonicSum& displacement) {
  check(displacement);
  HarmonicSum accelerations = displacement;
  double velocity = 0, offset = 0;
  for (HarmonicSum::Part& part : accelerations.parts) {
    const double w = 2 * std::numbers::pi / part.period;
    velocity += part.amplitude * w * cosine(part.phase);
    offset += part.amplitude * std::sin(part.phase);
    part.amplitude *= -w * w;
  }
  return GroundMotion(std::move(accelerations)).with_initial_motion(velocity, offset);
}

GroundMotion motion_of_displacement(const Harmonic& displacement) {
  check(displacement);
  const auto& [amplitude, period, duration, start, phase] = displacement;
  const double w = 2 * std::numbers::pi / period;
  return GroundMotion(Harmonic{-w * w * amplitude, period, duration, start, phase})
      .with_initial_motion(amplitude * w * cosine(phase), amplitude * std::sin(phase));
}

std::vector<double> spline_accelerations(const std::vector<double>& times, const std::vector<double>& displacements,
                                         double initial_velocity) {
  const std::size_t count = times.size();
  if (count < 2 || displacements.size() != count)
    throw std::invalid_argument(
        fmt::format("ground motion: {} times and {} displacements; equal numbers, at least two, are needed", count,
                    displacements.size()));
  for (std::size_t i = 1; i < count; ++i)
    if (!(times[i] > times[i - 1]))
      throw std::invalid_argument(
          fmt::format("ground motion: the time of sample {} must be later than the previous one", i));

  // The velocity is continuous at each sample:
  //   h/6 a[i-1] + (h + k)/3 a[i] + k/6 a[i+1] = slope of the chord after it - slope of the chord before it,
  // where h and k are the intervals before and after it. Elimination from the left; the last acceleration is zero.
  std::vector<double> ratio(count), a(count);
  double before = initial_velocity, h = 0;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double k = times[i + 1] - times[i], after = (displacements[i + 1] - displacements[i]) / k;
    const double pivot = (h + k) / 3 - (i > 0 ? h / 6 * ratio[i - 1] : 0);
    ratio[i] = k / 6 / pivot;
    a[i] = (after - before - (i > 0 ? h / 6 * a[i - 1] : 0)) / pivot;
    before = after;
    h = k;
  }
  for (std::size_t i = count - 1; i-- > 0;) a[i] -= ratio[i] * a[i + 1];
  return a;
}

GroundMotion motion_of_displacement(const std::vector<double>& times, const std::vector<double>& displacements,
                                    double initial_velocity, std::string source) {
  Samples samples{times, spline_accelerations(times, displacements, initial_velocity), evenly_spaced(times)};
  return GroundMotion(std::move(samples), std::move(source))
      .with_initial_motion(initial_velocity, displacements.front() - initial_velocity * times.front());
}

}  // namespace pounding
