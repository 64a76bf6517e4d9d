#pragma once
/// Root of a function in a bracket, to double precision.

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace pounding {

/// Root of f in [a, b]; f(a) and f(b) are passed and must differ in sign. Brent, Algorithms for Minimization without
/// Derivatives (1973), chapter 4: interpolation, with bisection as fallback. Returns the end of the last bracket with
/// the smaller |f|. Throws std::domain_error if the signs do not differ.
template <class F>
double find_root(F&& f, double a, double fa, double b, double fb) {
  if (!(fa * fb <= 0)) throw std::domain_error("no sign change in the bracket");
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  double c = a, fc = fa, step = b - a, previous = step;
  for (int i = 0; i < 200 && fb != 0; ++i) {
    if ((fb > 0) == (fc > 0)) c = a, fc = fa, step = previous = b - a;
    if (std::abs(fc) < std::abs(fb)) a = b, b = c, c = a, fa = fb, fb = fc, fc = fa;
    const double tolerance = 2 * epsilon * std::abs(b) + std::numeric_limits<double>::min();
    const double half = 0.5 * (c - b);
    if (std::abs(half) <= tolerance) break;
    double p = half, q = 1;
    const bool interpolate = std::abs(previous) >= tolerance && std::abs(fa) > std::abs(fb);
    if (interpolate) {
      const double s = fb / fa;
      if (a == c) {
        p = 2 * half * s, q = 1 - s;
      } else {
        const double t = fa / fc, r = fb / fc;
        p = s * (2 * half * t * (t - r) - (b - a) * (r - 1)), q = (t - 1) * (r - 1) * (s - 1);
      }
      if (p > 0) q = -q;
      p = std::abs(p);
    }
    if (interpolate && 2 * p < std::fmin(3 * half * q - std::abs(tolerance * q), std::abs(previous * q)))
      previous = std::exchange(step, p / q);
    else
      step = previous = half;
    a = b, fa = fb;
    b += std::abs(step) > tolerance ? step : std::copysign(tolerance, half);
    fb = f(b);
  }
  return b;
}

}  // namespace pounding
