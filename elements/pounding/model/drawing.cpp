#include <pounding/model/drawing.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/units.hpp>

namespace pounding {
namespace {

// Maximum distance between column axes whose faces may pound: below it, recommendations of a gap mention the axes [m].
constexpr double widest_between_axes = 1.5;
// Relative tolerance for a difference of about half the column depths.
constexpr double about = 0.2;
// Relative tolerance between a gap and the distance in the drawing.
constexpr double relative_rounding = 1e-3;
// Distances are rounded to nanometres: 18.02 m - 18 m is exactly 20 mm [1/m].
constexpr double nanometres = 1e9;

std::string metres(double length) {
  return format_quantity(std::abs(length) * nanometres < 1 ? 0 : length, dimension::length, 6);
}

// "floor 3 of left", "node b of left", "the column of left 10.5 m up".
std::string placed_text(const LinkEnd& end, const Structure& s) {
  const bool is_column = end.floor < 0 && !end.label.starts_with("node ");
  return is_column ? fmt::format("the column of {} {}", s.name, end.label) : fmt::format("{} of {}", end.label, s.name);
}

// The two ends with their coordinates along an axis: "floor 1 of a (x = 6 m) and floor 1 of b (x = 6.02 m)".
struct Ends {
  const Structure &a, &b;
  const LinkEnd &left, &right;

  std::string at(int axis) const {
    constexpr char axes[] = "xyz";
    return fmt::format("{} ({} = {}) and {} ({} = {})", placed_text(left, a), axes[axis],
                       metres(left.point.position[axis]), placed_text(right, b), axes[axis],
                       metres(right.point.position[axis]));
  }
  bool has_face() const { return left.face.value_or(0) > 0 || right.face.value_or(0) > 0; }
  // " between faces 300 mm and 250 mm before the axes", empty for ends drawn at their faces.
  std::string faces() const {
    if (!has_face()) return {};
    return fmt::format(" between faces {} and {} before the axes", metres(left.face.value_or(0)),
                       metres(right.face.value_or(0)));
  }
  // Text on moving the second structure to another distance from the first one.
  std::string move(Side side, double farther) const {
    const double along = outward(side).sum() * farther;
    return fmt::format("move the origin of {} by {} along {}", b.name, metres(along),
                       side == Side::plus_x || side == Side::minus_x ? "x" : "y");
  }
};

void require_facing(const Ends& ends, int axis, double reach) {
  if (std::abs(ends.left.point.position[axis] - ends.right.point.position[axis]) <= reach) return;
  const bool in_height = axis == 2;
  const double up = ends.left.point.position.z();
  throw ModelError(
      ModelOption::between,
      fmt::format(
          "{} do not face each other; {}", ends.at(axis),
          in_height
              ? fmt::format("link ends that are level, or the column there, as in {{structure: {}, elevation: {}}}",
                            ends.b.name, metres(up))
              : "link other ends, or move the origin of one of the two"));
}

// Advice for a drawing at the axes, if the distance or its difference from the requested gap has the size of columns;
// otherwise empty.
std::string cause_by_axes(const Model& model, const Ends& ends, Side side, double requested, double drawn) {
  const AxisAdvice advice = advice_on_axes(model, ends.left, ends.right, side);
  const double difference = drawn - requested;
  bool is_of_columns = advice.sum() > 0 && drawn >= std::max(narrowest_between_axes, (1 - about) * advice.sum()) &&
                       drawn <= widest_between_axes;
  for (const double half : {advice.halves[0], advice.halves[1], advice.sum()})
    is_of_columns = is_of_columns || (half > 0 && std::abs(difference - half) <= about * half);
  if (!is_of_columns) return {};
  const double between = drawn - advice.sum();
  return fmt::format(
      "if the frames are drawn at the axes of their columns, type {}: the columns reach {} and {} beyond the axes, and "
      "{}; if they are drawn at their faces, ",
      advice.text, metres(advice.halves[0]), metres(advice.halves[1]),
      between >= -drawn_rounding ? fmt::format("{} remain between faces", metres(between))
                                 : fmt::format("the faces overlap by {}", metres(-between)));
}

}  // namespace

bool are_drawn(const Structure& first, const Structure& second) {
  return first.surface->plan() && second.surface->plan();
}

double drawn_distance(const LinkEnd& left, const LinkEnd& right, Side side) {
  return outward(side).dot(right.point.position - left.point.position) - left.face.value_or(0) - right.face.value_or(0);
}

AxisAdvice advice_on_axes(const Model& model, const LinkEnd& left, const LinkEnd& right, Side side) {
  AxisAdvice advice;
  bool are_sized = true;
  std::vector<std::string> names;
  std::string typed;
  const LinkEnd* ends[] = {&left, &right};
  for (int i = 0; i < 2; ++i) {
    if (ends[i]->face) continue;
    const Structure& s = model.structures[ends[i]->structure];
    const auto found = s.surface->column_face(ends[i]->point.position, i == 0 ? side : opposite(side));
    if (!found) continue;
    advice.halves[i] = found->distance;
    are_sized = are_sized && !found->is_estimated;
    names.push_back(s.name);
    typed += fmt::format("{}face: {} in {}", typed.empty() ? "" : " and ", metres(found->distance), s.name);
  }
  advice.text = are_sized ? fmt::format("face: auto in {}", fmt::join(names, " and ")) : typed;
  return advice;
}

double drawn_gap(const Model& model, const LinkEnd& left, const LinkEnd& right, Side side,
                 std::optional<double> requested, double level) {
  const Ends ends{model.structures[left.structure], model.structures[right.structure], left, right};
  const bool along_x = side == Side::plus_x || side == Side::minus_x;
  const double drawn = drawn_distance(left, right, side);
  if (drawn < -drawn_rounding)
    throw ModelError(ModelOption::between,
                     fmt::format("{} overlap by {}{}; {}{}{}", ends.at(along_x ? 0 : 1), metres(-drawn), ends.faces(),
                                 ends.has_face() ? "remove face if a frame is drawn at its faces, or " : "",
                                 ends.move(side, requested.value_or(0) - drawn), requested ? "" : ", or farther"));
  require_facing(ends, 2, level + drawn_rounding);
  // A plane frame has no position perpendicular to its plane.
  if (ends.a.dimension == 3 && ends.b.dimension == 3) require_facing(ends, along_x ? 1 : 0, usual_offset);
  if (!requested) return std::max(0.0, std::round(drawn * nanometres) / nanometres);
  if (std::abs(*requested - drawn) > std::max(drawn_rounding, relative_rounding * *requested))
    throw ModelError(
        ModelOption::gap,
        fmt::format("is {}, but {} are drawn {} apart{}; {}remove the gap to use this distance, or {}",
                    metres(*requested), ends.at(along_x ? 0 : 1), metres(drawn), ends.faces(),
                    cause_by_axes(model, ends, side, *requested, drawn), ends.move(side, *requested - drawn)));
  return *requested;
}

}  // namespace pounding
