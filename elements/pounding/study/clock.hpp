#pragma once
/// The variable by which the integrator steps in contact: time, or a root of the time since a touch.

#include <cmath>

namespace pounding::study {

/// t = touch + s^p: a force that begins as d^(n/p) with a whole n is smooth in s, and with it the motion.
class Clock {
 public:
  /// Time, and dt/ds.
  struct Tick {
    double time, speed;
  };

  /// Goes by time itself.
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
  /// Time takes a step by s longer the later it is: the factor to the next step of about the same length in time. The
  /// step from the touch itself says more about s than about time.
  double shortening(double s, double ds) const noexcept {
    if (s == 0) return p_ == 1 ? 1 : 0.8;
    const double ratio = (2 * s + ds) / (2 * s + 3 * ds);
    return p_ == 1 ? 1 : p_ == 2 ? ratio : ratio * ratio;
  }
  /// Times count from later by `shift`.
  void move(double shift) noexcept { touch_ -= shift; }

 private:
  double touch_ = 0;
  int p_ = 1;
};

}  // namespace pounding::study
