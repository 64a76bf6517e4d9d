#pragma once
/// Checks of parameters. They throw std::invalid_argument with the name of the parameter, its value and the allowed
/// range.

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pounding::laws {

/// Shortest text that round-trips to the same number.
inline std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// Text with three significant digits, for messages.
inline std::string short_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3).ptr};
}

/// Throws std::invalid_argument with the text "NAME is VALUE, but must be ALLOWED".
[[noreturn]] inline void refuse(std::string_view name, double value, std::string_view allowed) {
  throw std::invalid_argument(std::string(name) + " is " + number_text(value) + ", but must be " +
                              std::string(allowed));
}

/// Throws std::invalid_argument unless the value is finite and positive. All checks accept an empty optional.
inline void require_positive(std::string_view name, double value) {
  if (!(std::isfinite(value) && value > 0)) refuse(name, value, "finite and positive");
}

inline void require_positive(std::string_view name, const std::optional<double>& value) {
  if (value) require_positive(name, *value);
}

/// Throws std::invalid_argument unless the value is finite and nonnegative.
inline void require_not_negative(std::string_view name, const std::optional<double>& value) {
  if (value && !(std::isfinite(*value) && *value >= 0)) refuse(name, *value, "finite and not negative");
}

/// Throws std::invalid_argument unless the restitution is in (0, 1], or in [0, 1] if the law `sticks_at_zero`.
/// Subnormal numbers are treated as 0: damping proportional to 1/e would be infinite.
inline void require_restitution(const std::optional<double>& value, bool sticks_at_zero = false) {
  constexpr double minimum = std::numeric_limits<double>::min();
  if (!value || (*value >= (sticks_at_zero ? 0 : minimum) && *value <= 1)) return;
  if (*value >= 0 && *value < minimum)
    refuse("restitution", *value,
           "in (0, 1]: this law cannot make the bodies stick; stereomechanical and kelvin_voigt allow 0");
  refuse("restitution", *value, sticks_at_zero ? "in [0, 1]" : "in (0, 1]");
}

/// Throws std::invalid_argument for an exponent below 1, for which the stiffness at the touch would be infinite.
inline void require_exponent(double value) {
  if (!(std::isfinite(value) && value >= 1)) refuse("exponent", value, "finite and at least 1");
}

}  // namespace pounding::laws
