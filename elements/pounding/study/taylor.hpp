#pragma once
/// Motion of modes under straight ground acceleration as polynomials of time, and roots of such polynomials.

#include <array>
#include <cmath>
#include <cstddef>

#include <pounding/core/bracketed_root.hpp>

namespace pounding::study {

/// Terms up to t^14: pieces with omega t <= 1 and 2 zeta omega t <= 1 are right to 1e-12.
inline constexpr int taylor_order = 14;

/// 1/((i + 1)(i + 2)).
inline constexpr std::array<double, taylor_order - 1> taylor_shares = [] {
  std::array<double, taylor_order - 1> shares{};
  for (int i = 0; i + 1 < taylor_order; ++i) shares[static_cast<std::size_t>(i)] = 1.0 / ((i + 1) * (i + 2));
  return shares;
}();

/// sum of c[i] t^i.
struct Polynomial {
  std::array<double, taylor_order + 1> c{};

  double value(double t) const noexcept {
    double sum = c[taylor_order];
    for (int i = taylor_order - 1; i >= 0; --i) sum = sum * t + c[static_cast<std::size_t>(i)];
    return sum;
  }
  /// d/dt.
  Polynomial slope() const noexcept {
    Polynomial s;
    for (std::size_t i = 1; i < c.size(); ++i) s.c[i - 1] = static_cast<double>(i) * c[i];
    return s;
  }
  void add(double factor, const Polynomial& other) noexcept {
    for (std::size_t i = 0; i < c.size(); ++i) c[i] += factor * other.c[i];
  }
};

/// Calls keep(i, c_i) with the terms of q'' + damping q' + stiffness q = -(forcing + forcing_slope t), from q and v at t = 0; a number each, or a pack.
template <class Number, class Keep>
void motion_terms(const Number& stiffness, const Number& damping, const Number& q, const Number& v, const Number& forcing, const Number& forcing_slope,
                  const Keep& keep) noexcept {
  Number low = q, high = v;
  keep(0, low), keep(1, high);
  for (std::size_t i = 0; i + 1 < taylor_order; ++i) {
    Number pull = damping * (static_cast<double>(i + 1) * high) + stiffness * low;
    if (i == 0) pull += forcing;
    if (i == 1) pull += forcing_slope;
    low = high;
    high = -taylor_shares[i] * pull;
    keep(i + 2, high);
  }
}

/// The motion of one mode.
inline Polynomial motion(double stiffness, double damping, double q, double v, double forcing, double forcing_slope) noexcept {
  Polynomial x;
  motion_terms(stiffness, damping, q, v, forcing, forcing_slope, [&](std::size_t i, double term) { x.c[i] = term; });
  return x;
}

/// A root of p between low and high; `s` is its slope.
inline double root_of(const Polynomial& p, const Polynomial& s, double low, double high, bool rises) noexcept {
  return bracketed_root([&](double t) { return Graph{p.value(t), s.value(t)}; }, low, high, rises);
}

/// First time in [0, end] at which a gap closes, negative for none. A gap of zero at the start that opens is not closed yet. At most one turn of the gap is
/// looked for.
inline double first_closing(const Polynomial& gap, double end) noexcept {
  const Polynomial rate = gap.slope();
  const double at_end = gap.value(end), out = rate.value(end);
  double low = 0;
  bool opens = gap.c[1] > 0;
  if (gap.c[1] == 0 || (gap.c[0] <= 0 && !opens)) {
    opens = gap.value(1e-3 * end) > gap.c[0];
    if (gap.c[0] <= 0 && !opens) return 0;
  }
  if (opens) {
    if (out >= 0) return at_end > 0 || gap.c[0] <= 0 ? -1 : root_of(gap, rate, 0, end, false);
    low = root_of(rate, rate.slope(), 0, end, false);
    if (gap.value(low) <= 0) return low;
    return at_end > 0 ? -1 : root_of(gap, rate, low, end, false);
  }
  if (at_end <= 0) return root_of(gap, rate, 0, end, false);
  if (out <= 0) return -1;
  const double turn = root_of(rate, rate.slope(), 0, end, true);
  return gap.value(turn) > 0 ? -1 : root_of(gap, rate, 0, turn, false);
}

}  // namespace pounding::study
