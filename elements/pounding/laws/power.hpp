#pragma once
/// d^n and its slope, zero for an open gap; the usual exponents without std::pow.

#include <algorithm>
#include <cmath>

namespace pounding::laws {

/// Where a law's own slope is infinite at the touch (an exponent below 1), the slope is taken at least this deep [m].
/// The force is never altered.
inline constexpr double shallowest_slope = 1e-9;

/// d^n and its slope.
struct Power {
  double value = 0, slope = 0;
};

/// power() for d > 0 and exponents other than 1.5; apart from it, so that the usual exponent is inlined.
[[gnu::noinline]] inline Power other_power(double d, double n) noexcept {
  if (n == 1) return {d, 1};
  const double value = n == 0.5 ? std::sqrt(d) : n == 0.25 ? std::sqrt(std::sqrt(d)) : std::pow(d, n);
  if (n >= 1 || d >= shallowest_slope) return {value, n * value / d};
  return {value, n * std::pow(shallowest_slope, n - 1)};
}

/// d^n for d > 0, else zero with zero slope. n > 0; for n < 1 the slope is bounded by its value at shallowest_slope.
inline Power power(double d, double n) noexcept {
  if (!(d > 0)) return {};
  if (n != 1.5) return other_power(d, n);
  const double root = std::sqrt(d);
  return {d * root, 1.5 * root};
}

/// Penetration scale of a power law, (m v^2/k)^(1/(n+1)) [m]: the unit of length in which every impact looks alike.
inline double impact_length(double reduced_mass, double speed, double stiffness, double exponent) noexcept {
  return std::pow(reduced_mass * speed * speed / stiffness, 1 / (exponent + 1));
}

}  // namespace pounding::laws
