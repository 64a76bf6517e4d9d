#include <pounding/structures/sliding_spring.hpp>

#include <algorithm>
#include <cmath>

#include <pounding/laws/checks.hpp>
#include <pounding/laws/gauss.hpp>

namespace pounding {
namespace {

// Where the rate of a kept step changes its sign, from 0 to 1; 1 where it does not.
double turn_of(const LinkStep& step) {
  if (!(step.motion_begin.rate * step.motion_end.rate < 0)) return 1;
  return path(step).turn(step.motion_end.rate > 0);
}

}  // namespace

void SlidingFriction::check() const {
  laws::require_positive("weight", weight);
  laws::require_positive("radius", radius);
  laws::require_positive("friction", fast);
  if (!(slow > 0 && slow <= fast)) laws::refuse("friction", slow, "positive and, the first of two, at most the second, " + laws::number_text(fast));
  laws::require_positive("rate", rate);
  laws::require_positive("yield_displacement", sliding_deformation);
}

double SlidingFriction::coefficient(double velocity) const noexcept { return fast - (fast - slow) * std::exp(-rate * std::abs(velocity)); }

double SlidingFriction::slope_of_coefficient(double velocity) const noexcept {
  return std::copysign((fast - slow) * rate * std::exp(-rate * std::abs(velocity)), velocity);
}

// The force q where the way from the kept state on ends with this motion.
double SlidingSpring::friction(const State& state, const LinkMotion& motion) const noexcept {
  const double most = law_.coefficient(motion.rate) * law_.weight;
  return std::clamp(law_.stick() * (motion.penetration - state.slip), -most, most);
}

void SlidingSpring::start(const LinkMotion& motion) {
  if (kept_.deformation == 0 && motion.penetration != 0) kept_ = slid(kept_, motion);
}

laws::Response SlidingSpring::evaluate(const LinkMotion& motion) const noexcept {
  const double k0 = law_.stick(), elastic = k0 * (motion.penetration - kept_.slip);
  const double most = law_.coefficient(motion.rate) * law_.weight;
  if (std::abs(elastic) <= most) return {-k0 * kept_.slip, 0, 0};
  const double q = std::copysign(most, elastic);
  return {q - k0 * motion.penetration, -k0, std::copysign(law_.weight, elastic) * law_.slope_of_coefficient(motion.rate)};
}

SlidingSpring::State SlidingSpring::slid(State state, const LinkMotion& motion) const noexcept {
  const double elastic = motion.penetration - state.slip, most = law_.coefficient(motion.rate) * law_.weight / law_.stick();
  if (std::abs(elastic) > most) state.slip = motion.penetration - std::copysign(most, elastic);
  state.deformation = motion.penetration;
  state.rate = motion.rate;
  return state;
}

std::optional<double> SlidingSpring::corner(double deformation) const noexcept {
  const double most = law_.coefficient(kept_.rate) * law_.weight / law_.stick();
  const double at = kept_.slip + std::copysign(most, deformation - kept_.deformation);
  const bool is_between = (at - kept_.deformation) * (deformation - at) > 0;
  return is_between ? std::optional(at) : std::nullopt;
}

// Along the motion between two instants of a step without a turn: it sticks, and from some point on it slides.
SlidingSpring::State SlidingSpring::follow(State state, const LinkStep& step, double from, double to) const noexcept {
  const double k0 = law_.stick();
  const auto slides = [&](const LinkMotion& at) { return std::abs(k0 * (at.penetration - state.slip)) > law_.coefficient(at.rate) * law_.weight; };
  const State end = slid(state, interpolate(step, to));
  if (!slides(interpolate(step, to))) return end;
  double low = from, high = from;
  if (!slides(interpolate(step, from))) {
    high = to;
    while (high - low > 1e-14 * (to - from) + 1e-16) {
      const double middle = 0.5 * (low + high);
      (slides(interpolate(step, middle)) ? high : low) = middle;
    }
  }
  // Loss: work of q less what its spring takes.
  const auto power = [&](double s) {
    const LinkMotion at = interpolate(step, s);
    return friction(state, at) * at.rate;
  };
  const double work = (step.end - step.begin) * laws::gauss_integral(power, high, to);
  const double before = friction(state, interpolate(step, high)), after = friction(state, interpolate(step, to));
  State kept = end;
  kept.lost = state.lost + work - 0.5 * (after - before) * (after + before) / k0;
  return kept;
}

void SlidingSpring::accept(const LinkStep& step) {
  before_ = kept_;
  const double turn = turn_of(step);
  if (turn < 1) kept_ = follow(kept_, step, 0, turn);
  kept_ = follow(kept_, step, turn < 1 ? turn : 0, 1);
}

// Up to some r |v| friction changes with the velocity.
bool SlidingSpring::bends_sharply(const LinkStep& step) const noexcept {
  constexpr double saturated = 10;
  return law_.rate * std::min(std::abs(step.motion_begin.rate), std::abs(step.motion_end.rate)) < saturated;
}

Spring::Instant SlidingSpring::inside(const LinkStep& step, double s, double deformation) const noexcept {
  const double turn = turn_of(step);
  State state = before_;
  if (turn < s) state = follow(state, step, 0, turn);
  const LinkMotion at{deformation, interpolate(step, s).rate};
  return {friction(state, at) - law_.stick() * deformation, follow(state, step, turn < s ? turn : 0, s).lost};
}

double SlidingSpring::stored_correction() const noexcept {
  const double k0 = law_.stick(), elastic = kept_.deformation - kept_.slip;
  return 0.5 * k0 * (elastic * elastic - kept_.deformation * kept_.deformation);
}

}  // namespace pounding
