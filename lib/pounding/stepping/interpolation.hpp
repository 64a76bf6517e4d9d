#pragma once
/// Interpolation inside an accepted step.

#include <algorithm>

#include <pounding/links/link_step.hpp>

namespace pounding {

/// Cubic Hermite interpolation: weights of the values and slopes at the ends of a step of length h.
struct Cubic {
  double begin, end, slope_begin, slope_end;

  /// At s in [0, 1].
  Cubic(double position, double h) {
    const double s = std::clamp(position, 0.0, 1.0), r = 1 - s;
    begin = r * r * (1 + 2 * s);
    end = s * s * (1 + 2 * r);
    slope_begin = h * s * r * r;
    slope_end = -h * s * s * r;
  }
};

/// Parabola through the values at both ends and at the middle of a step.
struct Parabola {
  double begin, middle, end;

  /// At s in [0, 1].
  explicit Parabola(double position) {
    const double s = std::clamp(position, 0.0, 1.0);
    begin = (1 - s) * (1 - 2 * s);
    middle = 4 * s * (1 - s);
    end = s * (2 * s - 1);
  }
};

/// Link force inside its last accepted step, s from 0 to 1 [N]: the parabola through both ends and the middle.
inline double force_inside(const LinkStep& step, double s) {
  const Parabola parabola(s);
  return parabola.begin * step.force_begin + parabola.middle * step.force_middle + parabola.end * step.force_end;
}

}  // namespace pounding
