#pragma once
/// Bounds on the numbers of an input key.

#include <limits>
#include <string>

namespace pounding {

/// Interval of numbers in SI units.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_low = false, without_high = false;  ///< true if the end point is excluded

  /// True if there is a lower or an upper bound.
  constexpr bool has_low() const noexcept { return low > -std::numeric_limits<double>::infinity(); }
  constexpr bool has_high() const noexcept { return high < std::numeric_limits<double>::infinity(); }
  /// True if the value is within the bounds.
  constexpr bool contain(double value) const noexcept {
    const bool above = without_low ? value > low : value >= low;
    const bool below = without_high ? value < high : value <= high;
    return above && below;
  }
  /// " > 0", " >= 0", " in (0, 1]", in SI units; empty if unbounded.
  std::string text() const;
};

namespace bounds {
inline constexpr Bounds any{};
inline constexpr Bounds positive{.low = 0, .without_low = true};
inline constexpr Bounds non_negative{.low = 0};
inline constexpr Bounds from_0_to_1{.low = 0, .high = 1};                                                 ///< [0, 1]
inline constexpr Bounds above_0_to_1{.low = 0, .high = 1, .without_low = true};                           ///< (0, 1]
inline constexpr Bounds from_0_below_1{.low = 0, .high = 1, .without_high = true};                        ///< [0, 1)
inline constexpr Bounds between_0_and_1{.low = 0, .high = 1, .without_low = true, .without_high = true};  ///< (0, 1)
}  // namespace bounds

}  // namespace pounding
