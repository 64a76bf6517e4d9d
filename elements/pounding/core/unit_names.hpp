#pragma once
/// The names of the units that parse_unit() knows, for lists of them.

#include <string_view>
#include <vector>

#include <pounding/core/units.hpp>

namespace pounding {

/// Every unit of this dimension that has a name of its own: "m", "mm", "cm" ... of a length.
std::vector<std::string_view> unit_names(const Dimension& dimension);

}  // namespace pounding
