#pragma once
/// d^n and its derivative, zero for an open gap; common exponents avoid std::pow.

#include <cmath>

namespace pounding {

/// Minimum depth [m] at which a slope that is infinite at the touch (exponent below 1) is evaluated. The force is
/// exact.
inline constexpr double shallowest_slope = 1e-9;

/// d^n and its derivative.
struct Power {
  double value = 0, slope = 0;
};

/// power() for d > 0 and exponents other than 1.5; a separate function, so that the most common exponent is inlined.
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

/// Penetration scale of a power law, (m v^2/k)^(1/(n+1)) [m]: in this unit of length all impacts are similar.
inline double impact_length(double reduced_mass, double speed, double stiffness, double exponent) noexcept {
  return std::pow(reduced_mass * speed * speed / stiffness, 1 / (exponent + 1));
}

}  // namespace pounding
