#include <pounding/stepping/held_forces.hpp>

#include <algorithm>
#include <optional>

#include <pounding/stepping/interpolation.hpp>

namespace pounding {
namespace {

// Maximum number of evaluations per peak. Each vertex of a parabola roughly squares the relative error.
constexpr int max_vertices = 3;
// At smaller distances from a sample, the force differs by less than the round-off of the motion.
constexpr double min_distance = 1e-4;

// Abscissa of the maximum of the parabola through three points; nullopt if it has none.
std::optional<double> vertex(double a, double fa, double b, double fb, double c, double fc) {
  const double left = (fb - fa) / (b - a), right = (fc - fb) / (c - b), bend = (right - left) / (c - a);
  if (!(bend < 0)) return std::nullopt;
  return 0.5 * (a + b) - left / (2 * bend);
}

}  // namespace

HeldForces::Sample HeldForces::at(double s, const Instant& x, const Trial& kept) {
  using enum Instant::Column;
  const Instant& y = kept.end;
  const LinkSet& links = equations_.links;
  const Parabola parabola(s);
  Sample sample{s, parabola.begin * x.force + parabola.middle * kept.force_middle + parabola.end * y.force};
  // Short ground motions are known only at the ends and the middle of a step.
  if (kept.short_motions) return sample;
  const double time = x.time + s * kept.h;
  ground_.resize(x.ground.size());
  equations_.supports.accelerations(time, ground_);
  by_ground_ = x.by_ground;
  if (links.driven()) equations_.supports.relative_motion(time, ground_, by_ground_);
  // Cubic interpolation as for the middle of a step, so that both agree there.
  const Cubic cubic(s, kept.h);
  motions_.resize(static_cast<std::size_t>(links.size()));
  for (int i = 0; i < links.size(); ++i) {
    if (links.is_spring(i)) continue;
    const LinkMotion begin = links.motion(i, x), end = links.motion(i, y);
    if (links.is_held(i)) {
      motions_[i] = {begin.penetration, 0};
      continue;
    }
    motions_[i] = {cubic.begin * begin.penetration + cubic.end * end.penetration + cubic.slope_begin * begin.rate +
                       cubic.slope_end * end.rate,
                   cubic.begin * begin.rate + cubic.end * end.rate + cubic.slope_begin * links.acceleration(i, x) +
                       cubic.slope_end * links.acceleration(i, y)};
  }
  acceleration_ = -equations_.supports.push(ground_) - cubic.begin * (x.motion.col(ku) + x.motion.col(cv)) -
                  cubic.end * (y.motion.col(ku) + y.motion.col(cv)) -
                  cubic.slope_begin * (x.motion.col(kv) + x.motion.col(ca)) -
                  cubic.slope_end * (y.motion.col(kv) + y.motion.col(ca));
  if (equations_.has_pseudo_forces()) {
    const Parabola parabola(s);
    acceleration_ -=
        parabola.begin * x.pseudo_force + parabola.middle * kept.pseudo_force_middle + parabola.end * y.pseudo_force;
  }
  equations_.balance(motions_, by_ground_, true, true, sample.force, acceleration_);
  return sample;
}

void HeldForces::find_peak(int contact, const Instant& x, const Trial& kept, std::vector<Sample> samples) {
  const auto force = [contact](const Sample& sample) { return sample.force[contact]; };
  for (int i = 0; i < max_vertices; ++i) {
    const auto best = std::ranges::max_element(samples, {}, force) - samples.begin();
    const auto first = std::clamp<std::ptrdiff_t>(best - 1, 0, static_cast<std::ptrdiff_t>(samples.size()) - 3);
    const Sample &a = samples[first], &b = samples[first + 1], &c = samples[first + 2];
    const std::optional<double> s = vertex(a.s, force(a), b.s, force(b), c.s, force(c));
    if (!s || !(*s > 0 && *s < 1)) break;
    const auto place = std::ranges::lower_bound(samples, *s, {}, &Sample::s);
    if (std::min(place->s - *s, *s - std::prev(place)->s) < min_distance) break;
    samples.insert(place, at(*s, x, kept));
  }
  const Sample& top = *std::ranges::max_element(samples, {}, force);
  equations_.links.of_contact(contact).log.record_peak(x.time + top.s * kept.h, force(top));
}

void HeldForces::record_peaks(const Instant& x, const Trial& kept) {
  const LinkSet& links = equations_.links;
  std::vector<Sample> samples;
  for (int i = 0; i < links.contacts(); ++i) {
    if (!links.is_held(i)) continue;
    // The true maximum is assumed to exceed the samples by at most their spread. If it cannot exceed the peak of the
    // impact, skip.
    const auto [minimum, maximum] = std::minmax({x.force[i], kept.force_middle[i], kept.end.force[i]});
    if (maximum + (maximum - minimum) <= links.of_contact(i).impacts().back().peak_force) continue;
    if (samples.empty())
      samples = {{0, x.force}, at(0.25, x, kept), {0.5, kept.force_middle}, at(0.75, x, kept), {1, kept.end.force}};
    find_peak(i, x, kept, samples);
  }
}

}  // namespace pounding
