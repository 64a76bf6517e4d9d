#include <pounding/stepping/springs/spring_corners.hpp>

#include <algorithm>
#include <cmath>

namespace pounding {
namespace {

// A corner within this distance of an end of the trial, relative to its length, counts as being at that end.
constexpr double corner_part = 1e-3;
// With relief, so does a corner within this distance relative to the maximum step: a step that ends at a corner may
// leave this much to the next.
constexpr double shortest_to_corner = 1e-4;
// Equivalent distance for a bend of a rate-dependent force, relative to the maximum step: forces in the step that
// begins there come from the state before it.
constexpr double near_bend = 1e-6;
// A smaller jump of the slope, as a fraction of the initial stiffness, is ignored.
constexpr double min_jump = 1e-6;

// True if a spring has zero slope over the whole range of the cubic between two motions. The cubic stays within a third
// of the step times the rates from its ends, and all deformations between two elastic ones are elastic.
bool stays_elastic(const Spring& spring, ConstElementMemory memory, const LinkMotion& begin, const LinkMotion& end,
                   double h) {
  const double third = h / 3 * std::max(std::abs(begin.rate), std::abs(end.rate));
  const laws::Response low = spring.evaluate(memory, {std::min(begin.penetration, end.penetration) - third, 0});
  const laws::Response high = spring.evaluate(memory, {std::max(begin.penetration, end.penetration) + third, 0});
  return low.by_penetration == 0 && high.by_penetration == 0 && low.force == high.force;
}

// Fraction (0 to 1) at the first corner of one spring between two motions. `near`: a corner within this distance of an
// end counts as being at that end.
std::optional<double> corner(const Spring& spring, ConstElementMemory memory, const LinkMotion& begin,
                             const LinkMotion& end, double h, double near) {
  if (stays_elastic(spring, memory, begin, end, h)) return std::nullopt;
  const CubicPenetration between(begin, end, h);
  const double turn = begin.rate * end.rate < 0 ? std::clamp(between.turn(), 0.0, 1.0) : 1.0;
  const auto inside = [near](double s) { return s > near && s < 1 - near; };
  // The deformation is monotonic between `low` and `high`.
  const auto onset = [&](double deformation, double low, double high) {
    const double way = between.at(high) - between.at(low);
    while (high - low > 1e-6) {
      const double middle = 0.5 * (low + high);
      ((between.at(middle) - deformation) * way > 0 ? high : low) = middle;
    }
    return high;
  };
  const double turned = turn < 1 ? between.at(turn) : end.penetration;
  if (const auto deformation = spring.corner(memory, turned))
    if (const double s = onset(*deformation, 0, turn); inside(s)) return s;
  if (turn == 1) return std::nullopt;
  const bool turns_sharply =
      std::abs(spring.slope_lost(memory, turned)) > min_jump * (spring.stiffness() + spring.first_slope());
  if (turns_sharply) return inside(turn) ? std::optional(turn) : std::nullopt;
  if (const auto deformation = spring.corner(memory, end.penetration))
    if (const double s = onset(*deformation, turn, 1); inside(s)) return s;
  return std::nullopt;
}

}  // namespace

std::optional<double> SpringCorners::first(const Instant& now, const Trial& trial, double longest_step) const {
  std::vector<LinkMotion> begin, end;
  const auto stays = [&](const Eigen::VectorXd& force) {
    return force.segment(links_.contacts(), links_.springs()) == now.force.segment(links_.contacts(), links_.springs());
  };
  const bool bends = springs_.any() && !(stays(trial.force_middle) && stays(trial.end.force));
  if (bends) springs_.follow_first_slopes(now, trial, begin, end);
  const double near = springs_.any() ? std::max(corner_part, shortest_to_corner * longest_step / trial.h) : corner_part;
  std::optional<double> first;
  for (int i = links_.contacts(); i < links_.frictions_from(); ++i) {
    if (links_.is_coupled(i) || !links_.spring(i).has_corners()) continue;
    const std::size_t k = i - links_.contacts();
    const LinkMotion from = bends ? begin[k] : links_.motion(i, now), to = bends ? end[k] : links_.motion(i, trial.end);
    const Spring& spring = links_.spring(i);
    const std::optional<double> s =
        spring.bends_with_rate()
            ? spring.bend(links_.of_spring(i), {links_.jet(i, now), links_.jet(i, trial.end), trial.h},
                          near_bend * longest_step / trial.h)
            : corner(spring, links_.of_spring(i), from, to, trial.h, near);
    if (s && (!first || *s < *first)) first = s;
  }
  return first;
}

}  // namespace pounding
