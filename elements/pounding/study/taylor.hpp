#pragma once
/// Motion of modes for linear ground acceleration as polynomials of time, and roots of such polynomials.

#include <array>
#include <cstddef>

#include <pounding/base/bracketed_root.hpp>
#include <pounding/base/quintic.hpp>

namespace pounding::study {

/// Terms up to t^14: pieces with omega t <= 1 and 2 zeta omega t <= 1 are accurate to 1e-12.
inline constexpr int taylor_order = 14;

/// Number of terms with the same error for shorter pieces; `reach` is the maximum of omega t and 2 zeta omega t.
constexpr int taylor_order_for(double reach) noexcept {
  int order = 4;
  for (double left = reach * reach * reach * reach * reach / 120; order < taylor_order && left > 1e-12; ++order)
    left *= reach / (order + 2);
  return order;
}

/// 1/((i + 1)(i + 2)).
inline constexpr std::array<double, taylor_order - 1> taylor_shares = [] {
  std::array<double, taylor_order - 1> shares{};
  for (int i = 0; i + 1 < taylor_order; ++i) shares[static_cast<std::size_t>(i)] = 1.0 / ((i + 1) * (i + 2));
  return shares;
}();

/// sum of c[i] t^i, with terms up to t^order.
struct Polynomial {
  int order = taylor_order;
  std::array<double, taylor_order + 1> c{};

  /// Value with its first two derivatives.
  Jet at(double t) const noexcept {
    double x = c[static_cast<std::size_t>(order)], v = 0, half_a = 0;
    for (int i = order - 1; i >= 0; --i) {
      half_a = half_a * t + v;
      v = v * t + x;
      x = x * t + c[static_cast<std::size_t>(i)];
    }
    return {x, v, 2 * half_a};
  }
  Polynomial slope() const noexcept {
    Polynomial s{.order = order, .c = {}};
    for (std::size_t i = 1; i <= static_cast<std::size_t>(order); ++i) s.c[i - 1] = static_cast<double>(i) * c[i];
    return s;
  }
  void add(double factor, const Polynomial& other) noexcept {
    for (std::size_t i = 0; i <= static_cast<std::size_t>(order); ++i) c[i] += factor * other.c[i];
  }
};

/// Calls keep(i, c_i) with the terms of q'' + damping q' + stiffness q = -(forcing + forcing_slope t), from q and v at
/// t = 0; each a number or a pack.
template <class Number, class Keep>
void motion_terms(int order, const Number& stiffness, const Number& damping, const Number& q, const Number& v,
                  const Number& forcing, const Number& forcing_slope, const Keep& keep) noexcept {
  Number low = q, high = v;
  keep(0, low), keep(1, high);
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(order); ++i) {
    Number pull = damping * (static_cast<double>(i + 1) * high) + stiffness * low;
    if (i == 0) pull += forcing;
    if (i == 1) pull += forcing_slope;
    low = high;
    high = -taylor_shares[i] * pull;
    keep(i + 2, high);
  }
}

/// Motion of one mode.
inline Polynomial motion(int order, double stiffness, double damping, double q, double v, double forcing,
                         double forcing_slope) noexcept {
  Polynomial x{.order = order, .c = {}};
  motion_terms(order, stiffness, damping, q, v, forcing, forcing_slope,
               [&](std::size_t i, double term) { x.c[i] = term; });
  return x;
}

/// Root of the straight line through two values of opposite sign.
constexpr double straight_root(double low, double at_low, double high, double at_high) noexcept {
  return low + (high - low) * at_low / (at_low - at_high);
}

/// Root of p between low and high from a first guess. Newton's method doubles the digits of a guess: the last iterate
/// has full precision.
inline double root_of(const Polynomial& p, double low, double high, bool rises, double start) noexcept {
  return bracketed_root(
      [&](double t) {
        const Jet j = p.at(t);
        return Graph{j.x, j.v};
      },
      low, high, rises, start, 1e-9);
}
/// Reversal of p between 0 and high, from its slopes there, to a relative accuracy of `enough`.
inline double turn_of(const Polynomial& p, double at_zero, double high, double at_high, double enough = 1e-9) noexcept {
  return bracketed_root(
      [&](double t) {
        const Jet j = p.at(t);
        return Graph{j.v, j.a};
      },
      0, high, at_high > 0, at_zero == 0 ? 0.5 * high : straight_root(0, at_zero, high, at_high), enough);
}

/// First time in [0, end] at which a gap closes, negative for none. An opening gap that is zero at the start is not
/// closed yet. At most one reversal of the gap is considered.
inline double first_closing(const Polynomial& gap, double end) noexcept {
  const Jet last = gap.at(end);
  const auto touch = [&](double low, double at_low, double high, double at_high) {
    return root_of(gap, low, high, false, straight_root(low, at_low, high, at_high));
  };
  bool opens = gap.c[1] > 0;
  if (gap.c[1] == 0 || (gap.c[0] <= 0 && !opens)) {
    opens = gap.at(1e-3 * end).x > gap.c[0];
    if (gap.c[0] <= 0 && !opens) return 0;
  }
  if (opens) {
    if (last.v >= 0) return last.x > 0 || gap.c[0] <= 0 ? -1 : root_of(gap, 0, end, false, 0.5 * end);
    const double turn = turn_of(gap, gap.c[1] > 0 ? gap.c[1] : 0, end, last.v), widest = gap.at(turn).x;
    if (widest <= 0) return turn;
    return last.x > 0 ? -1 : touch(turn, widest, end, last.x);
  }
  if (last.x <= 0) return touch(0, gap.c[0], end, last.x);
  if (last.v <= 0) return -1;
  const double turn = turn_of(gap, gap.c[1], end, last.v), minimum = gap.at(turn).x;
  return minimum > 0 ? -1 : touch(0, gap.c[0], turn, minimum);
}

}  // namespace pounding::study
