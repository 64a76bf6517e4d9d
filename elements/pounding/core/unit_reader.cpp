#include <pounding/core/unit_reader.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

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
    NamedUnit{"lbm", {dimension::mass, pound}},
    NamedUnit{"s", {dimension::time, 1}},
    NamedUnit{"sec", {dimension::time, 1}},
    NamedUnit{"ms", {dimension::time, 1e-3}},
    NamedUnit{"msec", {dimension::time, 1e-3}},
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
    NamedUnit{"kips", {dimension::force, 1e3 * pound_force}},
    NamedUnit{"kgf", {dimension::force, standard_gravity}},
    NamedUnit{"tf", {dimension::force, 1e3 * standard_gravity}},
    NamedUnit{"tonf", {dimension::force, 1e3 * standard_gravity}},
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
    NamedUnit{"mrad", {dimension::none, 1e-3}},
    NamedUnit{"deg", {dimension::none, std::numbers::pi / 180}},
    NamedUnit{"%", {dimension::none, 1e-2}},
};

Unit raised(const Unit& unit, double exponent) {
  const Dimension& d = unit.dimension;
  return {{d.mass * exponent, d.length * exponent, d.time * exponent}, std::pow(unit.factor, exponent)};
}

Unit product(const Unit& a, const Unit& b) {
  const Dimension &p = a.dimension, &q = b.dimension;
  return {{p.mass + q.mass, p.length + q.length, p.time + q.time}, a.factor * b.factor};
}

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

// "kN m" for "kNm", in any case; empty if the name is not the product of two units, or is a unit in another case.
std::string product_of_two(std::string_view name) {
  for (const NamedUnit& unit : named_units)
    if (std::ranges::equal(unit.name, name, same_letter)) return {};
  for (const NamedUnit& first : named_units)
    for (const NamedUnit& second : named_units)
      if (first.unit.dimension != second.unit.dimension &&
          std::ranges::equal(fmt::format("{}{}", first.name, second.name), name, same_letter))
        return fmt::format("{} {}", first.name, second.name);
  return {};
}

/// Maximum nesting depth of parentheses in a unit.
constexpr int deepest_bracket = 8;

/// Grammar: product = factor { [*] factor } { / factor };  factor = (name | "(" product ")") [[^] number];
/// "1" is allowed only before a "/".
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
    if (at_end()) throw InputError(fmt::format("unit \"{}\" ends before a unit", excerpt(text_)));
    Unit unit;
    if (text_[position_] == '(') {
      ++position_;
      if (++depth_ > deepest_bracket)
        throw InputError(
            fmt::format("unit \"{}\" has more than {} nested parentheses", excerpt(text_), deepest_bracket));
      unit = read_product();
      if (at_end()) throw InputError(fmt::format("unit \"{}\" lacks a \")\"", excerpt(text_)));
      ++position_;
      --depth_;
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
    if (const std::string apart = product_of_two(name); !apart.empty())
      throw InputError(
          fmt::format("unknown unit \"{}\". Did you mean \"{}\"? Separate the units by a space", excerpt(name), apart));
    std::vector<std::string_view> names;
    for (const NamedUnit& candidate : named_units) names.push_back(candidate.name);
    throw InputError(fmt::format("unknown unit \"{}\".{}", excerpt(name), suggestion(name, names)));
  }

  /// "^1.5", "^-2"; "m/s2" is common enough to be accepted as "m/s^2".
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
    throw InputError(
        fmt::format("cannot read \"{}\" in unit \"{}\"", excerpt(text_.substr(position_)), excerpt(text_)));
  }
  [[noreturn]] void fail_ambiguous() const {
    throw InputError(
        fmt::format("unit \"{}\" is ambiguous; type the product first, as in \"N s/m\", "
                    "or use parentheses, as in \"N/(m s)\"",
                    excerpt(text_)));
  }
  void skip_blanks() {
    while (!at_end() && is_blank(text_[position_])) ++position_;
  }
  bool at_end() const { return position_ == text_.size(); }

  std::string_view text_;
  std::size_t position_ = 0;
  int depth_ = 0;
};

}  // namespace

Unit read_unit(std::string_view text) { return UnitReader(text).read(); }

std::vector<std::string_view> unit_names(const Dimension& dimension) {
  std::vector<std::string_view> names;
  for (const NamedUnit& unit : named_units)
    if (unit.unit.dimension == dimension) names.push_back(unit.name);
  return names;
}

}  // namespace pounding
