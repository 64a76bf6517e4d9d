#include <pounding/model/facing.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/model/drawing.hpp>
#include <pounding/model/refuse_option.hpp>

namespace pounding {
namespace {

// Elevations are equal up to this relative difference.
constexpr double elevation_rounding = 1e-6;

bool are_level(const Floor& a, const Floor& b, std::optional<double> level_within) {
  const double allowance = elevation_rounding * std::max({std::abs(*a.elevation), std::abs(*b.elevation), 1e-3});
  return std::abs(*a.elevation - *b.elevation) <= level_of(a, b, level_within) + allowance;
}

// For each floor of the left structure, the level floor of the right one, -1 for none. The nearest floors are paired
// first, each at most once.
std::vector<int> level_floors(const Structure& left, const Structure& right, std::optional<double> level_within) {
  struct Candidate {
    double apart;
    int left, right;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < left.floors.size(); ++i)
    for (std::size_t j = 0; j < right.floors.size(); ++j)
      if (const Floor &a = left.floors[i], &b = right.floors[j]; are_level(a, b, level_within))
        candidates.push_back({std::abs(*a.elevation - *b.elevation), static_cast<int>(i), static_cast<int>(j)});
  std::ranges::stable_sort(candidates, {}, &Candidate::apart);
  std::vector<int> partner(left.floors.size(), -1);
  std::vector<bool> taken(right.floors.size(), false);
  for (const Candidate& each : candidates)
    if (partner[each.left] < 0 && !taken[each.right]) {
      partner[each.left] = each.right;
      taken[each.right] = true;
    }
  return partner;
}

bool has_elevations(const Structure& s) {
  return !s.floors.empty() &&
         std::all_of(s.floors.begin(), s.floors.end(), [](const Floor& f) { return f.elevation.has_value(); });
}

// Structures without columns to hit, or without heights: floors are paired by number.
std::vector<LinkPair> floors_by_number(int a, int b, const Structure& left, const Structure& right,
                                       std::optional<double> level_within) {
  if (left.is_rigid() && right.is_rigid())
    refuse(ModelOption::between, "both ends are walls; one of them must be able to move");
  for (const Structure* s : {&left, &right})
    if (!s->is_rigid() && s->floors.empty())
      refuse(ModelOption::between,
             fmt::format("{0} has no floors; name a node, as in {{structure: {0}, node: NAME}}, and remove \"floors\"",
                         s->name));
  const int floors_left = static_cast<int>(left.floors.size()), floors_right = static_cast<int>(right.floors.size());
  const int count = left.is_rigid()    ? floors_right
                    : right.is_rigid() ? floors_left
                                       : std::min(floors_left, floors_right);
  const bool placed = has_elevations(left) && has_elevations(right);
  std::vector<LinkPair> pairs;
  for (int i = 0; i < count; ++i) {
    if (placed && !are_level(left.floors[i], right.floors[i], level_within))
      refuse(
          ModelOption::between,
          fmt::format("floor {0} of {1} is {2:.6g} m up and floor {0} of {3} {4:.6g} m: they do not face each other; "
                      "without \"floors: all\" a link names its two floors, as in [{1}.{0}, {3}.{0}]",
                      i + 1, left.name, *left.floors[i].elevation, right.name, *right.floors[i].elevation));
    LinkPair pair{{.structure = a, .is_numbered = true}, {.structure = b, .is_numbered = true}};
    if (!left.is_rigid()) pair.left.floor = i;
    if (!right.is_rigid()) pair.right.floor = i;
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<LinkPair> facing_floors(FacingFloors choice, int a, int b, const Structure& left, const Structure& right,
                                    std::optional<double> level_within) {
  const bool sticks = left.dimension == 1 && right.dimension == 1 && choice == FacingFloors::all;
  if (sticks || !has_elevations(left) || !has_elevations(right))
    return floors_by_number(a, b, left, right, level_within);
  const double lower_roof = std::min(*left.floors.back().elevation, *right.floors.back().elevation);
  const std::vector<int> partner_of_left = level_floors(left, right, level_within);
  const auto facing = [&](int floor, bool from_left) -> std::optional<int> {
    if (from_left) return partner_of_left[floor] < 0 ? std::nullopt : std::optional(partner_of_left[floor]);
    const auto found = std::ranges::find(partner_of_left, floor);
    return found == partner_of_left.end() ? std::nullopt
                                          : std::optional(static_cast<int>(found - partner_of_left.begin()));
  };
  struct Placed {
    double elevation;
    LinkPair pair;
  };
  std::vector<Placed> pairs;
  const auto visit = [&](const Structure& s, const Structure& other, bool from_left) {
    for (std::size_t i = 0; i < s.floors.size(); ++i) {
      const double z = *s.floors[i].elevation;
      const std::optional<int> partner = facing(static_cast<int>(i), from_left);
      if (partner && !from_left) continue;  // found from the left
      if (!partner && z > lower_roof * (1 + elevation_rounding)) continue;
      if (!partner && choice == FacingFloors::level) continue;
      if (!partner && choice == FacingFloors::all)
        refuse(ModelOption::between,
               fmt::format(
                   "floor {} of {} is {:.6g} m up and faces no floor of {}; type floors: any to let it hit the column "
                   "there, or floors: level to link only those that face each other",
                   i + 1, s.name, z, other.name));
      LinkPair pair{{.structure = a, .is_numbered = true}, {.structure = b, .is_numbered = true}};
      PairEnd& own = from_left ? pair.left : pair.right;
      PairEnd& met = from_left ? pair.right : pair.left;
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
    refuse(ModelOption::between,
           fmt::format("no floor of {} is level with one of {}; type floors: any to let floors hit the columns",
                       left.name, right.name));
  std::ranges::stable_sort(pairs, {}, &Placed::elevation);
  std::vector<LinkPair> sorted;
  for (Placed& placed : pairs) sorted.push_back(std::move(placed.pair));
  return sorted;
}

// Without a choice of floors, the structure must have a single one.
void complete(PairEnd& end, const Structure& s, ModelOption side) {
  if (s.is_rigid()) {
    if (end.elevation || !end.node.empty()) refuse(side, fmt::format("\"{}\" is a wall; type {}", s.name, s.name));
    return;
  }
  if (end.floor || end.elevation || !end.node.empty()) return;
  if (s.floors.size() == 1) {
    end.floor = 0;
    return;
  }
  if (s.floors.empty())
    refuse(side, fmt::format("{0} has no floors; name a node, as in {{structure: {0}, node: NAME}}", s.name));
  refuse(side, fmt::format("which of the {} floors of {}? Type {}.{}, or add floors: all", s.floors.size(), s.name,
                           s.name, s.floors.size()));
}

void require_structure(const Model& model, int number, ModelOption side) {
  if (number < 0 || number >= static_cast<int>(model.structures.size()))
    refuse(side, fmt::format("structure {} is not one of the {} structures; use the handle returned by add()", number,
                             model.structures.size()));
}

PairEnd end_of(const ContactLocation& location, const Structure& s, ModelOption side) {
  PairEnd end{.structure = location.structure, .elevation = location.elevation, .node = location.node};
  if (!location.floor) return end;
  checked(side, [&] { require_floor(s, *location.floor, fmt::format("{}.{}", s.name, *location.floor)); });
  end.floor = *location.floor - 1;
  end.is_numbered = true;
  return end;
}

}  // namespace

double level_of(const Floor& a, const Floor& b, std::optional<double> level_within) {
  return level_within.value_or(std::max({usual_level, a.beam_depth, b.beam_depth}));
}

Side facing_side(const Structure& a, const Structure& b) {
  if (!are_drawn(a, b)) return Side::plus_x;
  const auto [ax0, ax1, ay0, ay1] = *a.surface->plan();
  const auto [bx0, bx1, by0, by1] = *b.surface->plan();
  const auto beside = [](double a0, double a1, double b0, double b1, Side plus, Side minus) -> std::optional<Side> {
    // Two points at the same position: neither is to the left of the other.
    if (a1 - a0 + b1 - b0 <= drawn_rounding && std::abs(b0 - a0) <= drawn_rounding) return {};
    if (b0 >= a1 - drawn_rounding) return plus;
    if (a0 >= b1 - drawn_rounding) return minus;
    return {};
  };
  const auto left_first = [&, ax0 = ax0, ax1 = ax1, bx0 = bx0, bx1 = bx1](Side side) {
    if (side == Side::minus_x)
      refuse(ModelOption::between,
             fmt::format("the order of {0} and {1} is wrong: {0} extends from x = {2:.6g} m to {3:.6g} m, and {1} from "
                         "x = {4:.6g} m to {5:.6g} m; name the left one first, between: [{0}, {1}]",
                         b.name, a.name, bx0, bx1, ax0, ax1));
    return side;
  };
  std::optional<Side> along_x = beside(ax0, ax1, bx0, bx1, Side::plus_x, Side::minus_x);
  // Plane frames may overlap in plan at different heights: their ends decide.
  if (a.dimension < 3 || b.dimension < 3) return left_first(along_x.value_or(Side::plus_x));
  std::optional<Side> along_y = beside(ay0, ay1, by0, by1, Side::plus_y, Side::minus_y);
  // A frame with its end in line with the edge of the other one is apart only in the other direction.
  const double apart_x = std::max(bx0 - ax1, ax0 - bx1), apart_y = std::max(by0 - ay1, ay0 - by1);
  if (along_x && along_y && apart_x > drawn_rounding && apart_y <= drawn_rounding) along_y.reset();
  if (along_x && along_y && apart_y > drawn_rounding && apart_x <= drawn_rounding) along_x.reset();
  std::vector<Side> sides;
  for (const auto& side : {along_x, along_y})
    if (side) sides.push_back(*side);
  if (sides.empty())
    refuse(ModelOption::between,
           fmt::format(
               "{0} and {1} overlap in plan: {0} extends from x = {2:.6g} m to {3:.6g} m and from y = {4:.6g} m "
               "to {5:.6g} m, {1} from x = {6:.6g} m to {7:.6g} m and from y = {8:.6g} m to {9:.6g} m; give one of "
               "them an origin, such as origin: [{10:.6g} m, 0 m]",
               a.name, b.name, ax0, ax1, ay0, ay1, bx0, bx1, by0, by1, ax1 + 0.1));
  if (sides.size() > 1)
    refuse(ModelOption::between,
           fmt::format("{} and {} are apart along both x and y, so no sides face each other; move the origin of one",
                       a.name, b.name));
  return left_first(sides.front());
}

void require_floor(const Structure& s, int number, const std::string& text) {
  const int count = static_cast<int>(s.floors.size());
  if (s.is_rigid()) refuse(fmt::format("\"{}\" is a wall and has no floors; type {}", s.name, s.name));
  if (count == 0)
    refuse(fmt::format("{} has no floors; name a node, as in {{structure: {}, node: NAME}}", s.name, s.name));
  if (count == 1 && number != 1)
    refuse(fmt::format("\"{}\" names no floor of {}, which has one; type {}", excerpt(text), s.name, s.name));
  if (number < 1 || number > count)
    refuse(fmt::format("\"{}\" names no floor of {}, which has the floors 1 to {}; type {}.{}", excerpt(text), s.name,
                       count, s.name, count));
}

std::vector<LinkPair> pairs_of(const Model& model, const ContactLocation& left, const ContactLocation& right,
                               std::optional<FacingFloors> floors, std::optional<double> level_within) {
  require_structure(model, left.structure, ModelOption::left);
  require_structure(model, right.structure, ModelOption::right);
  if (level_within && !(*level_within >= 0 && std::isfinite(*level_within)))
    refuse(ModelOption::level_within, "must be finite and not negative, as in level_within: 50 mm");
  const Structure &a = model.structures[left.structure], &b = model.structures[right.structure];
  PairEnd first = end_of(left, a, ModelOption::left), second = end_of(right, b, ModelOption::right);
  if (left.structure == right.structure)
    refuse(ModelOption::between,
           fmt::format("\"{}\" cannot hit itself; name two structures, the left one first", a.name));
  if (floors) {
    const auto is_named = [](const PairEnd& end) { return end.floor || end.elevation || !end.node.empty(); };
    if (is_named(first) || is_named(second))
      refuse_idle(ModelOption::floors, "links all floors, but \"between\" names one; keep one of the two");
    return facing_floors(*floors, left.structure, right.structure, a, b, level_within);
  }
  complete(first, a, ModelOption::left);
  complete(second, b, ModelOption::right);
  return {{first, second}};
}

}  // namespace pounding
