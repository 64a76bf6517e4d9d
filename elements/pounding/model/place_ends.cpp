#include <pounding/model/place_ends.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/model/refuse_option.hpp>

namespace pounding {

Row motion_along(const LinkEnd& end, const Eigen::Vector3d& direction, int size) {
  Row row(size);
  for (int axis = 0; axis < 3; ++axis)
    if (direction[axis] != 0 && end.point.motion[axis].nonZeros() > 0) row += direction[axis] * end.point.motion[axis];
  return row;
}

void require_face(const Face& face, ModelOption option) {
  if (!(face.distance >= 0) || std::isinf(face.distance))
    refuse(option, "face must be finite and not negative; type face: auto, or face: 0.3 m");
}

LinkEnd place_end(const PairEnd& end, const Structure& s, Side side, double along, ModelOption option) {
  LinkEnd found;
  found.structure = end.structure;
  if (end.floor) found.floor = *end.floor;
  try {
    if (end.elevation) {
      found.label = fmt::format("{:.6g} m up", *end.elevation);
      found.point = s.surface->column(*end.elevation, side, along);
    } else if (!end.node.empty()) {
      found.label = "node " + end.node;
      found.point = s.surface->node(end.node);
    } else {
      if (!s.is_rigid()) found.label = "floor " + s.floors[found.floor].label;
      found.point = s.surface->floor(found.floor, side, along);
    }
  } catch (const std::invalid_argument& error) {
    refuse(option, fmt::format("{}: {}", s.name, error.what()));
  }
  return found;
}

void set_face(LinkEnd& end, const Structure& s, const std::optional<Face>& given, Side side, ModelOption option) {
  const std::optional<Face>& face = given ? given : s.face;
  if (!face) return;
  require_face(*face, option);
  end.face = face->distance;
  if (!face->by_columns) return;
  const std::string place = fmt::format("{} of {}", end.label, s.name);
  const std::optional<ColumnFace> found = s.surface->column_face(end.point.position, side);
  if (!found)
    refuse(option,
           fmt::format("no column is in line with {}, so face: auto has no depth to use; type face: 0 m if it is drawn "
                       "at its face, otherwise the distance from there to the face, such as face: 0.3 m",
                       place));
  if (found->is_estimated)
    refuse(option, fmt::format("face: auto needs sections with a size, and that of {} at {} is given by numbers; type "
                               "the distance from the "
                               "axis to the face, such as face: {} from its area and inertia",
                               found->column, place, format_quantity(found->distance, dimension::length)));
  end.face = found->distance;
  end.face_column = found->column;
}

std::vector<double> along_the_edge(std::optional<int> points, const LinkPair& pair, const Structure& a,
                                   const Structure& b, Side side) {
  const auto edge = [](const PairEnd& end, const Structure& s, Side own) -> std::optional<std::array<double, 2>> {
    if (!end.floor || s.dimension < 3) return {};
    return s.surface->edge(*end.floor, own);
  };
  const auto first = edge(pair.left, a, side), second = edge(pair.right, b, opposite(side));
  if (!first && !second) {
    if (points.value_or(1) > 1)
      refuse_idle(ModelOption::points, "several points require floors of structures in space on both sides; remove it");
    return {0};
  }
  if (!first || !second) {
    if (points.value_or(1) > 1) refuse_idle(ModelOption::points, "the two meet at one point; remove it");
    const auto [low, high] = first ? *first : *second;
    const double middle = 0.5 * (low + high);
    const Structure& s = first ? b : a;
    if (s.is_rigid() || s.dimension < 3) return {middle};
    // A node or a column is hit at its position.
    const LinkEnd met = first ? place_end(pair.right, b, opposite(side), middle, ModelOption::right)
                              : place_end(pair.left, a, side, middle, ModelOption::left);
    const int across = side == Side::plus_x || side == Side::minus_x ? 1 : 0;
    return {std::clamp(met.point.position[across], low, high)};
  }
  const std::array<double, 2> own = *first, other = *second;
  double low = std::max(own[0], other[0]), high = std::min(own[1], other[1]);
  if (low > high)
    refuse(
        ModelOption::link,
        fmt::format("the edges of {} and {} pass each other: from {:.6g} m to {:.6g} m and from {:.6g} m to {:.6g} m; "
                    "move the origin of one, or link nodes",
                    a.name, b.name, own[0], own[1], other[0], other[1]));
  const bool wide = high > low;
  const int count = points.value_or(wide ? 2 : 1);
  if (count > 1 && !wide) refuse_idle(ModelOption::points, "the two meet at one point; remove it");
  if (count == 1) return {0.5 * (low + high)};
  std::vector<double> along;
  for (int i = 0; i < count; ++i) along.push_back(low + (high - low) * i / (count - 1));
  return along;
}

void require_inertia(const LinkEnd& end, const Structure& s, Side side, ModelOption option) {
  if (s.is_rigid()) return;
  const int axis = side == Side::plus_x || side == Side::minus_x ? 0 : 1;
  if (end.point.motion[axis].nonZeros() == 0)
    refuse(option, fmt::format("{} of {} is fixed by its support and cannot be hit; name a floor, or a node that moves",
                               end.label, s.name));
  if (end.point.mass > 0) return;
  refuse(option, fmt::format("{} of {} has no mass; give it one, or name a floor", end.label, s.name));
}

}  // namespace pounding
