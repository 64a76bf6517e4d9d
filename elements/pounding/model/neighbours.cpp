#include <pounding/model/neighbours.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/model/contact_law.hpp>
#include <pounding/model/drawing.hpp>
#include <pounding/model/facing.hpp>
#include <pounding/model/place_ends.hpp>
#include <pounding/model/refuse_option.hpp>

namespace pounding {
namespace {

struct Interval {
  double low, high;
  double length() const { return high - low; }
  double middle() const { return 0.5 * (low + high); }
  bool is_point() const { return length() <= drawn_rounding; }
};

// A structure with a position in plan. A plane frame has none perpendicular to its plane.
struct Placed {
  int structure;
  bool is_plane;
  std::array<Interval, 2> along;  // x and y
  const Structure* drawn;
};

std::vector<Placed> placed(const Model& model) {
  std::vector<Placed> all;
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    const Structure& s = model.structures[i];
    const auto plan = s.surface->plan();
    if (!plan) continue;
    const auto [x0, x1, y0, y1] = *plan;
    all.push_back({static_cast<int>(i), s.dimension < 3, {Interval{x0, x1}, Interval{y0, y1}}, &s});
  }
  return all;
}

// Negative if the two overlap.
double apart(const Interval& a, const Interval& b) { return std::max(b.low - a.high, a.low - b.high); }

// True if they overlap in more than an end; a point must be inside the other one or at its end.
bool share(const Interval& a, const Interval& b) {
  return a.is_point() || b.is_point() ? apart(a, b) <= drawn_rounding : apart(a, b) < -drawn_rounding;
}

struct Facing {
  int axis;  // 0: apart along x
  double distance;
};

// Distance from the outermost axis on a side to the surface of the columns there [m]; links reject columns without a
// size.
double reach_of_columns(const Placed& s, int axis, bool is_low) {
  Eigen::Vector3d outermost = Eigen::Vector3d::Zero();
  outermost[axis] = is_low ? s.along[axis].low : s.along[axis].high;
  const Side side = axis == 0 ? (is_low ? Side::minus_x : Side::plus_x) : (is_low ? Side::minus_y : Side::plus_y);
  const auto found = s.drawn->surface->column_face(outermost, side);
  return found ? found->distance : 0;
}

// Distance from the outermost axis on a side to the face there [m].
double face_of(const Placed& s, int axis, bool is_low) {
  if (!s.drawn->face) return 0;
  return s.drawn->face->by_columns ? reach_of_columns(s, axis, is_low) : s.drawn->face->distance;
}

// Distance between the faces of two structures whose axes are this far apart along x or y.
double between_faces(const Placed& a, const Placed& b, int axis, double distance) {
  if (!a.drawn->face && !b.drawn->face) return distance;
  const bool in_order = a.along[axis].middle() <= b.along[axis].middle();
  return std::max(0.0, distance - face_of(a, axis, !in_order) - face_of(b, axis, in_order));
}

// Facing sides of two structures, at any distance; nullopt if they meet at a corner or overlap in plan.
std::optional<Facing> facing(const Placed& a, const Placed& b) {
  const double x = apart(a.along[0], b.along[0]), y = apart(a.along[1], b.along[1]);
  // Plane frames may overlap in plan at different heights.
  if (a.is_plane || b.is_plane) return Facing{0, between_faces(a, b, 0, std::max(0.0, x))};
  const bool along_x = x >= -drawn_rounding && share(a.along[1], b.along[1]);
  const bool along_y = y >= -drawn_rounding && share(a.along[0], b.along[0]);
  if (along_x == along_y) return {};
  return along_x ? Facing{0, between_faces(a, b, 0, std::max(0.0, x))}
                 : Facing{1, between_faces(a, b, 1, std::max(0.0, y))};
}

// True if the first interval overlaps the interior of the second.
bool crosses(const Interval& a, const Interval& b) {
  if (a.is_point() && b.is_point()) return std::abs(a.middle() - b.middle()) <= drawn_rounding;
  if (a.is_point()) return a.middle() > b.low + drawn_rounding && a.middle() < b.high - drawn_rounding;
  if (b.is_point()) return crosses(b, a);
  return apart(a, b) < -drawn_rounding;
}

// True if c is at least partly in the space between two facing structures.
bool is_between(const Placed& c, const Placed& a, const Placed& b, int axis) {
  const auto gap = [&](int i) {
    return Interval{std::min(a.along[i].high, b.along[i].high), std::max(a.along[i].low, b.along[i].low)};
  };
  const auto common = [&](int i) {
    return Interval{std::max(a.along[i].low, b.along[i].low), std::min(a.along[i].high, b.along[i].high)};
  };
  if (gap(axis).length() <= drawn_rounding || !crosses(c.along[axis], gap(axis))) return false;
  return a.is_plane || b.is_plane || c.is_plane || crosses(c.along[1 - axis], common(1 - axis));
}

bool is_hidden(const Placed& a, const Placed& b, int axis, const std::vector<Placed>& all) {
  return std::ranges::any_of(all, [&](const Placed& c) { return &c != &a && &c != &b && is_between(c, a, b, axis); });
}

// Advice for a drawing at the axes, for two structures with this distance; otherwise empty.
std::string cause_by_axes(const Placed& a, const Placed& b, const Facing& found) {
  if (found.distance < narrowest_between_axes) return {};
  const bool in_order = a.along[found.axis].middle() <= b.along[found.axis].middle();
  double reach = 0;
  std::vector<std::string> names;
  for (const auto& [s, is_low] : {std::pair(&a, !in_order), std::pair(&b, in_order)}) {
    const double half = s->drawn->face ? 0 : reach_of_columns(*s, found.axis, is_low);
    if (half > 0) names.push_back(s->drawn->name);
    reach += half;
  }
  if (names.empty() || reach > found.distance) return {};
  return fmt::format(
      "if they are drawn at the axes of their columns, type face: auto in {}, which leaves {} between faces; if at "
      "their faces, ",
      fmt::join(names, " and "), format_quantity(found.distance - reach, dimension::length, 6));
}

std::string refuse_none(const Model& model, const std::vector<Placed>& all) {
  if (all.size() < 2)
    return fmt::format(
        "neighbours are found among frames, which have a position in plan, and there is {}; name the two structures, "
        "as in "
        "between: [left, right]",
        all.empty() ? "none" : "only one");
  const Placed *first = nullptr, *second = nullptr;
  Facing nearest{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      if (const auto found = facing(all[i], all[j]); found && found->distance < nearest.distance) {
        nearest = *found;
        first = &all[i], second = &all[j];
      }
  if (!first) return "no two frames face each other in plan; move the origin of one";
  const std::string distance = format_quantity(nearest.distance, dimension::length, 6);
  return fmt::format(
      "no two frames are near enough; {} and {} are {} apart: {}type within: {}, or move the origin of one",
      model.structures[first->structure].name, model.structures[second->structure].name, distance,
      cause_by_axes(*first, *second, nearest), distance);
}

// Two floors whose edges do not overlap, or that are set back, do not meet.
bool meet(const Model& model, const LinkPair& pair, Side side, double within) {
  const Structure &a = model.structures[pair.left.structure], &b = model.structures[pair.right.structure];
  if (!pair.left.floor || !pair.right.floor) return true;
  if (a.dimension == 3 && b.dimension == 3) {
    const auto own = a.surface->edge(*pair.left.floor, side),
               other = b.surface->edge(*pair.right.floor, opposite(side));
    if (!share({own[0], own[1]}, {other[0], other[1]})) return false;
  }
  const double along = along_the_edge(1, pair, a, b, side).front();
  LinkEnd left = place_end(pair.left, a, side, along, ModelOption::left),
          right = place_end(pair.right, b, opposite(side), along, ModelOption::right);
  set_face(left, a, {}, side, ModelOption::between);
  set_face(right, b, {}, opposite(side), ModelOption::between);
  return drawn_distance(left, right, side) <= within + drawn_rounding;
}

ContactLocation location(const PairEnd& end) {
  ContactLocation place{.structure = end.structure, .elevation = end.elevation, .node = end.node};
  if (end.floor) place.floor = *end.floor + 1;
  return place;
}

}  // namespace

std::vector<Neighbours> neighbours(const Model& model, double within) {
  const std::vector<Placed> all = placed(model);
  std::vector<Neighbours> pairs;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const Placed &a = all[i], &b = all[j];
      const bool on_each_other =
          apart(a.along[0], b.along[0]) < -drawn_rounding && apart(a.along[1], b.along[1]) < -drawn_rounding;
      if (on_each_other && !a.is_plane && !b.is_plane)
        facing_side(model.structures[a.structure], model.structures[b.structure]);
      const auto found = facing(a, b);
      if (!found || found->distance > within + drawn_rounding || is_hidden(a, b, found->axis, all)) continue;
      const bool in_order = a.along[found->axis].middle() <= b.along[found->axis].middle();
      pairs.push_back({in_order ? a.structure : b.structure, in_order ? b.structure : a.structure, found->distance});
    }
  return pairs;
}

void link_neighbours(Model& model, const LinkOptions& options, const ContactLaw& law, double within) {
  if (!(within > 0) || !std::isfinite(within))
    refuse(ModelOption::within, "must be positive and finite, as in within: 1 m");
  if (options.name)
    refuse_idle(ModelOption::link_name,
                "would be shared by many pairs; remove it, and each link is named after its two ends");
  const std::vector<Neighbours> found = neighbours(model, within);
  if (found.empty()) refuse(ModelOption::between, refuse_none(model, placed(model)));
  std::set<std::pair<int, int>> linked;
  for (const Link& link : model.links) linked.insert(std::minmax(link.left.structure, link.right.structure));
  LinkOptions of_one = options;
  of_one.floors.reset();
  const std::size_t before = model.links.size();
  bool is_any_left = false;
  for (const Neighbours& pair : found) {
    if (linked.contains(std::minmax(pair.left, pair.right))) continue;
    is_any_left = true;
    const Side side = facing_side(model.structures[pair.left], model.structures[pair.right]);
    for (const LinkPair& ends : pairs_of(model, {.structure = pair.left}, {.structure = pair.right},
                                         options.floors.value_or(FacingFloors::all), options.level_within))
      if (meet(model, ends, side, within)) model.link(location(ends.left), location(ends.right), of_one, law);
  }
  if (!is_any_left) refuse_idle(ModelOption::between, "all neighbours are linked already; remove these links");
  if (model.links.size() == before)
    refuse(ModelOption::between,
           fmt::format("no floors of neighbours meet within {}; type a larger within, or link nodes",
                       format_quantity(within, dimension::length, 6)));
}

}  // namespace pounding
