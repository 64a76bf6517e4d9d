#pragma once
/// The variable by which the integrator steps in contact: time, or a root of the time since a touch.

#include <cmath>

namespace pounding::study {

/// t = touch + s^p: a force that begins as d^(n/p) with a whole n is smooth in s, and with it the motion.
class Clock {
 public:
  /// Goes by time itself.
  Clock() = default;
  Clock(double touch, int p) noexcept : touch_(touch), p_(p) {}

  int p() const noexcept { return p_; }
  double touch() const noexcept { return touch_; }
  double time(double s) const noexcept { return p_ == 1 ? s : touch_ + power(s, p_); }
  /// dt/ds.
  double speed(double s) const noexcept { return p_ == 1 ? 1 : p_ * power(s, p_ - 1); }
  double reading(double t) const noexcept {
    if (p_ == 1) return t;
    const double root = std::sqrt(std::fmax(t - touch_, 0));
    return p_ == 2 ? root : std::sqrt(root);
  }
  /// Times count from later by `shift`.
  void move(double shift) noexcept { touch_ -= shift; }

 private:
  static double power(double s, int n) noexcept {
    const double two = s * s;
    return n == 1 ? s : n == 2 ? two : n == 3 ? two * s : two * two;
  }
  double touch_ = 0;
  int p_ = 1;
};

}  // namespace pounding::study
