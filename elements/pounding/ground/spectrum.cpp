#include <pounding/ground/spectrum.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/core/limits.hpp>

namespace pounding {
namespace {

/// A linear piece of the ground acceleration.
struct Line {
  double duration;  ///< [s]
  double a0, a1;    ///< just after its start and just before its end [m/s^2]
};

/// The motion as linear pieces; a jump at a break remains a jump between two pieces.
std::vector<Line> straight_lines(const GroundMotion& motion) {
  constexpr double lines_per_period = 720;
  std::vector<Line> lines;
  double begin = motion.next_break(-std::numeric_limits<double>::infinity());
  for (double end; (end = motion.next_break(begin)) < std::numeric_limits<double>::infinity(); begin = end) {
    const double count = std::max(1.0, std::ceil((end - begin) / motion.shortest_period() * lines_per_period));
    double from = begin;
    for (double i = 1; i <= count; ++i) {
      const double to = i < count ? begin + (end - begin) * (i / count) : end;
      lines.push_back({to - from, motion.acceleration(from), motion.acceleration_before(to)});
      from = to;
    }
  }
  return lines;
}

/// Maximum |displacement| of the cubic through both end states, if the velocity changes sign inside the step.
double peak_between(const OscillatorState& begin, const OscillatorState& end, double h) {
  const double ends = std::max(std::abs(begin.displacement), std::abs(end.displacement));
  if (begin.velocity * end.velocity >= 0) return ends;
  // u = u0 + h (v0 s + b s^2 + c s^3), 0 <= s <= 1; its slope v0 + 2 b s + 3 c s^2 changes sign exactly once.
  const double mean = (end.displacement - begin.displacement) / h;
  const double b = 3 * mean - 2 * begin.velocity - end.velocity;
  const double c = begin.velocity + end.velocity - 2 * mean;
  const double root = std::sqrt(std::max(0.0, b * b - 3 * c * begin.velocity));
  const double q = -(b + std::copysign(root, b));
  double peak = ends;
  for (const double s : {q / (3 * c), begin.velocity / q})
    if (s > 0 && s < 1)
      peak = std::max(peak, std::abs(begin.displacement + h * s * (begin.velocity + s * (b + s * c))));
  return peak;
}

constexpr double steps_per_period = 40;

// Rejects calculations that would take hours: periods much too short for the motion.
void require_few_steps(const std::vector<Line>& lines, std::span<const double> periods) {
  double duration = 0, steps = 0;
  for (const Line& line : lines) duration += line.duration;
  for (const double period : periods) steps += static_cast<double>(lines.size()) + duration / period * steps_per_period;
  if (steps > limits::spectrum_steps)
    throw std::invalid_argument(
        fmt::format("spectrum: {} periods from {:g} s and a motion of {:g} s need {:.1e} steps, but the maximum is "
                    "{:.0e}; use longer periods",
                    periods.size(), *std::ranges::min_element(periods), duration, steps, limits::spectrum_steps));
}

double peak_displacement(const std::vector<Line>& lines, double period, double damping) {
  const double w = 2 * std::numbers::pi / period;
  OscillatorState state;
  double peak = 0;

  double h = 0;
  OscillatorStep step(w, damping, period / steps_per_period);
  const auto pass = [&](const Line& line) {
    const double count = std::max(1.0, std::ceil(line.duration / period * steps_per_period));
    // Step lengths that differ only by round-off share their coefficients.
    if (std::abs(line.duration / count - h) > 1e-9 * h) {
      h = line.duration / count;
      step = OscillatorStep(w, damping, h);
    }
    for (double i = 0; i < count; ++i) {
      const auto at = [&](double part) { return line.a0 + (line.a1 - line.a0) * part; };
      const OscillatorState next = step.advance(state, at(i / count), at((i + 1) / count));
      peak = std::max(peak, peak_between(state, next, h));
      state = next;
    }
  };
  for (const Line& line : lines) pass(line);
  pass({period, 0, 0});
  return peak;
}

}  // namespace

OscillatorStep::OscillatorStep(double w, double zeta, double h) {
  assert(w > 0 && zeta >= 0 && h > 0 && w * h <= 1);
  // With s = t/h:  u'' = -2 zeta (w h) u' - (w h)^2 u - h^2 (a0 + (a1 - a0) s),  u = sum of c_k s^k.
  constexpr int terms = 40;
  const double wh = w * h;
  const std::array<std::array<double, 4>, 4> unit = {{{1, 0, 0, 0}, {0, h, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const auto& [u0, v0, a0, rise] = unit[i];
    double low = u0, high = v0;  // c_k and c_(k+1)
    double u = low + high, slope = high;
    for (int k = 0; k < terms; ++k) {
      const double load = k == 0 ? a0 : k == 1 ? rise : 0;
      const double next = -(2 * zeta * wh * (k + 1) * high + wh * wh * low + h * h * load) / ((k + 1.0) * (k + 2.0));
      u += next;
      slope += (k + 2) * next;
      low = high;
      high = next;
    }
    u_[i] = u;
    v_[i] = slope / h;
  }
}

std::vector<SpectrumPoint> response_spectrum(const GroundMotion& motion, std::span<const double> periods,
                                             double damping) {
  if (!(damping >= 0 && damping < 1))
    throw std::invalid_argument(fmt::format("spectrum: damping ratio {:g}; it must be in [0, 1)", damping));
  const std::vector<Line> lines = straight_lines(motion);
  for (const double period : periods)
    if (!(period > 0 && std::isfinite(period)))
      throw std::invalid_argument(fmt::format("spectrum: period {:g} s; it must be finite and > 0", period));
  require_few_steps(lines, periods);
  std::vector<SpectrumPoint> points;
  for (const double period : periods) {
    const double w = 2 * std::numbers::pi / period;
    const double sd = peak_displacement(lines, period, damping);
    points.push_back({.period = period, .sd = sd, .psv = w * sd, .psa = w * w * sd});
  }
  return points;
}

}  // namespace pounding
