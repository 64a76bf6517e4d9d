#include <pounding/structures/sliding_spring.hpp>

#include <algorithm>
#include <cmath>

#include <pounding/base/gauss.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding {
namespace {

// Within this relative distance of the friction limit, only the slip decides whether the slider slides.
constexpr double at_limit = 1e-9;
// A phase ends at a sign change of a function between two of these instants.
constexpr int looks = 8;
constexpr int max_phases = 16;

}  // namespace

void SlidingFriction::check() const {
  laws::require_positive("weight", weight);
  if (!(radius > 0)) laws::refuse("radius", radius, "positive; infinite for a flat surface");
  laws::require_positive("friction", fast);
  if (!(slow > 0 && slow <= fast))
    laws::refuse("friction", slow, "positive, with the first value at most the second, " + laws::number_text(fast));
  laws::require_positive("rate", rate);
  laws::require_positive("yield_displacement", sliding_deformation);
}

double SlidingFriction::coefficient(double velocity) const noexcept {
  return fast - (fast - slow) * std::exp(-rate * std::abs(velocity));
}

double SlidingFriction::slope_of_coefficient(double velocity) const noexcept {
  return std::copysign((fast - slow) * rate * std::exp(-rate * std::abs(velocity)), velocity);
}

// Force q if the path from the accepted state ends with this motion.
double SlidingSpring::friction(const State& state, const LinkMotion& motion) const noexcept {
  const double maximum = law_.coefficient(motion.rate) * law_.weight;
  return std::clamp(law_.stick() * (motion.penetration - state.slip), -maximum, maximum);
}

void SlidingSpring::start(ElementMemory memory, const LinkMotion& motion) const {
  State& kept = of(memory).kept;
  if (kept.deformation == 0 && motion.penetration != 0) kept = slid(kept, motion);
}

void SlidingSpring::load(ElementMemory memory, double deformation) const {
  State& kept = of(memory).kept;
  const State before = kept;
  kept = slid(kept, {deformation, 0});
  kept.lost += law_.coefficient(0) * law_.weight * std::abs(kept.slip - before.slip);
}

laws::Response SlidingSpring::evaluate(ConstElementMemory memory, const LinkMotion& motion) const noexcept {
  const State& kept = of(memory).kept;
  const double k0 = law_.stick(), elastic = k0 * (motion.penetration - kept.slip);
  const double maximum = law_.coefficient(motion.rate) * law_.weight;
  if (std::abs(elastic) <= maximum) return {-k0 * kept.slip, 0, 0};
  const double q = std::copysign(maximum, elastic);
  return {q - k0 * motion.penetration, -k0,
          std::copysign(law_.weight, elastic) * law_.slope_of_coefficient(motion.rate)};
}

SlidingSpring::State SlidingSpring::slid(State state, const LinkMotion& motion) const noexcept {
  const double elastic = motion.penetration - state.slip;
  if (std::abs(elastic) > reach(motion.rate))
    state.slip = motion.penetration - std::copysign(reach(motion.rate), elastic);
  state.deformation = motion.penetration;
  state.rate = motion.rate;
  return state;
}

// At the onset of sticking it follows the friction limit for a while, to within round-off.
bool SlidingSpring::slides(const State& state, const Jet& at) const noexcept {
  constexpr double rounding = 1e-13;
  const double limit = reach(at.v);
  return std::abs(at.x - state.slip) > limit + rounding * (limit + std::abs(at.x));
}

// Phase that begins at one instant, and its end on the path to another; that other one if the phase continues.
SlidingSpring::Phase SlidingSpring::phase(State state, const Quintic& path, double from, double to) const noexcept {
  const Jet first = path.at(from);
  const double way = std::copysign(1.0, first.x - state.slip), limit = reach(first.v);
  const bool sliding =
      std::abs(first.x - state.slip) > (1 - at_limit) * limit && way * balanced_slip_rate(first, way) > 0;
  if (!sliding) state = slid(state, {first.x, first.v});
  double low = from;
  const auto is_over = [&](double s) {
    const Jet at = path.at(s);
    return sliding ? way * balanced_slip_rate(at, way) < 0 : slides(state, at);
  };
  for (int i = 1; i <= looks; ++i) {
    double high = from + (to - from) * i / looks;
    if (!is_over(high)) {
      low = high;
      continue;
    }
    while (high - low > 1e-14) {
      const double middle = 0.5 * (low + high);
      (is_over(middle) ? high : low) = middle;
    }
    return {sliding, high};
  }
  return {sliding, to};
}

// Each stage detects sliding independently. It does not detect sticking: the earlier slip in the same step is missing
// in all stages.
std::optional<double> SlidingSpring::bend(ConstElementMemory memory, const Quintic& path, double near) const noexcept {
  constexpr double near_onset = 1e-3;
  const Phase now = phase(of(memory).kept, path, 0, 1);
  const double minimum = now.slides ? near : std::max(near, near_onset);
  return now.end > minimum && now.end < 1 - minimum ? std::optional(now.end) : std::nullopt;
}

// Follows an accepted step from its beginning.
SlidingSpring::State SlidingSpring::follow(State state, const LinkStep& step, double to) const noexcept {
  const double k0 = law_.stick();
  const Quintic way = path(step);
  const auto motion = [&](double s) {
    const Jet at = way.at(s);
    return LinkMotion{at.x, at.v};
  };
  double from = 0;
  for (int i = 0; i < max_phases && from < to; ++i) {
    const auto [sliding, until] = phase(state, way, from, to);
    const LinkMotion begin = motion(from), end = motion(until);
    if (sliding) {
      // Loss: work of q minus the energy stored in its spring.
      const auto power = [&](double s) {
        const LinkMotion at = motion(s);
        return friction(state, at) * at.rate;
      };
      const double work = (step.end - step.begin) * gauss_integral(power, from, until);
      const double before = friction(state, begin), after = friction(state, end);
      state.lost += work - 0.5 * (after - before) * (after + before) / k0;
    }
    state = slid(state, end);
    from = until;
  }
  return slid(state, motion(to));
}

void SlidingSpring::accept(ElementMemory memory, const LinkStep& step) const {
  Memory& own = of(memory);
  own.before = own.kept;
  own.kept = follow(own.kept, step, 1);
}

// The friction depends on the velocity up to a value of r |v|.
bool SlidingSpring::bends_sharply(const LinkStep& step) const noexcept {
  constexpr double saturated = 10;
  return law_.rate * std::min(std::abs(step.motion_begin.rate), std::abs(step.motion_end.rate)) < saturated;
}

Spring::Instant SlidingSpring::inside(ConstElementMemory memory, const LinkStep& step, double s,
                                      double deformation) const noexcept {
  const State state = follow(of(memory).before, step, s);
  return {friction(state, {deformation, interpolate(step, s).rate}) - law_.stick() * deformation, state.lost};
}

ElementEnergy SlidingSpring::energy(ConstElementMemory memory) const noexcept {
  const State& kept = of(memory).kept;
  const double k0 = law_.stick(), elastic = kept.deformation - kept.slip;
  return {.lost = kept.lost, .stored_correction = 0.5 * k0 * (elastic * elastic - kept.deformation * kept.deformation)};
}

}  // namespace pounding
