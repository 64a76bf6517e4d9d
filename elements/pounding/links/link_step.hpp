#pragma once
/// Motion of a link, at one instant and over an accepted step.

#include <algorithm>
#include <cmath>

#include <pounding/base/quintic.hpp>

namespace pounding {

/// Relative motion of a link. penetration > 0 is overlap, rate > 0 closes.
struct LinkMotion {
  double penetration = 0;  ///< [m]
  double rate = 0;         ///< [m/s]
  // Only for a spring with an internal dashpot (Spring::slips), otherwise zero:
  double slip = 0;  ///< elongation of the dashpot, except the following term [m]
  double lag = 0;   ///< that term is this time multiplied by the current rate [s]; infinite at rest
};

/// An accepted step of a link: motion and force at its beginning, middle and end.
struct LinkStep {
  double begin = 0, end = 0;  ///< [s]
  LinkMotion motion_begin, motion_middle, motion_end;
  double force_begin = 0, force_middle = 0, force_end = 0;  ///< [N]
  double acceleration_begin = 0, acceleration_end = 0;      ///< time derivative of the rate [m/s^2]
};

/// Penetration and rate within an accepted step: polynomial of degree five through motions and accelerations at its
/// ends.
constexpr Quintic path(const LinkStep& step) noexcept {
  return {{step.motion_begin.penetration, step.motion_begin.rate, step.acceleration_begin},
          {step.motion_end.penetration, step.motion_end.rate, step.acceleration_end},
          step.end - step.begin};
}

/// Motion within an accepted step on that path, s from 0 to 1.
constexpr LinkMotion interpolate(const LinkStep& step, double s) noexcept {
  const Jet at = path(step).at(s);
  return {at.x, at.v};
}

/// Penetration within a trial step, s from 0 to 1: cubic polynomial through the motions at its ends.
class CubicPenetration {
 public:
  CubicPenetration(const LinkMotion& begin, const LinkMotion& end, double h) noexcept : begin_(begin), h_(h) {
    const double mean = (end.penetration - begin.penetration) / h;
    a_ = 3 * (begin.rate + end.rate - 2 * mean);
    b_ = 2 * (3 * mean - 2 * begin.rate - end.rate);
  }

  /// Penetration at s [m].
  double at(double s) const noexcept { return begin_.penetration + h_ * s * (begin_.rate + s * (b_ / 2 + s * a_ / 3)); }
  /// The s at which the rate is zero, for rates of opposite sign at the ends.
  double turn() const noexcept {
    const double root = std::sqrt(std::max(0.0, b_ * b_ - 4 * a_ * begin_.rate));
    return 2 * begin_.rate / (-b_ + std::copysign(root, begin_.rate));
  }

 private:
  LinkMotion begin_;
  double h_, a_, b_;  // the rate is begin.rate + b s + a s^2
};

}  // namespace pounding
