#include <pounding/input/link_input.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding {
namespace {

// Floors that differ by less than this part of their elevation are level.
constexpr double level = 1e-6;
// Where sliding does not say: slower than this, friction grows with the velocity [m/s].
constexpr double usual_sliding = 5e-3;

// What an input says of one end.
struct End {
  int structure = 0;
  std::optional<int> floor{};         // from 0
  bool numbered = false;              // the name of the link tells the floor
  std::optional<double> elevation{};  // [m]
  std::string node{};
};

// One pair of points still to be found on its structures.
struct Pair {
  End left, right;
};

int structure_named(const std::string& name, const Input& node, const Model& model) {
  std::vector<std::string_view> names;
  for (const Structure& s : model.structures) names.push_back(s.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) node.fail(fmt::format("unknown structure \"{}\".{}", name, suggestion(name, names)));
  return static_cast<int>(found - names.begin());
}

int read_floor(const std::string& number_text, const std::string& text, const Input& node, const Structure& s) {
  double number = 0;
  const bool whole = parse_number(number_text, number) && number == std::floor(number);
  const int count = static_cast<int>(s.floors.size());
  if (s.is_rigid()) node.fail(fmt::format("\"{}\" is a wall and has no floors; type {}", s.name, s.name));
  if (count == 0) node.fail(fmt::format("{} has no floors; name a node, as in {{structure: {}, node: NAME}}", s.name, s.name));
  if (count == 1 && (!whole || number != 1))
    node.fail(fmt::format("\"{}\" names no floor of {}, which has one; type {}", text, s.name, s.name));
  if (!whole || number < 1 || number > count)
    node.fail(fmt::format("\"{}\" names no floor of {}, which has the floors 1 to {}; type {}.{}", text, s.name, count, s.name,
                          count));
  return static_cast<int>(number) - 1;
}

End read_end(const Input& node, const Model& model) {
  End end;
  if (!node.is_map()) {
    const std::string text = node.as_text();
    const std::size_t dot = text.find('.');
    end.structure = structure_named(text.substr(0, dot), node, model);
    if (dot != std::string::npos) end.floor = read_floor(text.substr(dot + 1), text, node, model.structures[end.structure]);
    end.numbered = end.floor.has_value();
    return end;
  }
  node.only_keys({"structure", "floor", "node", "elevation"});
  const Input name = node.at("structure", "left");
  end.structure = structure_named(name.as_text(), name, model);
  const std::optional<Input> floor = node.find("floor"), at_node = node.find("node"), elevation = node.find("elevation");
  if (floor.has_value() + at_node.has_value() + elevation.has_value() > 1)
    node.fail("takes one of floor, node and elevation; keep one of them");
  if (floor) end.floor = read_floor(floor->as_text(), floor->as_text(), *floor, model.structures[end.structure]);
  if (at_node) end.node = at_node->as_text();
  if (elevation) end.elevation = elevation->as_quantity(dimension::length);
  end.numbered = end.floor.has_value();
  return end;
}

// The side of the first structure that faces the second one.
Side facing_side(const Input& between, const Structure& a, const Structure& b) {
  const auto first = a.surface->plan(), second = b.surface->plan();
  if (!first || !second) return Side::plus_x;
  const auto [ax0, ax1, ay0, ay1] = *first;
  const auto [bx0, bx1, by0, by1] = *second;
  const double rounding = 1e-9 * std::max({1.0, std::abs(ax1), std::abs(bx1), std::abs(ay1), std::abs(by1)});
  const auto beside = [&](double a0, double a1, double b0, double b1, Side plus, Side minus) -> std::optional<Side> {
    // Where both have no width and stand at one place neither is beside the other.
    if (a1 - a0 + b1 - b0 <= rounding && std::abs(b0 - a0) <= rounding) return {};
    if (b0 >= a1 - rounding) return plus;
    if (a0 >= b1 - rounding) return minus;
    return {};
  };
  std::optional<Side> along_x = beside(ax0, ax1, bx0, bx1, Side::plus_x, Side::minus_x);
  if (a.dimension < 3 && b.dimension < 3) return along_x.value_or(Side::plus_x);
  std::optional<Side> along_y = beside(ay0, ay1, by0, by1, Side::plus_y, Side::minus_y);
  // A frame whose end lies in the line of the other one's edge is apart from it the other way only.
  const double apart_x = std::max(bx0 - ax1, ax0 - bx1), apart_y = std::max(by0 - ay1, ay0 - by1);
  if (along_x && along_y && apart_x > rounding && apart_y <= rounding) along_y.reset();
  if (along_x && along_y && apart_y > rounding && apart_x <= rounding) along_x.reset();
  std::vector<Side> sides;
  for (const auto& side : {along_x, along_y})
    if (side) sides.push_back(*side);
  if (sides.empty())
    between.fail(fmt::format("{0} and {1} stand on each other: {0} reaches from x = {2:.6g} m to {3:.6g} m and from y = {4:.6g} m "
                             "to {5:.6g} m, {1} from x = {6:.6g} m to {7:.6g} m and from y = {8:.6g} m to {9:.6g} m; give one of "
                             "them an origin, such as origin: [{10:.6g} m, 0 m]",
                             a.name, b.name, ax0, ax1, ay0, ay1, bx0, bx1, by0, by1, ax1 + 0.1));
  if (sides.size() > 1)
    between.fail(fmt::format("{} and {} stand apart along x and along y: no side of the one faces the other; "
                             "move one by its origin", a.name, b.name));
  return sides.front();
}

bool is_level(double a, double b) { return std::abs(a - b) <= level * std::max({std::abs(a), std::abs(b), 1e-3}); }

bool has_elevations(const Structure& s) {
  return !s.floors.empty() && std::all_of(s.floors.begin(), s.floors.end(), [](const Floor& f) { return f.elevation.has_value(); });
}

// Structures without columns to hit, or without heights: floors are paired by their numbers.
std::vector<Pair> floors_by_number(const Input& between, int a, int b, const Structure& left, const Structure& right) {
  if (left.is_rigid() && right.is_rigid()) between.fail("both ends are walls; one of them must be able to move");
  for (const Structure* s : {&left, &right})
    if (!s->is_rigid() && s->floors.empty())
      between.fail(fmt::format("{0} has no floors; name a node, as in {{structure: {0}, node: NAME}}, and leave \"floors\" out", s->name));
  const int floors_left = static_cast<int>(left.floors.size()), floors_right = static_cast<int>(right.floors.size());
  const int count = left.is_rigid() ? floors_right : right.is_rigid() ? floors_left : std::min(floors_left, floors_right);
  const bool placed = has_elevations(left) && has_elevations(right);
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    if (placed && !is_level(*left.floors[i].elevation, *right.floors[i].elevation))
      between.fail(fmt::format("floor {0} of {1} is {2:.6g} m up and floor {0} of {3} {4:.6g} m: they do not face each other; "
                               "without \"floors: all\" a link names its two floors, as in [{1}.{0}, {3}.{0}]",
                               i + 1, left.name, *left.floors[i].elevation, right.name, *right.floors[i].elevation));
    Pair pair{{.structure = a, .numbered = true}, {.structure = b, .numbered = true}};
    if (!left.is_rigid()) pair.left.floor = i;
    if (!right.is_rigid()) pair.right.floor = i;
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<Pair> facing_floors(const Input& between, const std::string& choice, int a, int b, const Structure& left,
                                const Structure& right) {
  const bool sticks = left.dimension == 1 && right.dimension == 1 && choice == "all";
  if (sticks || !has_elevations(left) || !has_elevations(right)) return floors_by_number(between, a, b, left, right);
  const double lower_roof = std::min(*left.floors.back().elevation, *right.floors.back().elevation);
  const auto facing = [](const Structure& other, double elevation) -> std::optional<int> {
    for (std::size_t j = 0; j < other.floors.size(); ++j)
      if (is_level(*other.floors[j].elevation, elevation)) return static_cast<int>(j);
    return {};
  };
  struct Placed {
    double elevation;
    Pair pair;
  };
  std::vector<Placed> pairs;
  const auto visit = [&](const Structure& s, const Structure& other, bool from_left) {
    for (std::size_t i = 0; i < s.floors.size(); ++i) {
      const double z = *s.floors[i].elevation;
      const std::optional<int> partner = facing(other, z);
      if (partner && !from_left) continue;  // found from the left
      if (!partner && z > lower_roof * (1 + level)) continue;
      if (!partner && choice == "level") continue;
      if (!partner && choice == "all")
        between.fail(fmt::format("floor {} of {} is {:.6g} m up and faces no floor of {}; type floors: any to let it hit the column "
                                 "there, or floors: level to link only those that face each other",
                                 i + 1, s.name, z, other.name));
      Pair pair{{.structure = a, .numbered = true}, {.structure = b, .numbered = true}};
      End& own = from_left ? pair.left : pair.right;
      End& met = from_left ? pair.right : pair.left;
      own.floor = static_cast<int>(i);
      if (partner)
        met.floor = partner;
      else
        met.elevation = z;
      pairs.push_back({z, pair});
    }
  };
  visit(left, right, true);
  visit(right, left, false);
  if (pairs.empty())
    between.fail(fmt::format("no floor of {} is level with one of {}; type floors: any to let floors hit the columns", left.name,
                             right.name));
  std::stable_sort(pairs.begin(), pairs.end(), [](const Placed& x, const Placed& y) { return x.elevation < y.elevation; });
  std::vector<Pair> sorted;
  for (Placed& placed : pairs) sorted.push_back(std::move(placed.pair));
  return sorted;
}

// Without a choice of floors the structure must have one that can be meant.
void complete(End& end, const Structure& s, const Input& place) {
  if (s.is_rigid()) {
    if (end.elevation || !end.node.empty()) place.fail(fmt::format("\"{}\" is a wall; type {}", s.name, s.name));
    return;
  }
  if (end.floor || end.elevation || !end.node.empty()) return;
  if (s.floors.size() == 1) {
    end.floor = 0;
    return;
  }
  if (s.floors.empty()) place.fail(fmt::format("{0} has no floors; name a node, as in {{structure: {0}, node: NAME}}", s.name));
  place.fail(fmt::format("which of the {} floors of {}? Type {}.{}, or add floors: all", s.floors.size(), s.name, s.name,
                         s.floors.size()));
}

std::string text_of(const End& end, const Structure& s) {
  if (end.elevation) return fmt::format("{}@{:.6g}m", s.name, *end.elevation);
  if (!end.node.empty()) return fmt::format("{}:{}", s.name, end.node);
  return end.numbered && end.floor ? fmt::format("{}.{}", s.name, *end.floor + 1) : s.name;
}

// Where along the common edge of two floors the contact points lie.
std::vector<double> along_the_edge(const Input& node, const Pair& pair, const Structure& a, const Structure& b, Side side) {
  const std::optional<Input> points = node.find("points");
  const auto edge = [](const End& end, const Structure& s, Side own) -> std::optional<std::array<double, 2>> {
    if (!end.floor || s.dimension < 3) return {};
    return s.surface->edge(*end.floor, own);
  };
  const auto first = edge(pair.left, a, side), second = edge(pair.right, b, opposite(side));
  if (!first && !second) {
    if (points && points->as_integer(1, 100) > 1)
      points->fail_at_key("several points need floors of structures in space on both sides; leave it out");
    return {0};
  }
  const std::array<double, 2> own = first.value_or(*second), other = second.value_or(*first);
  double low = std::max(own[0], other[0]), high = std::min(own[1], other[1]);
  if (low > high)
    node.fail(fmt::format("the edges of {} and {} pass each other: from {:.6g} m to {:.6g} m and from {:.6g} m to {:.6g} m; "
                          "move one by its origin, or link nodes", a.name, b.name, own[0], own[1], other[0], other[1]));
  const bool wide = first && second && high > low;
  const int count = points ? static_cast<int>(points->as_integer(1, 100)) : wide ? 2 : 1;
  if (count > 1 && !wide) points->fail_at_key("the two meet at one point; leave it out");
  if (count == 1) return {0.5 * (low + high)};
  std::vector<double> along;
  for (int i = 0; i < count; ++i) along.push_back(low + (high - low) * i / (count - 1));
  return along;
}

LinkEnd place_end(const End& end, const Structure& s, Side side, double along, const Input& place) {
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
    place.fail(fmt::format("{}: {}", s.name, error.what()));
  }
  return found;
}

double displacement_along(const LinkEnd& end, const Structure& s, const Eigen::Vector3d& direction) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Row& row = end.point.motion[i];
    if (row.nonZeros() == 0 || direction[i] == 0) continue;
    sum += direction[i] * row.dot(s.initial_displacement);
    if (s.at_rest.size() > 0) sum += direction[i] * row.dot(s.at_rest);
  }
  return sum;
}

// Points that have no mass of their own in the way of the contact could be given any velocity at once.
void require_inertia(const LinkEnd& end, const Structure& s, Side side, const Input& place) {
  if (s.is_rigid()) return;
  const int axis = side == Side::plus_x || side == Side::minus_x ? 0 : 1;
  if (end.point.motion[axis].nonZeros() == 0)
    place.fail(fmt::format("{} of {} is held by its support and cannot be hit; name a floor, or a node that moves", end.label, s.name));
  if (end.point.mass > 0) return;
  place.fail(fmt::format("{} of {} has no mass; give it one, or name a floor", end.label, s.name));
}

void read_friction(const Input& node, const Structure& a, const Structure& b, Link& link) {
  const std::optional<Input> friction = node.find("friction"), sliding = node.find("sliding_velocity");
  if (sliding && !friction) sliding->fail_at_key("belongs to friction; type friction: 0.3 beside it, or leave it out");
  if (!friction) return;
  link.friction = friction->as_quantity(dimension::none, bounds::non_negative);
  link.sliding_velocity = sliding ? sliding->as_quantity(dimension::velocity, bounds::positive) : usual_sliding;
  const auto slides = [](const Structure& s) { return !s.is_rigid() && s.dimension > 1; };
  if (!slides(a) && !slides(b)) friction->fail_at_key("needs a frame: the others move along x only and cannot slide; leave it out");
  if (link.law == "stereomechanical")
    friction->fail_at_key("needs a law with a force; a stereomechanical contact gives velocities only");
}

}  // namespace

void read_link(const Input& node, Model& model, const Kinds& kinds) {
  static constexpr std::string_view keys[] = {"between", "floors", "gap", "name", "points", "friction", "sliding_velocity"};
  const Input between = node.at("between", "[left, right]");
  if (!between.is_list() || between.items().size() != 2)
    between.fail("takes two structures, the left one first; type between: [left, right]");
  const std::vector<Input> ends = between.items();
  End left = read_end(ends[0], model), right = read_end(ends[1], model);
  const Structure& a = model.structures[left.structure];
  const Structure& b = model.structures[right.structure];
  if (left.structure == right.structure)
    between.fail(fmt::format("\"{}\" cannot hit itself; name two structures, the left one first", a.name));

  std::vector<Pair> pairs;
  if (const std::optional<Input> floors = node.find("floors")) {
    const std::string choice = floors->as_choice("choice of floors", {"all", "level", "any"});
    const auto is_named = [](const End& end) { return end.floor || end.elevation || !end.node.empty(); };
    if (is_named(left) || is_named(right))
      floors->fail_at_key("names all floors, but \"between\" names one; keep one of the two");
    pairs = facing_floors(between, choice, left.structure, right.structure, a, b);
  } else {
    complete(left, a, ends[0]);
    complete(right, b, ends[1]);
    if (a.is_rigid() && b.is_rigid()) between.fail("both ends are walls; one of them must be able to move");
    pairs = {{left, right}};
  }

  const Side side = facing_side(between, a, b);
  const Input gap_node = node.at("gap", "20 mm");
  const int count = static_cast<int>(pairs.size());
  const std::vector<double> gaps = gap_node.as_quantities(count, dimension::length, bounds::non_negative);
  const std::optional<Input> name = node.find("name");
  for (int i = 0; i < count; ++i) {
    const Pair& pair = pairs[i];
    const std::vector<double> along = along_the_edge(node, pair, a, b, side);
    for (std::size_t k = 0; k < along.size(); ++k) {
      Link link;
      link.left = place_end(pair.left, a, side, along[k], ends[0]);
      link.right = place_end(pair.right, b, opposite(side), along[k], ends[1]);
      require_inertia(link.left, a, side, ends[0]);
      require_inertia(link.right, b, side, ends[1]);
      link.direction = outward(side);
      link.gap = gaps[i];
      link.name = text_of(pair.left, a) + "-" + text_of(pair.right, b);
      if (name) link.name = count == 1 ? name->as_text() : fmt::format("{}.{}", name->as_text(), i + 1);
      if (along.size() > 1) link.name += fmt::format("#{}", k + 1);
      if (name && (link.name.empty() || link.name == "." || link.name == ".." || link.name.find('/') != std::string::npos))
        name->fail("a name must not be empty, \".\" or \"..\", or contain \"/\"; type a name such as third_floor");
      for (const Link& other : model.links)
        if (other.name == link.name)
          (name ? *name : between)
              .fail(fmt::format("a link \"{}\" exists already; give this one a name of its own, such as name: second", link.name));
      // Points that press together share the masses of their floors.
      const double share = static_cast<double>(along.size());
      LinkLaw law = kinds.read_law(node, std::span(keys), link.gap, link.left.point.mass / share, link.right.point.mass / share,
                                   static_cast<int>(model.links.size()));
      link.law = law.law;
      link.formula = law.formula;
      link.reduced_mass = law.reduced_mass;
      link.reduced_mass_given = law.reduced_mass_given;
      link.parameters = std::move(law.parameters);
      link.contact = std::move(law.contact);
      read_friction(node, a, b, link);
      const double overlap =
          displacement_along(link.left, a, link.direction) - displacement_along(link.right, b, link.direction) - link.gap;
      if (overlap > 0)
        gap_node.fail(fmt::format("{} and {} overlap by {} at the start; a gap of {} or more keeps them apart", a.name, b.name,
                                  format_quantity(overlap, dimension::length),
                                  format_quantity(overlap + link.gap, dimension::length)));
      model.links.push_back(std::move(link));
    }
  }
}

}  // namespace pounding
