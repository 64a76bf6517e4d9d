#include <pounding/core/units.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/text.hpp>
#include <pounding/core/unit_reader.hpp>

namespace pounding {
namespace {

struct NamedDimension {
  Dimension dimension;
  std::string_view name, unit, example;
};

constexpr std::array named_dimensions = {
    NamedDimension{dimension::none, "a number", "", "5 %"},
    NamedDimension{dimension::mass, "a mass", "kg", "100 t"},
    NamedDimension{dimension::length, "a length", "m", "20 mm"},
    NamedDimension{dimension::time, "a time", "s", "0.5 s"},
    NamedDimension{dimension::frequency, "a frequency", "1/s", "2 Hz"},
    NamedDimension{dimension::area, "an area", "m^2", "0.04 m^2"},
    NamedDimension{dimension::volume, "a volume", "m^3", "0.002 m^3"},
    NamedDimension{dimension::second_moment, "a second moment of area", "m^4", "8000 cm^4"},
    NamedDimension{dimension::velocity, "a velocity", "m/s", "0.3 m/s"},
    NamedDimension{dimension::inverse_velocity, "an inverse velocity", "s/m", "0.5 s/m"},
    NamedDimension{dimension::acceleration, "an acceleration", "m/s^2", "0.35 g"},
    NamedDimension{dimension::force, "a force", "N", "200 kN"},
    NamedDimension{dimension::impulse, "an impulse", "N s", "50 kN s"},
    NamedDimension{dimension::energy, "an energy or moment", "N m", "12 kN m"},
    NamedDimension{dimension::stiffness, "a stiffness", "N/m", "93500 kN/m"},
    NamedDimension{dimension::damping, "a damping coefficient", "N s/m", "200 kN s/m"},
    NamedDimension{dimension::hertz_stiffness, "a Hertz stiffness", "N/m^1.5", "2.75e9 N/m^1.5"},
    NamedDimension{dimension::stress, "a stress", "Pa", "30 GPa"},
    NamedDimension{dimension::density, "a density", "kg/m^3", "2400 kg/m^3"},
    NamedDimension{dimension::mass_per_length, "a mass per length", "kg/m", "300 kg/m"},
    NamedDimension{dimension::mass_per_area, "a mass per area", "kg/m^2", "500 kg/m^2"},
    NamedDimension{dimension::rotational_inertia, "a rotational inertia", "kg m^2", "4000 kg m^2"},
};

const NamedDimension* named(const Dimension& dimension) {
  for (const NamedDimension& candidate : named_dimensions)
    if (candidate.dimension == dimension) return &candidate;
  return nullptr;
}

/// Reads the number at the beginning of `text` and returns the rest; nullopt unless it is finite.
std::optional<std::string_view> leading_number(std::string_view text, double& value) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return std::nullopt;
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return std::string_view(end, static_cast<std::size_t>(text.data() + text.size() - end));
}

/// "1.5 mm" for "1,5 mm"; "93500 kN/m or 93.500 kN/m" for "93,500 kN/m", which may be thousands.
std::string without_comma(std::string_view text) {
  const std::size_t comma = text.find(',');
  std::string with_point(text), thousands(text);
  with_point[comma] = '.';
  std::erase(thousands, ',');
  std::size_t digits = 0;
  while (comma + 1 + digits < text.size() && is_digit(text[comma + 1 + digits])) ++digits;
  if (text.find(',', comma + 1) != std::string_view::npos) return thousands;
  return digits == 3 ? thousands + " or " + with_point : with_point;
}

std::string power_text(std::string_view base, double exponent) {
  return exponent == 1 ? std::string(base) : fmt::format("{}^{:g}", base, exponent);
}

struct Scale {
  double factor;
  std::string_view unit;
};

/// Units for reports, in decreasing order: the first unit not larger than the value is used, otherwise the last one.
std::vector<Scale> report_scales(const Dimension& d) {
  if (d == dimension::length) return {{1, "m"}, {1e-3, "mm"}};
  if (d == dimension::time) return {{1, "s"}, {1e-3, "ms"}};
  if (d == dimension::mass) return {{1e3, "t"}, {1, "kg"}};
  if (d == dimension::force) return {{1e9, "GN"}, {1e6, "MN"}, {1e3, "kN"}, {1, "N"}};
  if (d == dimension::impulse) return {{1e6, "MN s"}, {1e3, "kN s"}, {1, "N s"}};
  if (d == dimension::energy) return {{1e6, "MJ"}, {1e3, "kJ"}, {1, "J"}};
  if (d == dimension::stiffness) return {{1e9, "GN/m"}, {1e6, "MN/m"}, {1e3, "kN/m"}, {1, "N/m"}};
  if (d == dimension::damping) return {{1e6, "MN s/m"}, {1e3, "kN s/m"}, {1, "N s/m"}};
  if (d == dimension::hertz_stiffness) return {{1e6, "MN/m^1.5"}, {1e3, "kN/m^1.5"}, {1, "N/m^1.5"}};
  if (d == dimension::stress) return {{1e9, "GPa"}, {1e6, "MPa"}, {1e3, "kPa"}, {1, "Pa"}};
  return {};
}

}  // namespace

Unit parse_unit(std::string_view unit) {
  const std::string_view text = trimmed(unit);
  if (text.empty() || text == "1" || text == "-") return {};
  return read_unit(text);
}

Dimension parse_unit_dimension(std::string_view unit) { return parse_unit(unit).dimension; }

bool parse_number(std::string_view text, double& value) {
  const std::string_view number = trimmed(text);
  const auto rest = leading_number(number, value);
  return rest.has_value() && rest->empty();
}

double parse_quantity(std::string_view text, const Dimension& expected) {
  const std::string_view quantity = trimmed(text);
  const std::string takes =
      fmt::format("takes {} such as \"{}\"; ", quantity_name(expected), quantity_example(expected));
  double value = 0;
  const auto rest = leading_number(quantity, value);
  if (!rest) throw InputError(fmt::format("{}\"{}\" is not a finite number", takes, excerpt(text)));
  if (rest->starts_with(','))
    throw InputError(fmt::format("{}\"{}\" needs a decimal point, not a comma; type {}", takes, excerpt(text),
                                 excerpt(without_comma(quantity))));
  const std::string_view unit_read = trimmed(*rest);
  if (unit_read.empty()) return value;

  Unit unit;
  try {
    unit = read_unit(unit_read);
  } catch (const InputError& error) {
    throw InputError(takes + error.what());
  }
  if (unit.dimension != expected)
    throw InputError(fmt::format("{}\"{}\" is {}", takes, excerpt(text), quantity_name(unit.dimension)));
  const double in_si = value * unit.factor;
  if (!std::isfinite(in_si)) throw InputError(fmt::format("{}\"{}\" is not a finite number", takes, excerpt(text)));
  if (in_si == 0 && value != 0)
    throw InputError(fmt::format("{}\"{}\" is too small for a number", takes, excerpt(text)));
  return in_si;
}

std::string unit_text(const Dimension& dimension) {
  if (const NamedDimension* const known = named(dimension)) return std::string(known->unit);
  // A mass with 1/s^2 is more readable as a force.
  Dimension rest = dimension;
  std::string_view heavy = "kg";
  if (rest.mass != 0 && rest.time <= -2 * rest.mass) {
    heavy = "N";
    rest.length -= rest.mass;
    rest.time += 2 * rest.mass;
  }
  std::string above, below;
  const auto append = [&](std::string_view base, double exponent) {
    if (exponent == 0) return;
    std::string& side = exponent > 0 ? above : below;
    if (!side.empty()) side += ' ';
    side += power_text(base, std::abs(exponent));
  };
  append(heavy, rest.mass);
  append("m", rest.length);
  append("s", rest.time);
  if (below.empty()) return above;
  const bool several = below.find(' ') != std::string::npos;
  return (above.empty() ? "1" : above) + (several ? "/(" + below + ")" : "/" + below);
}

std::string quantity_name(const Dimension& dimension) {
  if (const NamedDimension* const known = named(dimension)) return std::string(known->name);
  return "a quantity in " + unit_text(dimension);
}

std::string quantity_example(const Dimension& dimension) {
  if (const NamedDimension* const known = named(dimension)) return std::string(known->example);
  return "1 " + unit_text(dimension);
}

std::string format_quantity(double value, const Dimension& dimension, int digits) {
  // Rounds first: 0.99996 m with four digits is 1 m, not 1000 mm.
  const double rounded = std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
  const std::vector<Scale> scales = report_scales(dimension);
  double factor = 1;
  std::string unit = unit_text(dimension);
  for (const Scale& scale : scales) {
    factor = scale.factor;
    unit = scale.unit;
    if (std::abs(rounded) >= scale.factor * (1 - 1e-12)) break;
  }
  const std::string number = fmt::format("{:.{}g}", value / factor, digits);
  return unit.empty() ? number : number + " " + unit;
}

}  // namespace pounding
