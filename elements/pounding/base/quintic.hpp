#pragma once
/// Motion inside a step of an integrator: the polynomial of degree five through position, velocity and acceleration at
/// its ends.

#include <pounding/base/bracketed_root.hpp>

namespace pounding {

/// x, x' and x'' [m, m/s, m/s^2] at one instant.
struct Jet {
  double x = 0, v = 0, a = 0;
};

/// Polynomial through two of them at a distance h in time.
class Quintic {
 public:
  constexpr Quintic(const Jet& begin, const Jet& end, double h) noexcept : h_(h) {
    const double v0 = h * begin.v, v1 = h * end.v, a0 = h * h * begin.a, a1 = h * h * end.a;
    const double rise = end.x - begin.x - v0 - a0 / 2, slope = v1 - v0 - a0, bend = a1 - a0;
    c_[0] = begin.x, c_[1] = v0, c_[2] = a0 / 2;
    c_[3] = 10 * rise - 4 * slope + bend / 2, c_[4] = -15 * rise + 7 * slope - bend,
    c_[5] = 6 * rise - 3 * slope + bend / 2;
  }

  /// Values at the fraction s in [0, 1] of the step.
  constexpr Jet at(double s) const noexcept {
    const double x = c_[0] + s * (c_[1] + s * (c_[2] + s * (c_[3] + s * (c_[4] + s * c_[5]))));
    const double v = c_[1] + s * (2 * c_[2] + s * (3 * c_[3] + s * (4 * c_[4] + s * 5 * c_[5])));
    const double a = 2 * c_[2] + s * (6 * c_[3] + s * (12 * c_[4] + s * 20 * c_[5]));
    return {x, v / h_, a / (h_ * h_)};
  }
  /// Fraction s at which x has its extremum, for velocities of opposite sign at the ends.
  double turn(bool velocity_rises) const noexcept {
    return bracketed_root(
        [&](double s) {
          const Jet j = at(s);
          return Graph{j.v, j.a * h_};
        },
        0, 1, velocity_rises);
  }

 private:
  double c_[6] = {}, h_;
};

}  // namespace pounding
