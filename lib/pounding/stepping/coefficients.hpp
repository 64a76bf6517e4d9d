#pragma once
/// Coefficients of the time-stepping schemes.

#include <array>
#include <stdexcept>

namespace pounding {

/// Generalized-alpha (Chung and Hulbert 1993), order 2. Inertia has weight alpha_m at the end of the step and all other
/// forces have weight alpha_f (1 minus the alphas of the paper).
struct GeneralizedAlpha {
  double alpha_m = 0.5, alpha_f = 0.5, beta = 0.25, gamma = 0.5;

  /// rho: spectral radius at infinite frequency, 0 to 1; throws std::invalid_argument otherwise.
  static GeneralizedAlpha of(double rho) {
    if (!(rho >= 0 && rho <= 1)) throw std::invalid_argument("spectral_radius must lie in [0, 1]");
    GeneralizedAlpha s;
    s.alpha_m = (2 - rho) / (1 + rho);
    s.alpha_f = 1 / (1 + rho);
    s.gamma = 0.5 + s.alpha_m - s.alpha_f;
    s.beta = 0.25 * (1 + s.alpha_m - s.alpha_f) * (1 + s.alpha_m - s.alpha_f);
    return s;
  }
};

/// ESDIRK4(3)6L[2]SA, the implicit half of ARK4(3)6L[2]SA (Kennedy and Carpenter 2003): order 4, L-stable, stiffly
/// accurate, with the same diagonal coefficient in all stages. In second-order form, each stage solves for its
/// acceleration.
namespace esdirk4 {
inline constexpr int stages = 6;
inline constexpr double shift = 1.0 / 4;
inline constexpr double c[stages] = {0, 1.0 / 2, 83.0 / 250, 31.0 / 50, 17.0 / 20, 1};
inline constexpr double a[stages][stages] = {
    {0},
    {1.0 / 4, 1.0 / 4},
    {8611.0 / 62500, -1743.0 / 31250, 1.0 / 4},
    {5012029.0 / 34652500, -654441.0 / 2922500, 174375.0 / 388108, 1.0 / 4},
    {15267082809.0 / 155376265600, -71443401.0 / 120774400, 730878875.0 / 902184768, 2285395.0 / 8070912, 1.0 / 4},
    {82889.0 / 524892, 0, 15625.0 / 83664, 69875.0 / 102672, -2260.0 / 8211, 1.0 / 4}};
/// Weights of the embedded scheme of order 3.
inline constexpr double embedded[stages] = {4586570599.0 / 29645900160, 0,
                                            178811875.0 / 945068544,    814220225.0 / 1159782912,
                                            -3700637.0 / 11593932,      61727.0 / 225920};
/// Weights of the accelerations in the displacement of a stage: the square of a.
inline constexpr auto squared = [] {
  std::array<std::array<double, stages>, stages> s{};
  for (int i = 0; i < stages; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = j; k <= i; ++k) s[i][j] += a[i][k] * a[k][j];
  return s;
}();
/// Weights of the accelerations in the errors of velocity and displacement at the end.
struct ErrorWeights {
  double velocity[stages], displacement[stages];
};
inline constexpr ErrorWeights error = [] {
  ErrorWeights e{};
  for (int j = 0; j < stages; ++j) {
    e.velocity[j] = a[stages - 1][j] - embedded[j];
    for (int i = j; i < stages; ++i) e.displacement[j] += (a[stages - 1][i] - embedded[i]) * a[i][j];
  }
  return e;
}();
}  // namespace esdirk4

}  // namespace pounding
