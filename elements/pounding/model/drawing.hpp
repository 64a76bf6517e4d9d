#pragma once
/// The distances that a drawing of two structures gives to their links.

#include <optional>
#include <string>

#include <pounding/model/model.hpp>

namespace pounding {

/// Whether both have a place of their own in plan, as frames do: then the gap between them is drawn.
bool are_drawn(const Structure& first, const Structure& second);

/// Coordinates that differ by less are one place: typed decimals are rounded to tenths of a millimetre at best [m].
inline constexpr double drawn_rounding = 1e-4;

/// Ends farther apart than this across the direction of their contact do not meet: the depth of a beam with its slab,
/// the width of a column [m].
inline constexpr double usual_offset = 0.5;

/// Distance drawn between the faces of two ends [m]; negative if they overlap.
double drawn_distance(const LinkEnd& left, const LinkEnd& right, Side side);

/// The gap of a link between two drawn structures [m]: the distance drawn between the faces of its ends, to the
/// nanometre, or the requested gap if the two differ by at most 0.1 mm or a thousandth. Throws ModelError, with the
/// numbers, for another gap, for ends that overlap, and for ends that do not face each other: they differ by more than
/// `level` [m] in height, or by more than usual_offset along the sides that face each other.
double drawn_gap(const Model& model, const LinkEnd& left, const LinkEnd& right, Side side,
                 std::optional<double> requested, double level = usual_offset);

/// A distance from here on may be one between axes of columns [m].
inline constexpr double narrowest_between_axes = 0.25;

/// Advice for two ends that may have been drawn by the axes of their columns: what to type, and the distance between
/// faces that it leaves.
struct AxisAdvice {
  double halves[2] = {
      0, 0};         ///< from each end to the surface of its columns [m]; 0 if a face was given or there is no column
  std::string text;  ///< "face: auto in A and B"
  double sum() const { return halves[0] + halves[1]; }
};
AxisAdvice advice_on_axes(const Model& model, const LinkEnd& left, const LinkEnd& right, Side side);

}  // namespace pounding
