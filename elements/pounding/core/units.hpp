#pragma once
/// Quantities with units: reads texts such as "20 mm" or "93500 kN/m" into SI, and writes values for reports.

#include <string>
#include <string_view>

namespace pounding {

/// Value of the unit `g` [m/s^2].
inline constexpr double standard_gravity = 9.80665;

/// Exponents of mass, length and time. Angles and ratios have none.
struct Dimension {
  double mass = 0, length = 0, time = 0;
  /// Equal in all three exponents.
  bool operator==(const Dimension&) const = default;
};

/// Dimensions of input values.
namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension mass{1, 0, 0};
inline constexpr Dimension length{0, 1, 0};
inline constexpr Dimension time{0, 0, 1};
inline constexpr Dimension frequency{0, 0, -1};
inline constexpr Dimension area{0, 2, 0};
inline constexpr Dimension volume{0, 3, 0};         ///< also a section modulus
inline constexpr Dimension second_moment{0, 4, 0};  ///< of an area
inline constexpr Dimension velocity{0, 1, -1};
inline constexpr Dimension inverse_velocity{0, -1, 1};
inline constexpr Dimension acceleration{0, 1, -2};
inline constexpr Dimension force{1, 1, -2};
inline constexpr Dimension impulse{1, 1, -1};
inline constexpr Dimension energy{1, 2, -2};     ///< also a moment and a rotational stiffness
inline constexpr Dimension stiffness{1, 0, -2};  ///< also a force per length
inline constexpr Dimension damping{1, 0, -1};    ///< force per velocity
inline constexpr Dimension hertz_stiffness{1, -0.5, -2};
inline constexpr Dimension stress{1, -1, -2};
inline constexpr Dimension density{1, -3, 0};
inline constexpr Dimension mass_per_length{1, -1, 0};
inline constexpr Dimension mass_per_area{1, -2, 0};
inline constexpr Dimension rotational_inertia{1, 2, 0};
}  // namespace dimension

/// A unit: its dimension and its value in SI.
struct Unit {
  Dimension dimension;
  double factor = 1;
};

/// Reads products and quotients of the known units: "kN/m^1.5", "N s/m", "kN/(m s)", "m/s2", "1/s"; "", "1" and "-" are
/// pure numbers. `g` is standard gravity, 9.80665 m/s^2. `Hz` is 1/s and `rad` is 1, so "1 rad/s" and "1 Hz" are the
/// same number: the caller defines which one is meant. `lb` and `lbm` are masses, `lbf` and `kip` are forces; `tf` and
/// `tonf` are the weight of a tonne, 9.80665 kN. Throws InputError for an unknown unit, with the nearest known one, and
/// for "kN/m s", which is ambiguous.
Unit parse_unit(std::string_view unit);

/// Dimension of a unit; throws like parse_unit.
Dimension parse_unit_dimension(std::string_view unit);

/// Value in SI of a number with its unit, or of a number without unit, which is in SI. Throws InputError, without line
/// and column, for another dimension, an unknown unit, a text that is not a number, NaN and infinity:
///     takes a length such as "20 mm"; "20 kN" is a force
double parse_quantity(std::string_view text, const Dimension& expected);

/// Reads a finite number such as "2.75e9". Returns false for any other text.
bool parse_number(std::string_view text, double& value);

/// The SI unit of a dimension: "N/m", "m/s^2", "N/m^1.5"; "" for a pure number.
std::string unit_text(const Dimension& dimension);

/// Name of a dimension: "a length", "a stiffness", otherwise "a quantity in N/m^1.2".
std::string quantity_name(const Dimension& dimension);

/// Example of a value with this dimension, as a user would type it: "20 mm".
std::string quantity_example(const Dimension& dimension);

/// Value for a report, with `digits` significant digits, in a customary unit: "20 mm", "1.27 MN", "3.5 t".
std::string format_quantity(double value, const Dimension& dimension, int digits = 4);

}  // namespace pounding
