#pragma once
/// One step of an ordinary differential equation by extrapolation: order 12, from the explicit midpoint rule.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pounding {

/// State at the end of a step, with its error.
template <std::size_t N>
struct ExtrapolatedStep {
  std::array<double, N> state;
  double error = 0;  ///< maximum ratio of error estimate to tolerance; acceptable up to 1
};

/// y' = f(x, y) from x to x + h. Gragg's midpoint rule with 2, 4 ... 12 substeps, extrapolated in the square of the
/// substep (Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.9). The states are scaled to order
/// one; tolerance is absolute below one and relative above.
template <std::size_t N, class F>
ExtrapolatedStep<N> extrapolated_step(F&& f, double x, const std::array<double, N>& y, double h, double tolerance) {
  constexpr std::size_t columns = 6;
  using State = std::array<double, N>;
  std::array<State, columns> row;  // row of the Neville table, newest first
  State diagonal{};                // result with one column fewer
  const State slope = f(x, y);
  for (std::size_t j = 0; j < columns; ++j) {
    const int substeps = 2 * static_cast<int>(j + 1);
    const double s = h / substeps;
    State before = y, now;
    for (std::size_t i = 0; i < N; ++i) now[i] = y[i] + s * slope[i];
    for (int k = 1; k < substeps; ++k) {
      const State g = f(x + k * s, now);
      for (std::size_t i = 0; i < N; ++i) before[i] += 2 * s * g[i];
      std::swap(before, now);
    }
    if (j > 0) diagonal = row[j - 1];
    State carried = now;
    for (std::size_t m = 0; m < j; ++m) {
      const double ratio = static_cast<double>(j + 1) / static_cast<double>(j - m);
      for (std::size_t i = 0; i < N; ++i) {
        const double higher = carried[i] + (carried[i] - row[m][i]) / (ratio * ratio - 1);
        row[m][i] = std::exchange(carried[i], higher);
      }
    }
    row[j] = carried;
  }
  ExtrapolatedStep<N> step{row[columns - 1]};
  // Two estimates: at a corner of f one of them can vanish by coincidence.
  for (std::size_t i = 0; i < N; ++i) {
    const double spread =
        std::max(std::abs(step.state[i] - row[columns - 2][i]), std::abs(step.state[i] - diagonal[i]));
    step.error = std::max(step.error, spread / (tolerance * (1 + std::abs(step.state[i]))));
  }
  return step;
}

}  // namespace pounding
