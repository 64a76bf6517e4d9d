#pragma once
/// Integration of small ordinary differential equations.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pounding {

/// Advances y' = rate(y) by `length` >= 0 in place, with the pair 5(4) of Dormand & Prince 1980, J. Comput. Appl. Math.
/// 6:19. The estimated error of each step is at most `allowed`, for every component. `first` is the first step.
template <std::size_t N, class Rate>
void runge_kutta(const Rate& rate, std::array<double, N>& y, double length, double first, double allowed) noexcept {
  using Values = std::array<double, N>;
  constexpr double a[6][6] = {{1.0 / 5},
                              {3.0 / 40, 9.0 / 40},
                              {44.0 / 45, -56.0 / 15, 32.0 / 9},
                              {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                              {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                              {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  constexpr double error[7] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
  constexpr int max_steps = 100000;
  std::array<Values, 7> k;
  k[0] = rate(y);
  double done = 0, h = std::min(first, length);
  for (int step = 0; done < length && step < max_steps; ++step) {
    const bool is_last = h >= length - done;
    if (is_last) h = length - done;
    Values end = y;
    for (int i = 0; i < 6; ++i) {
      for (std::size_t n = 0; n < N; ++n) {
        double sum = 0;
        for (int j = 0; j <= i; ++j) sum += a[i][j] * k[j][n];
        end[n] = y[n] + h * sum;
      }
      k[i + 1] = rate(end);
    }
    double worst = 0;
    for (std::size_t n = 0; n < N; ++n) {
      double sum = 0;
      for (int j = 0; j < 7; ++j) sum += error[j] * k[j][n];
      worst = std::max(worst, std::abs(h * sum));
    }
    if (worst <= allowed) {
      if (is_last)
        done = length;
      else
        done += h;
      y = end;
      k[0] = k[6];
    }
    h *= worst > 0 ? std::clamp(0.9 * std::pow(allowed / worst, 0.2), 0.2, 5.0) : 5.0;
  }
}

}  // namespace pounding
