#pragma once
/// Integration variable in contact: time, or a root of the time since a touch.

#include <cmath>

namespace pounding::study {

/// t = touch + s^p: a force that starts as d^(n/p) with an integer n is smooth in s, and so is the motion.
class Clock {
 public:
  /// Time, and dt/ds.
  struct Tick {
    double time, speed;
  };

  /// Uses time itself.
  Clock() = default;
  Clock(double touch, int p) noexcept : touch_(touch), p_(p) {}

  int p() const noexcept { return p_; }
  double touch() const noexcept { return touch_; }
  Tick at(double s) const noexcept {
    if (p_ == 1) return {s, 1};
    const double two = s * s;
    return p_ == 2 ? Tick{touch_ + two, 2 * s} : Tick{touch_ + two * two, 4 * two * s};
  }
  double reading(double t) const noexcept {
    if (p_ == 1) return t;
    const double root = std::sqrt(std::fmax(t - touch_, 0));
    return p_ == 2 ? root : std::sqrt(root);
  }
  /// A step of given length in s covers more time the later it is: factor to the next step of about the same length in
  /// time. The first step after the touch has about the same length in s instead.
  double shortening(double s, double ds) const noexcept {
    if (s == 0) return p_ == 1 ? 1 : 0.8;
    const double ratio = (2 * s + ds) / (2 * s + 3 * ds);
    return p_ == 1 ? 1 : p_ == 2 ? ratio : ratio * ratio;
  }
  /// Shifts the origin of time by `shift`.
  void move(double shift) noexcept { touch_ -= shift; }

 private:
  double touch_ = 0;
  int p_ = 1;
};

}  // namespace pounding::study
