#pragma once
/// Restitution that a damping number yields in a free impact, in closed form, and the inverse to 1e-12: the exact
/// calibration. Three families cover almost all laws:
///
/// - displacement-proportional, F = k d^n (1 + a d'/v): independent of k, m, n and v;
/// - a linear oscillator with damping ratio z, released at zero force;
/// - the same oscillator with damping in the approach only.
///
/// Laws whose damping grows with a power of d are equivalent to such an oscillator in stretched time.

#include <cmath>
#include <numbers>

#include <pounding/base/root.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// x - ln(1 + x), without cancellation for small x. x > -1.
inline double log_excess(double x) noexcept {
  if (std::abs(x) > 0.3) return x - std::log1p(x);
  double power = x * x, sum = power / 2;
  for (int k = 3; k < 60 && std::abs(power) > 1e-18 * sum; ++k) {
    power *= -x;
    sum += power / k;
  }
  return sum;
}

/// exp(x) - 1 - x, without cancellation for small x.
inline double exp_excess(double x) noexcept {
  if (std::abs(x) > 0.3) return std::expm1(x) - x;
  double term = x * x / 2, sum = term;
  for (int k = 3; k < 40 && std::abs(term) > 1e-18 * sum; ++k) {
    term *= x / k;
    sum += term;
  }
  return sum;
}

/// e = [1 + W0(-(1+a) exp(-(1+a)))]/a of F = k d^n (1 + a d'/v). a >= 0.
inline double restitution_of_factor(double a) noexcept {
  if (!(a > 0)) return 1;
  // With u = a e the equation of motion yields -u - ln(1-u) = a - ln(1+a). In s = ln(1-u) its left side is
  // exp_excess(s), which is convex and decreasing, so Newton's method from below does not overshoot.
  const double excess = log_excess(a);
  double s = -(excess + std::sqrt(2 * excess));
  for (int i = 0; i < 100; ++i) {
    const double change = (exp_excess(s) - excess) / std::expm1(s);
    s -= change;
    if (std::abs(change) <= 1e-16 * std::abs(s)) break;
  }
  return -std::expm1(s) / a;
}

/// a of F = k d^n (1 + a d'/v): the root of a (1+e) = ln[(1+a)/(1-a e)] in (0, 1/e).
inline double exact_factor(const CalibrationTarget& q) {
  const double e = q.restitution;
  if (e >= 1) return 0;
  const auto excess = [e](double a) { return log_excess(a) - log_excess(-a * e); };
  const double low = 0.2 * (1 - e), high = (1 - 1e-15) / e;
  const double at_high = excess(high);
  if (at_high >= 0) return 1 / e;  // small e: the root equals 1/e to double precision
  return find_root(excess, low, excess(low), high, at_high);
}

/// arccos(z)/sqrt(1-z^2), continued for z >= 1 by arccosh(z)/sqrt(z^2-1).
inline double angle_ratio(double z) noexcept {
  const double half = std::sqrt(std::abs(1 - z) / 2);
  if (half == 0) return 1;
  return z < 1 ? std::asin(half) / (half * std::sqrt(1 - half * half))
               : std::asinh(half) / (half * std::sqrt(1 + half * half));
}

/// Contact until d = 0: exp(-pi z/sqrt(1-z^2)); 0 for z >= 1, where the bodies never separate.
inline double restitution_to_zero_penetration(double z) noexcept {
  return z < 1 ? std::exp(-std::numbers::pi * z / std::sqrt((1 - z) * (1 + z))) : 0;
}

/// Contact until F = 0: exp(-2 z arccos(z)/sqrt(1-z^2)).
inline double restitution_to_zero_force(double z) noexcept { return std::exp(-2 * z * angle_ratio(z)); }

/// Damping in the approach only: exp(-z arccos(z)/sqrt(1-z^2)).
inline double restitution_of_approach(double z) noexcept { return std::exp(-z * angle_ratio(z)); }

/// z such that restitution_of_approach(z) = e.
inline double exact_approach_ratio(const CalibrationTarget& q) {
  const double target = -std::log(q.restitution);
  if (!(target > 0)) return 0;
  // z arccos(z)/sqrt(1-z^2) increases from 0 without bound.
  const auto f = [target](double z) { return z * angle_ratio(z) - target; };
  double high = 1;
  while (f(high) < 0) high *= 4;
  return find_root(f, 0, -target, high, f(high));
}

/// z such that restitution_to_zero_force(z) = e.
inline double exact_cut_ratio(const CalibrationTarget& q) {
  return exact_approach_ratio({.restitution = std::sqrt(q.restitution)});
}

/// xi of Jankowski: the oscillator in stretched time has z = 2 xi/sqrt(5).
inline double exact_jankowski(const CalibrationTarget& q) { return std::sqrt(5.0) / 2 * exact_approach_ratio(q); }

/// alpha of viscous_hertz with the force cut off at zero: z = alpha/sqrt(2 (n+1)).
inline double exact_viscous(const CalibrationTarget& q) { return std::sqrt(2 * (q.exponent + 1)) * exact_cut_ratio(q); }

}  // namespace pounding::laws
