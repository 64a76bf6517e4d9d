#pragma once
/// Extremes of cubics.

#include <algorithm>
#include <cmath>

namespace pounding::study {

/// Where the cubic through values and slopes (times the length) at 0 and 1 turns, for slopes of opposite sign.
inline double top_of_cubic(double y0, double w0, double y1, double w1) noexcept {
  const double a = 3 * (w0 + w1 - 2 * (y1 - y0)), b = 2 * (3 * (y1 - y0) - 2 * w0 - w1);
  return 2 * w0 / (-b + std::copysign(std::sqrt(std::max(0.0, b * b - 4 * a * w0)), w0));
}

}  // namespace pounding::study
