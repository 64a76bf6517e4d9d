#include <pounding/core/units.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/unit_names.hpp>

namespace pounding {
namespace {

constexpr double pound = 0.45359237;
constexpr double inch = 0.0254;
constexpr double pound_force = pound * standard_gravity;

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr std::array named_units = {
    NamedUnit{"m", {dimension::length, 1}},
    NamedUnit{"mm", {dimension::length, 1e-3}},
    NamedUnit{"cm", {dimension::length, 1e-2}},
    NamedUnit{"km", {dimension::length, 1e3}},
    NamedUnit{"in", {dimension::length, inch}},
    NamedUnit{"ft", {dimension::length, 12 * inch}},
    NamedUnit{"kg", {dimension::mass, 1}},
    NamedUnit{"t", {dimension::mass, 1e3}},
    NamedUnit{"lb", {dimension::mass, pound}},
    NamedUnit{"s", {dimension::time, 1}},
    NamedUnit{"ms", {dimension::time, 1e-3}},
    NamedUnit{"min", {dimension::time, 60}},
    NamedUnit{"h", {dimension::time, 3600}},
    NamedUnit{"Hz", {dimension::frequency, 1}},
    NamedUnit{"g", {dimension::acceleration, standard_gravity}},
    NamedUnit{"gal", {dimension::acceleration, 1e-2}},
    NamedUnit{"N", {dimension::force, 1}},
    NamedUnit{"kN", {dimension::force, 1e3}},
    NamedUnit{"MN", {dimension::force, 1e6}},
    NamedUnit{"GN", {dimension::force, 1e9}},
    NamedUnit{"lbf", {dimension::force, pound_force}},
    NamedUnit{"kip", {dimension::force, 1e3 * pound_force}},
    NamedUnit{"Pa", {dimension::stress, 1}},
    NamedUnit{"kPa", {dimension::stress, 1e3}},
    NamedUnit{"MPa", {dimension::stress, 1e6}},
    NamedUnit{"GPa", {dimension::stress, 1e9}},
    NamedUnit{"psi", {dimension::stress, pound_force / (inch * inch)}},
    NamedUnit{"ksi", {dimension::stress, 1e3 * pound_force / (inch * inch)}},
    NamedUnit{"J", {dimension::energy, 1}},
    NamedUnit{"kJ", {dimension::energy, 1e3}},
    NamedUnit{"MJ", {dimension::energy, 1e6}},
    NamedUnit{"rad", {dimension::none, 1}},
    NamedUnit{"deg", {dimension::none, std::numbers::pi / 180}},
    NamedUnit{"%", {dimension::none, 1e-2}},
};

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

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

Unit raised(const Unit& unit, double exponent) {
  const Dimension& d = unit.dimension;
  return {{d.mass * exponent, d.length * exponent, d.time * exponent}, std::pow(unit.factor, exponent)};
}

Unit product(const Unit& a, const Unit& b) {
  const Dimension &p = a.dimension, &q = b.dimension;
  return {{p.mass + q.mass, p.length + q.length, p.time + q.time}, a.factor * b.factor};
}

/// Grammar: product = factor { [*] factor } { / factor };  factor = (name | "(" product ")") [[^] number];
/// "1" stands before a "/" only.
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : text_(text) {}

  Unit read() {
    const Unit unit = read_product();
    if (position_ < text_.size()) fail_at_rest();
    return unit;
  }

 private:
  Unit read_product() {
    Unit unit = read_factor();
    bool divided = false;
    while (true) {
      skip_blanks();
      if (at_end() || text_[position_] == ')') return unit;
      if (text_[position_] == '/') {
        ++position_;
        unit = product(unit, raised(read_factor(), -1));
        divided = true;
      } else {
        if (divided) fail_ambiguous();
        if (text_[position_] == '*') ++position_;
        unit = product(unit, read_factor());
      }
    }
  }

  Unit read_factor() {
    skip_blanks();
    if (at_end()) throw InputError(fmt::format("unit \"{}\" ends where a unit should follow", text_));
    Unit unit;
    if (text_[position_] == '(') {
      ++position_;
      unit = read_product();
      if (at_end()) throw InputError(fmt::format("unit \"{}\" lacks a \")\"", text_));
      ++position_;
    } else if (text_.substr(position_).starts_with("1/")) {
      ++position_;
      return unit;
    } else {
      unit = read_name();
    }
    return read_exponent(unit);
  }

  Unit read_name() {
    const std::size_t begin = position_;
    while (!at_end() && std::string_view(" \t*/^()+-.0123456789").find(text_[position_]) == std::string_view::npos)
      ++position_;
    if (position_ == begin) fail_at_rest();
    const std::string_view name = text_.substr(begin, position_ - begin);
    for (const NamedUnit& candidate : named_units)
      if (candidate.name == name) return candidate.unit;
    std::vector<std::string_view> names;
    for (const NamedUnit& candidate : named_units) names.push_back(candidate.name);
    throw InputError(fmt::format("unknown unit \"{}\".{}", name, suggestion(name, names)));
  }

  /// "^1.5", "^-2"; "m/s2" is common enough to be read as "m/s^2".
  Unit read_exponent(const Unit& unit) {
    const bool marked = !at_end() && text_[position_] == '^';
    if (marked) ++position_;
    if (!marked && (at_end() || !is_digit(text_[position_]))) return unit;
    double exponent = 0;
    const char* const begin = text_.data() + position_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), exponent, std::chars_format::fixed);
    if (error != std::errc{} || !std::isfinite(exponent)) fail_at_rest();
    position_ += static_cast<std::size_t>(end - begin);
    return raised(unit, exponent);
  }

  [[noreturn]] void fail_at_rest() const {
    throw InputError(fmt::format("cannot read \"{}\" in unit \"{}\"", text_.substr(position_), text_));
  }
  [[noreturn]] void fail_ambiguous() const {
    throw InputError(fmt::format("unit \"{}\" can be read in two ways; type the product first, as in \"N s/m\", "
                                 "or use parentheses, as in \"N/(m s)\"", text_));
  }
  void skip_blanks() {
    while (!at_end() && is_blank(text_[position_])) ++position_;
  }
  bool at_end() const { return position_ == text_.size(); }

  std::string_view text_;
  std::size_t position_ = 0;
};

/// Reads the number at the beginning of `text` and returns the rest; nothing when there is no finite number.
std::optional<std::string_view> leading_number(std::string_view text, double& value) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return std::nullopt;
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return std::string_view(end, static_cast<std::size_t>(text.data() + text.size() - end));
}

std::string power_text(std::string_view base, double exponent) {
  return exponent == 1 ? std::string(base) : fmt::format("{}^{:g}", base, exponent);
}

struct Scale {
  double factor;
  std::string_view unit;
};

/// Units for reports, largest first: the first unit not larger than the value is used, else the last one.
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
  return UnitReader(text).read();
}

Dimension parse_unit_dimension(std::string_view unit) { return parse_unit(unit).dimension; }

std::vector<std::string_view> unit_names(const Dimension& dimension) {
  std::vector<std::string_view> names;
  for (const NamedUnit& unit : named_units)
    if (unit.unit.dimension == dimension) names.push_back(unit.name);
  return names;
}

bool parse_number(std::string_view text, double& value) {
  const std::string_view number = trimmed(text);
  const auto rest = leading_number(number, value);
  return rest.has_value() && rest->empty();
}

double parse_quantity(std::string_view text, const Dimension& expected) {
  const std::string_view quantity = trimmed(text);
  const std::string takes = fmt::format("takes {} such as \"{}\"; ", quantity_name(expected), quantity_example(expected));
  double value = 0;
  const auto rest = leading_number(quantity, value);
  if (!rest) throw InputError(fmt::format("{}\"{}\" is not a finite number", takes, text));
  if (rest->starts_with(',')) throw InputError(fmt::format("{}\"{}\" needs a decimal point, not a comma", takes, text));
  const std::string_view unit_read = trimmed(*rest);
  if (unit_read.empty()) return value;

  Unit unit;
  try {
    unit = UnitReader(unit_read).read();
  } catch (const InputError& error) {
    throw InputError(takes + error.what());
  }
  if (unit.dimension != expected)
    throw InputError(fmt::format("{}\"{}\" is {}", takes, text, quantity_name(unit.dimension)));
  value *= unit.factor;
  if (!std::isfinite(value)) throw InputError(fmt::format("{}\"{}\" is not a finite number", takes, text));
  return value;
}

std::string unit_text(const Dimension& dimension) {
  if (const NamedDimension* const known = named(dimension)) return std::string(known->unit);
  // A mass with 1/s^2 reads better as a force.
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
  // Rounding first: 0.99996 m with four digits is 1 m, not 1000 mm.
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
