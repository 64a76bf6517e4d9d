#pragma once
/// Roots of functions between two points where their signs differ.

#include <cmath>

namespace pounding {

/// A value and its slope.
struct Graph {
  double value, slope;
};

/// Root of f between low and high, where its signs differ; f(t) has members value and slope. Newton's method, with
/// bisection if an iterate leaves the bracket. The first guess is `start`; iteration ends at a relative change below
/// `enough`.
template <class Function>
double bracketed_root(const Function& f, double low, double high, bool rises, double start,
                      double enough = 1e-15) noexcept {
  double t = start;
  for (int i = 0; i < 100; ++i) {
    const auto [value, slope] = f(t);
    if (value == 0) return t;
    if ((value < 0) == rises)
      low = t;
    else
      high = t;
    double next = t - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double moved = std::abs(next - t);
    t = next;
    if (moved <= enough * std::abs(t) || high - low <= 1e-15 * high) return t;
  }
  return t;
}
/// Starts from the midpoint.
template <class Function>
double bracketed_root(const Function& f, double low, double high, bool rises) noexcept {
  return bracketed_root(f, low, high, rises, 0.5 * (low + high));
}

}  // namespace pounding
