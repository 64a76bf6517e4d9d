#include <pounding/model/drawing.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include <pounding/core/units.hpp>

namespace pounding {
namespace {

// Ends farther apart than this across the direction of their contact do not meet [m].
constexpr double reach = 0.5;
// A gap may differ from the distance drawn by this part of itself.
constexpr double relative_rounding = 1e-3;
// Distances are rounded to nanometres, so that 18.02 m less 18 m is 20 mm to the last bit [1/m].
constexpr double nanometres = 1e9;

std::string metres(double length) { return format_quantity(std::abs(length) * nanometres < 1 ? 0 : length, dimension::length, 6); }

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
    return fmt::format("{} ({} = {}) and {} ({} = {})", placed_text(left, a), axes[axis], metres(left.point.position[axis]),
                       placed_text(right, b), axes[axis], metres(right.point.position[axis]));
  }
  // How to bring the second structure to another distance from the first one.
  std::string move(Side side, double farther) const {
    const double along = outward(side).sum() * farther;
    return fmt::format("move {} by {} along {} with its origin", b.name, metres(along),
                       side == Side::plus_x || side == Side::minus_x ? "x" : "y");
  }
};

void require_facing(const Ends& ends, int axis) {
  if (std::abs(ends.left.point.position[axis] - ends.right.point.position[axis]) <= reach) return;
  const bool in_height = axis == 2;
  const double up = ends.left.point.position.z();
  throw ModelError(ModelOption::between,
                   fmt::format("{} do not face each other; {}", ends.at(axis),
                               in_height ? fmt::format("link ends that are level, or the column there, as in {{structure: {}, elevation: {}}}",
                                                       ends.b.name, metres(up))
                                         : "link ends that do, or move one of the two by its origin"));
}

}  // namespace

bool are_drawn(const Structure& first, const Structure& second) { return first.surface->plan() && second.surface->plan(); }

double drawn_gap(const Model& model, const LinkEnd& left, const LinkEnd& right, Side side, std::optional<double> asked) {
  const Ends ends{model.structures[left.structure], model.structures[right.structure], left, right};
  const bool along_x = side == Side::plus_x || side == Side::minus_x;
  const double drawn = outward(side).dot(right.point.position - left.point.position);
  if (drawn < -drawn_rounding)
    throw ModelError(ModelOption::between,
                     fmt::format("{} overlap by {}; {}{}", ends.at(along_x ? 0 : 1), metres(-drawn), ends.move(side, asked.value_or(0) - drawn),
                                 asked ? "" : ", or farther"));
  require_facing(ends, 2);
  // A plane frame has no place across its plane.
  if (ends.a.dimension == 3 && ends.b.dimension == 3) require_facing(ends, along_x ? 1 : 0);
  if (!asked) return std::max(0.0, std::round(drawn * nanometres) / nanometres);
  if (std::abs(*asked - drawn) > std::max(drawn_rounding, relative_rounding * *asked))
    throw ModelError(ModelOption::gap,
                     fmt::format("is {}, but {} are drawn {} apart; leave the gap out to take this distance, or {}", metres(*asked),
                                 ends.at(along_x ? 0 : 1), metres(drawn), ends.move(side, *asked - drawn)));
  return *asked;
}

}  // namespace pounding
