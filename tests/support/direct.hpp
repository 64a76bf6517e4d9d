#pragma once
/// Marching of a Stepper with error control, and an independent integrator for comparison.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include <pounding/stepping/step_controller.hpp>

namespace pounding::test {

struct NamedScheme {
  const char* name;
  Scheme scheme;
  double order;
};

inline constexpr NamedScheme schemes[] = {
    {"midpoint", {.kind = Scheme::Kind::generalized_alpha}, 2},
    {"damped", {.kind = Scheme::Kind::generalized_alpha, .spectral_radius = 0.8}, 2},
    {"esdirk4", {.kind = Scheme::Kind::esdirk4}, 4}};

inline SparseMatrix diagonal(const std::vector<double>& values) {
  SparseMatrix m(static_cast<int>(values.size()), static_cast<int>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) m.insert(static_cast<int>(i), static_cast<int>(i)) = values[i];
  return m;
}

/// Steps to `end` within the tolerance of the stepper; returns the number of attempts.
inline long march(Stepper& stepper, double end, double longest) {
  StepController controller(stepper);
  ErrorControl policy(longest);
  double h = longest / 64;
  while (stepper.view().time() < end) h = controller.advance(h, end, policy);
  return controller.trials();
}

/// Steps of equal length; shorter only at the end of a phase, at a corner of the ground motion, and at the end.
inline void march_evenly(Stepper& stepper, double end, double h) {
  StepController controller(stepper);
  FixedSteps policy;
  while (stepper.view().time() < end * (1 - 1e-12)) controller.advance(h, end, policy);
}

/// y' = f(t, y) from `begin` to `end`: Dormand and Prince 5(4), relative tolerance 1e-11 of `size`. Steps end at the
/// `breaks`; at the end of a step f is evaluated just before the break.
template <class F>
Eigen::VectorXd integrate(const F& f, Eigen::VectorXd y, double begin, double end, double size,
                          std::vector<double> breaks) {
  constexpr double a[7][6] = {{},
                              {1.0 / 5},
                              {3.0 / 40, 9.0 / 40},
                              {44.0 / 45, -56.0 / 15, 32.0 / 9},
                              {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                              {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                              {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  constexpr double c[7] = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
  constexpr double e[7] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
  breaks.push_back(end);
  std::sort(breaks.begin(), breaks.end());
  double t = begin, h = 1e-5;
  for (const double stop : breaks) {
    if (stop <= t || stop > end) continue;
    while (t < stop) {
      const bool last = t + h >= stop;
      const double step = last ? stop - t : h;
      Eigen::VectorXd k[7], error = Eigen::VectorXd::Zero(y.size()), next = y;
      for (int i = 0; i < 7; ++i) {
        next = y;
        for (int j = 0; j < i; ++j) next += step * a[i][j] * k[j];
        k[i] = f(std::min(t + c[i] * step, stop - 1e-13), next);
        error += step * e[i] * k[i];
      }
      const double ratio = error.cwiseAbs().maxCoeff() / (1e-11 * size);
      if (ratio <= 1) {
        t = last ? stop : t + step;
        y = next;
      }
      h = step * std::clamp(0.9 * std::pow(std::max(ratio, 1e-10), -0.2), 0.2, 4.0);
    }
  }
  return y;
}

}  // namespace pounding::test
