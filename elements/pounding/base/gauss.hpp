#pragma once
/// Five-point Gauss rule.

namespace pounding {

/// Points in [0, 1] and their weights: exact for polynomials up to degree nine.
inline constexpr double gauss_points[] = {0.0469100770306680, 0.2307653449471585, 0.5, 0.7692346550528415,
                                          0.9530899229693320};
inline constexpr double gauss_weights[] = {0.1184634425280945, 0.2393143352496832, 0.2844444444444444,
                                           0.2393143352496832, 0.1184634425280945};

/// Integral of f between two limits by this rule.
template <class Function>
constexpr double gauss_integral(const Function& f, double from, double to) {
  double sum = 0;
  for (int i = 0; i < 5; ++i) sum += gauss_weights[i] * f(from + (to - from) * gauss_points[i]);
  return (to - from) * sum;
}

}  // namespace pounding
