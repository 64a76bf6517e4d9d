#include <pounding/structures/bar_and_damper.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace pounding {
namespace {

constexpr int max_iterations = 100;

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

}  // namespace

void Bar::check() const {
  if (!is_positive(stiffness)) throw std::invalid_argument("the stiffness of a bar must be positive and finite");
}

double Damper::force(double rate) const noexcept {
  if (is_linear()) return coefficient * rate;
  return coefficient * rate * std::pow(rate * rate + rounding_velocity * rounding_velocity, 0.5 * (exponent - 1));
}

double Damper::slope(double rate) const noexcept {
  if (is_linear()) return coefficient;
  const double v2 = rate * rate, s = v2 + rounding_velocity * rounding_velocity;
  return coefficient * std::pow(s, 0.5 * (exponent - 1)) * (1 + (exponent - 1) * v2 / s);
}

double Damper::slip_rate(double stretch) const noexcept {
  const double force = stiffness * std::abs(stretch);
  return std::copysign(is_linear() ? force / coefficient : std::pow(force / coefficient, 1 / exponent), stretch);
}

// Newton's method from above: the left side is increasing and convex in the stretch for an exponent below 1, and in the
// rate of the dashpot above 1, so the iteration descends to the root.
double Damper::stretch(double length, double lag) const noexcept {
  if (std::isinf(lag) || length == 0) return 0;
  if (lag == 0) return length;
  const double whole = std::abs(length);
  if (is_linear()) return length / (1 + lag * stiffness / coefficient);
  // Upper bounds from each term separately.
  const double at_unit_rate = coefficient / stiffness;
  if (exponent > 1) {
    double rate = std::min(whole / lag, std::pow(whole / at_unit_rate, 1 / exponent));
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
      const double s = at_unit_rate * std::pow(rate, exponent), slope = exponent * s / rate + lag;
      const double next = rate - (s + lag * rate - whole) / slope;
      if (!(next < rate)) break;
      rate = next;
    }
    return std::copysign(std::min(whole, at_unit_rate * std::pow(rate, exponent)), length);
  }
  double s = std::min(whole, at_unit_rate * std::pow(whole / lag, exponent));
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const double slipped = lag * slip_rate(s), next = s - (s + slipped - whole) / (1 + slipped / (exponent * s));
    if (!(next < s)) break;
    s = next;
  }
  return std::copysign(s, length);
}

double Damper::stretch_slope(double stretch, double lag) const noexcept {
  if (std::isinf(lag)) return 0;
  if (lag == 0) return 1;
  if (is_linear()) return 1 / (1 + lag * stiffness / coefficient);
  const double s = std::abs(stretch), rate = std::abs(slip_rate(stretch));
  // At zero stretch the slope of the rate is zero for an exponent below 1, and infinite above 1.
  if (s == 0) return exponent < 1 ? 1 : 0;
  return exponent * s / (exponent * s + lag * rate);
}

void Damper::check() const {
  if (!is_positive(coefficient)) throw std::invalid_argument("the coefficient of a damper must be positive and finite");
  if (!(exponent >= min_exponent && exponent <= largest_exponent))
    throw std::invalid_argument(fmt::format("the exponent of a damper must be in [{:g}, {:g}], but is {:g}",
                                            min_exponent, largest_exponent, exponent));
  if (!is_positive(rounding_velocity))
    throw std::invalid_argument("the rounding_velocity of a damper must be positive and finite");
  if (!(stiffness >= 0 && std::isfinite(stiffness)))
    throw std::invalid_argument("the stiffness of a damper must be positive and finite");
  if (has_stiffness() && exponent * coefficient / stiffness < shortest_relaxation)
    throw std::invalid_argument(fmt::format(
        "the spring in series with the damper is too stiff: with {:.3g} N/m the relaxation time is {:.2g} s at 1 m/s, "
        "below the resolvable {:g} s; remove stiffness for a rigid connection, or type at most {:.3g} N/m",
        stiffness, exponent * coefficient / stiffness, shortest_relaxation,
        exponent * coefficient / shortest_relaxation));
}

}  // namespace pounding
