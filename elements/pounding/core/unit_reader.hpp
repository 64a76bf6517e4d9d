#pragma once
/// The grammar of units, and their names for lists of them.

#include <string_view>
#include <vector>

#include <pounding/core/units.hpp>

namespace pounding {

constexpr bool is_blank(char c) noexcept { return c == ' ' || c == '\t'; }
constexpr bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

/// Reads "kN/m^1.5", "N s/m", "m/s2"; `text` neither begins nor ends with a blank. Throws like parse_unit.
Unit read_unit(std::string_view text);

/// Named units of this dimension: "m", "mm", "cm" ... for a length.
std::vector<std::string_view> unit_names(const Dimension& dimension);

}  // namespace pounding
