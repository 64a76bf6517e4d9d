#pragma once
/// Names of the units accepted by parse_unit(), for lists of them.

#include <string_view>
#include <vector>

#include <pounding/core/units.hpp>

namespace pounding {

/// All named units of this dimension: "m", "mm", "cm" ... for a length.
std::vector<std::string_view> unit_names(const Dimension& dimension);

}  // namespace pounding
