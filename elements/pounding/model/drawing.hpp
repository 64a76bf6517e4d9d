#pragma once
/// Distances in the drawing of two structures, for their links.

#include <optional>
#include <string>

#include <pounding/model/model.hpp>

namespace pounding {

/// True if both have a position in plan, as frames do: the drawing then defines the gap between them.
bool are_drawn(const Structure& first, const Structure& second);

/// Coordinates that differ by less are equal: typed decimals are rounded to tenths of a millimetre at best [m].
inline constexpr double drawn_rounding = 1e-4;

/// Ends farther apart than this, perpendicular to the direction of their contact, do not meet: the depth of a beam with
/// its slab, the width of a column [m].
inline constexpr double usual_offset = 0.5;

/// Distance between the faces of two ends in the drawing [m]; negative if they overlap.
double drawn_distance(const LinkEnd& left, const LinkEnd& right, Side side);

/// Gap of a link between two drawn structures [m]: the distance between the faces of its ends in the drawing, to the
/// nanometre, or the requested gap if the two differ by at most 0.1 mm or a thousandth. Throws ModelError, with the
/// numbers, for another gap, for ends that overlap, and for ends that do not face each other: they differ by more than
/// `level` [m] in height, or by more than usual_offset along the facing sides.
double drawn_gap(const Model& model, const LinkEnd& left, const LinkEnd& right, Side side,
                 std::optional<double> requested, double level = usual_offset);

/// Minimum distance that may be one between column axes [m].
inline constexpr double narrowest_between_axes = 0.25;

/// Advice for two ends that may have been drawn at the axes of their columns: what to type, and the resulting distance
/// between faces.
struct AxisAdvice {
  double halves[2] = {
      0, 0};         ///< from each end to the surface of its columns [m]; 0 if a face was given, or without columns
  std::string text;  ///< "face: auto in A and B"
  double sum() const { return halves[0] + halves[1]; }
};
AxisAdvice advice_on_axes(const Model& model, const LinkEnd& left, const LinkEnd& right, Side side);

}  // namespace pounding
