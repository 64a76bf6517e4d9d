#pragma once
/// How high storeys are.

#include <vector>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// True if the heights of all floors are known.
bool knows_heights(const Structure& structure);
/// Lowest height that counts: of a node, or of the ground below a structure without nodes [m].
double base_height(const Structure& structure);
/// Heights of the storeys from the floor below, of the lowest from the base, from the ground up [m]. Empty where
/// heights or storeys are not known.
std::vector<double> storey_heights(const Structure& structure);

}  // namespace pounding
