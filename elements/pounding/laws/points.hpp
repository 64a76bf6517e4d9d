#pragma once
/// Piecewise linear curves from lists of points, and lists as parameters by name.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <pounding/laws/checks.hpp>

namespace pounding::laws {

/// A value of a curve and its slope.
struct CurvePoint {
  double value = 0, slope = 0;
};

/// Piecewise linear curve through the origin and points with x >= 0, extrapolated with the slopes of its ends. The
/// origin itself may be the first point. Refers to the lists; at a corner the slope is that of the longer x.
struct Polyline {
  const std::vector<double>&x, &y;

  /// Start of the first segment that does not begin at the origin.
  std::size_t first() const noexcept { return x.front() == 0 ? 1 : 0; }
  /// Index of the end of the segment that contains `at`; the last segment is extrapolated.
  std::size_t segment(double at) const noexcept {
    const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
    return std::clamp(above, first(), x.size() - 1);
  }
  double begin_x(std::size_t end) const noexcept { return end == 0 ? 0 : x[end - 1]; }
  double begin_y(std::size_t end) const noexcept { return end == 0 ? 0 : y[end - 1]; }
  double slope(std::size_t end) const noexcept { return (y[end] - begin_y(end)) / (x[end] - begin_x(end)); }

  /// Value and slope at `where`.
  CurvePoint at(double where) const noexcept {
    const std::size_t end = segment(where);
    const double k = slope(end);
    return {begin_y(end) + k * (where - begin_x(end)), k};
  }
  /// Area below the curve from the origin to `where` >= 0.
  double area(double where) const noexcept {
    double sum = 0;
    const std::size_t last = segment(where);
    for (std::size_t end = first(); end < last; ++end) sum += 0.5 * (begin_y(end) + y[end]) * (x[end] - begin_x(end));
    return sum + 0.5 * (begin_y(last) + at(where).value) * (where - begin_x(last));
  }
  /// First corner: the end of the first segment that is followed by another one; infinite if there is none.
  double first_corner() const noexcept {
    return x.size() > first() + 1 ? x[first()] : std::numeric_limits<double>::infinity();
  }

  /// Throws std::invalid_argument unless both lists have the same length, begin at or above zero, and x increases; y
  /// must not decrease, and the first slope must be positive. The messages begin with the name of the list.
  void check(std::string_view x_name, std::string_view y_name) const {
    const auto item = [](std::string_view name, std::size_t i) {
      return std::string(name) + "[" + std::to_string(i + 1) + "]";
    };
    if (x.size() != y.size())
      throw std::invalid_argument(std::string(y_name) + " has " + std::to_string(y.size()) + " values and " +
                                  std::string(x_name) + " has " + std::to_string(x.size()) +
                                  "; give one force per point");
    if (x.empty()) throw std::invalid_argument(std::string(x_name) + " needs a point besides the origin");
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (const auto& [name, list] : {std::pair(x_name, &x), std::pair(y_name, &y)})
        if (!std::isfinite((*list)[i])) refuse(item(name, i), (*list)[i], "finite; the list has no gaps");
      if (i == 0 && x[0] == 0) {
        if (y[0] != 0) refuse(item(y_name, 0), y[0], "0, because " + std::string(x_name) + " is 0 there");
        continue;
      }
      if (!(x[i] > begin_x(i)))
        refuse(item(x_name, i), x[i], "above " + number_text(begin_x(i)) + ", since the values increase from zero");
      if (!(y[i] >= begin_y(i)) || (i == first() && !(y[i] > 0)))
        refuse(item(y_name, i), y[i],
               (i == first() ? "above " : "at least ") + number_text(begin_y(i)) + ", since the curve rises");
    }
    if (x.size() <= first()) throw std::invalid_argument(std::string(x_name) + " needs a point besides the origin");
  }
};

/// Name of item `index`, from 0, of a list parameter: "force[1]" for index 0.
inline std::string item_name(std::string_view list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index + 1) + "]";
}

/// List parameter and index, from 0, of a name such as "force[1]"; `nullopt` for any other name, and for a number that
/// is not in 1 ... 1000.
inline std::optional<std::pair<std::string_view, std::size_t>> list_item(std::string_view name) {
  constexpr std::size_t max_items = 1000;
  const std::size_t bracket = name.find('[');
  if (bracket == std::string_view::npos || name.back() != ']') return {};
  const char *from = name.data() + bracket + 1, *to = name.data() + name.size() - 1;
  std::size_t number = 0;
  if (const auto read = std::from_chars(from, to, number); read.ec != std::errc() || read.ptr != to) return {};
  if (number < 1 || number > max_items) return {};
  return std::pair(name.substr(0, bracket), number - 1);
}

/// The name of a parameter without the index of an item: "force" for "force[1]".
inline std::string_view parameter_name(std::string_view name) {
  const auto item = list_item(name);
  return item ? item->first : name;
}

/// True if a map from names contains the parameter or an item of it.
template <class Values>
bool is_given(const Values& values, std::string_view parameter) {
  return std::any_of(values.begin(), values.end(),
                     [&](const auto& each) { return parameter_name(each.first) == parameter; });
}

}  // namespace pounding::laws
