#pragma once
/// Step lengths whose factorizations are worth caching.

#include <algorithm>
#include <cmath>
#include <optional>

#include <pounding/model/system.hpp>

namespace pounding {

/// Power-of-two multiples of one base length: the smallest maximum step that the run allows at any time. While that
/// limit applies, steps have exactly the base length. Level 0 is the longest.
class DyadicSteps {
 public:
  /// `max_step`: maximum step of the run if the ground motion does not limit it [s].
  DyadicSteps(const System& system, double max_step) : base_(max_step) {
    for (const GroundMotion& motion : system.grounds) base_ = std::min(base_, motion.longest_step(motion.start()));
    doublings_ = static_cast<int>(std::floor(std::log2(max_step / base_ * (1 + 1e-9))));
  }

  /// Longest step that is at most `wanted`, up to round-off [s].
  double at_most(double wanted) const {
    const double halvings = std::ceil(std::log2(base_ / (wanted * (1 + 1e-9))));
    return std::ldexp(base_, -std::max(-doublings_, static_cast<int>(halvings)));
  }

  /// k if h is the length of level 0 divided by 2^k; `nullopt` otherwise.
  std::optional<int> level(double h) const {
    int exponent = 0;
    const double mantissa = std::frexp(base_ / h, &exponent);
    if (std::abs(mantissa - 0.5) < 1e-9 && exponent - 1 >= -doublings_) return exponent - 1 + doublings_;
    return std::nullopt;
  }

 private:
  double base_;        // [s]
  int doublings_ = 0;  // from the base to level 0
};

}  // namespace pounding
