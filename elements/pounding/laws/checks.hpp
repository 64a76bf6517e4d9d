#pragma once
/// Checks of parameters. They throw std::invalid_argument with the name of the parameter, its value and the allowed
/// range.

#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

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
  constexpr double least = std::numeric_limits<double>::min();
  if (!value || (*value >= (sticks_at_zero ? 0 : least) && *value <= 1)) return;
  if (*value >= 0 && *value < least)
    refuse("restitution", *value,
           "in (0, 1]: this law cannot make the bodies stick; stereomechanical and kelvin_voigt allow 0");
  refuse("restitution", *value, sticks_at_zero ? "in [0, 1]" : "in (0, 1]");
}

/// Throws std::invalid_argument for an exponent below 1, for which the stiffness at the touch would be infinite.
inline void require_exponent(double value) {
  if (!(std::isfinite(value) && value >= 1)) refuse("exponent", value, "finite and at least 1");
}

/// Throws std::invalid_argument unless damping is given exactly once: by a restitution or by one direct value.
inline void require_one_damping(
    std::string_view law, const std::optional<double>& restitution,
    std::initializer_list<std::pair<std::string_view, const std::optional<double>*>> direct) {
  std::string names = "restitution", given;
  int count = 0;
  const auto note = [&](std::string_view name) { given += (count++ ? " and " : "") + std::string(name); };
  if (restitution) note("restitution");
  for (const auto& [name, value] : direct) {
    names += " or " + std::string(name);
    if (*value) note(name);
  }
  if (count == 0) throw std::invalid_argument(std::string(law) + " has no damping; give " + names);
  if (count > 1)
    throw std::invalid_argument(std::string(law) + " takes one damping parameter, but " + given +
                                " are given; remove all but one");
}

/// Throws std::invalid_argument if a design velocity is given together with a direct coefficient, which makes it
/// ineffective.
inline void require_velocity_used(const std::optional<double>& impact_velocity,
                                  const std::optional<double>& coefficient) {
  if (impact_velocity && coefficient)
    throw std::invalid_argument("impact_velocity has no effect together with damping_coefficient; remove one of them");
}

}  // namespace pounding::laws
