#include <pounding/run/separation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pounding/model/modes.hpp>

namespace pounding {
namespace {

// Round-off may make the square negative; NaN for an unknown correlation.
double combined(double a, double b, double correlation) {
  const double square = a * a + b * b - 2 * correlation * a * b;
  return square < 0 ? 0 : std::sqrt(square);
}

}  // namespace

double double_difference(double period_a, double damping_a, double period_b, double damping_b) {
  if (!(period_a > 0 && period_b > 0 && damping_a > 0 && damping_b > 0) || std::isinf(period_a) || std::isinf(period_b))
    return std::numeric_limits<double>::quiet_NaN();
  const double r = period_b / period_a, square = r * r, both = damping_a * damping_b;
  return 8 * std::sqrt(both) * (damping_b + damping_a * r) * r * std::sqrt(r) /
         ((1 - square) * (1 - square) + 4 * both * r * (1 + square) +
          4 * (damping_a * damping_a + damping_b * damping_b) * square);
}

std::vector<LinkSeparation> separations(const Model& model, const Extremes& approach) {
  std::vector<Mode> first;
  for (const Structure& s : model.structures) {
    const std::vector<Mode> lowest = modes(s, 1, model.mode_solver);
    first.push_back(lowest.empty() ? Mode{} : lowest.front());
  }
  std::vector<LinkSeparation> all;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    const int a = link.left.structure, b = link.right.structure;
    const double ua = approach.peak(3 * i), ub = approach.peak(3 * i + 1);
    LinkSeparation s{link.name,
                     link.gap,
                     std::max(0.0, approach.max[3 * i + 2]),
                     approach.t_max[3 * i + 2],
                     ua,
                     ub,
                     ua + ub,
                     combined(ua, ub, 0),
                     0};
    // A wall moves with the ground and has no displacement to combine.
    const bool by_wall = model.structures[a].is_rigid() || model.structures[b].is_rigid();
    s.ddc = combined(
        ua, ub,
        by_wall ? 0.0
                : double_difference(first[a].period, first[a].damping_ratio, first[b].period, first[b].damping_ratio));
    all.push_back(s);
  }
  return all;
}

}  // namespace pounding
