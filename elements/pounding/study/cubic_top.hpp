#pragma once
/// Stationary points of quantities within a step.

#include <algorithm>
#include <cmath>

#include <pounding/study/taylor.hpp>

namespace pounding::study {

/// Stationary point of the cubic through values and slopes (times the length) at 0 and 1, for slopes of opposite sign.
inline double top_of_cubic(double y0, double w0, double y1, double w1) noexcept {
  const double a = 3 * (w0 + w1 - 2 * (y1 - y0)), b = 2 * (3 * (y1 - y0) - 2 * w0 - w1);
  return 2 * w0 / (-b + std::copysign(std::sqrt(std::max(0.0, b * b - 4 * a * w0)), w0));
}

/// Fraction of the step at which a quantity is stationary, from its slopes of opposite sign at both ends and a first
/// guess, to 1e-4: the error of the quantity is proportional to the square of that. `slope(s)` is called once per
/// iteration.
template <class Slope>
double flat_part(double at_begin, double at_end, double s, const Slope& slope) noexcept {
  double low = 0, high = 1, at_low = at_begin, at_high = at_end;
  for (int i = 0; i < 8; ++i) {
    const double at = slope(s);
    if ((at > 0) == (at_begin > 0))
      low = s, at_low = at;
    else
      high = s, at_high = at;
    const double next = straight_root(low, at_low, high, at_high);
    if (std::abs(next - s) < 1e-4) return s;
    s = next;
  }
  return s;
}

/// Reversal of a motion on a path, from its rates of opposite sign at both ends.
template <class Path>
double turn_on(const Path& path, double rate, double later) noexcept {
  return flat_part(rate, later, straight_root(0, rate, 1, later), [&](double s) { return path.at(s).v; });
}

}  // namespace pounding::study
