#pragma once
/// Lengths of steps whose factors are worth keeping.

#include <algorithm>
#include <cmath>
#include <optional>

#include <pounding/model/system.hpp>

namespace pounding {

/// Steps that are powers of two of one length: the shortest of the longest steps that the run allows at any time. While
/// that limit holds, steps have its length exactly; level 0 is the longest of all.
class DyadicSteps {
 public:
  /// `max_step`: longest step of the run where the ground allows it [s].
  DyadicSteps(const System& system, double max_step) : base_(max_step) {
    for (const GroundMotion& motion : system.grounds) base_ = std::min(base_, motion.longest_step(motion.start()));
    doublings_ = static_cast<int>(std::floor(std::log2(max_step / base_ * (1 + 1e-9))));
  }

  /// The longest one that is at most `wanted`, rounding apart [s].
  double at_most(double wanted) const {
    const double halvings = std::ceil(std::log2(base_ / (wanted * (1 + 1e-9))));
    return std::ldexp(base_, -std::max(-doublings_, static_cast<int>(halvings)));
  }

  /// k if h is level 0 over 2^k.
  std::optional<int> level(double h) const {
    int exponent = 0;
    const double mantissa = std::frexp(base_ / h, &exponent);
    if (std::abs(mantissa - 0.5) < 1e-9 && exponent - 1 >= -doublings_) return exponent - 1 + doublings_;
    return std::nullopt;
  }

 private:
  double base_;        // [s]
  int doublings_ = 0;  // of it to level 0
};

}  // namespace pounding
