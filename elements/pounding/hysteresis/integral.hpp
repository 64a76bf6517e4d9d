#pragma once
/// Integrals of smooth functions, for hysteretic laws without a closed form.

#include <algorithm>
#include <cmath>

namespace pounding::hysteresis {

/// An integral, and its difference from the seven-point Gauss rule.
struct Quadrature {
  double value = 0, error = 0;
};

/// Fifteen-point Kronrod extension of the seven-point Gauss rule, from a to b. QUADPACK (Piessens et al. 1983), qk15.
template <class F>
Quadrature kronrod(const F& f, double a, double b) noexcept {
  constexpr double points[] = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                               0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                               0.586087235467691130294144838258730, 0.405845151377397166906606412076961,
                               0.207784955007898467600689403773245};
  constexpr double weights[] = {0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                0.204432940075298892414161999234649};
  constexpr double gauss[] = {0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                              0.381830050505118944950369775488975};
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a), centre = f(middle);
  double all = 0.209482141084727828012999174891714 * centre, few = 0.417959183673469387755102040816327 * centre;
  for (int i = 0; i < 7; ++i) {
    const double pair = f(middle - half * points[i]) + f(middle + half * points[i]);
    all += weights[i] * pair;
    if (i % 2 == 1) few += gauss[i / 2] * pair;
  }
  return {half * all, std::abs(half * (all - few))};
}

/// Integral of f from a to b. Intervals are bisected, at most 30 times, until both rules agree to `allowed` or to
/// round-off.
template <class F>
double integral(const F& f, double a, double b, double allowed, int depth = 30) noexcept {
  const Quadrature whole = kronrod(f, a, b);
  constexpr double rounding = 1e-14;
  if (!(whole.error > std::max(allowed, rounding * std::abs(whole.value))) || depth == 0) return whole.value;
  const double middle = 0.5 * (a + b);
  return integral(f, a, middle, 0.5 * allowed, depth - 1) + integral(f, middle, b, 0.5 * allowed, depth - 1);
}

}  // namespace pounding::hysteresis
