#pragma once
/// Storey heights.

#include <vector>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// True if the heights of all floors are known.
bool knows_heights(const Structure& structure);
/// Height of the base: of the lowest node, or of the ground below a structure without nodes [m].
double base_height(const Structure& structure);
/// Heights of the storeys from the ground up, the lowest from the base, the others from the floor below [m]. Empty if
/// heights or storeys are unknown.
std::vector<double> storey_heights(const Structure& structure);

}  // namespace pounding
