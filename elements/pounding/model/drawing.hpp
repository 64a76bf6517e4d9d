#pragma once
/// The distances that a drawing of two structures gives to their links.

#include <optional>

#include <pounding/model/model.hpp>

namespace pounding {

/// Whether both have a place of their own in plan, as frames do: then the gap between them is drawn.
bool are_drawn(const Structure& first, const Structure& second);

/// Coordinates that differ by less are one place: typed decimals are rounded to tenths of a millimetre at best [m].
inline constexpr double drawn_rounding = 1e-4;

/// The gap of a link between two drawn structures [m]: the distance drawn from the left end to the right one, to the nanometre,
/// or the gap that was asked for where the two differ by at most 0.1 mm or a thousandth. Throws ModelError, with the numbers,
/// for another gap, for ends that overlap, and for ends more than half a metre apart in height or along the sides that face each
/// other: this is the depth of a beam with its slab, and the width of a column.
double drawn_gap(const Model& model, const LinkEnd& left, const LinkEnd& right, Side side, std::optional<double> asked);

}  // namespace pounding
