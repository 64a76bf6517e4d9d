#pragma once
/// A unilateral link as the integrator sees it: pure forces, event_functions that tell when the present phase ends, and history
/// that moves at kept states only.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include <pounding/core/archive.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/links/impact_row.hpp>

namespace pounding {

/// Relative motion of a link. penetration > 0 is overlap, rate > 0 closes.
struct LinkMotion {
  double penetration = 0;  ///< [m]
  double rate = 0;         ///< [m/s]
};

/// One kept step of a link, its ends and its middle.
struct LinkStep {
  double begin = 0, end = 0;  ///< [s]
  LinkMotion motion_begin, motion_middle, motion_end;
  double force_begin = 0, force_middle = 0, force_end = 0;  ///< [N]
  double acceleration_begin = 0, acceleration_end = 0;      ///< slopes of the rate [m/s^2]
};

/// Motion inside a kept step, s from 0 to 1: the polynomial of degree five through motions and accelerations at its ends.
constexpr LinkMotion interpolate(const LinkStep& step, double s) noexcept {
  const double h = step.end - step.begin;
  const double d0 = step.motion_begin.penetration, d1 = step.motion_end.penetration;
  const double v0 = h * step.motion_begin.rate, v1 = h * step.motion_end.rate;
  const double a0 = h * h * step.acceleration_begin, a1 = h * h * step.acceleration_end;
  // In powers of s from the beginning.
  const double rise = d1 - d0 - v0 - a0 / 2, slope = v1 - v0 - a0, bend = a1 - a0;
  const double c3 = 10 * rise - 4 * slope + bend / 2, c4 = -15 * rise + 7 * slope - bend, c5 = 6 * rise - 3 * slope + bend / 2;
  return {d0 + s * (v0 + s * (a0 / 2 + s * (c3 + s * (c4 + s * c5)))),
          (v0 + s * (a0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / h};
}

/// Penetration inside a step, s from 0 to 1: the cubic through the motions at its ends, for steps that are not kept yet.
class CubicPenetration {
 public:
  CubicPenetration(const LinkMotion& begin, const LinkMotion& end, double h) noexcept : begin_(begin), h_(h) {
    const double mean = (end.penetration - begin.penetration) / h;
    a_ = 3 * (begin.rate + end.rate - 2 * mean);
    b_ = 2 * (3 * mean - 2 * begin.rate - end.rate);
  }

  /// Penetration at s [m].
  double at(double s) const noexcept { return begin_.penetration + h_ * s * (begin_.rate + s * (b_ / 2 + s * a_ / 3)); }
  /// Where the rate, which has different signs at the ends, passes through zero.
  double turn() const noexcept {
    const double root = std::sqrt(std::max(0.0, b_ * b_ - 4 * a_ * begin_.rate));
    return 2 * begin_.rate / (-b_ + std::copysign(root, begin_.rate));
  }

 private:
  LinkMotion begin_;
  double h_, a_, b_;  // the rate is begin.rate + b s + a s^2
};

/// What happened to a rigid contact when velocities jumped. Several impulses at one instant, handed back and forth in a row
/// of bodies, count as one.
struct Jump {
  double impulse = 0;                      ///< [N s]
  double work = 0;                         ///< taken from the bodies [J]
  double rate_before = 0, rate_after = 0;  ///< > 0 closes [m/s]
  double penetration = 0;                  ///< zero but for rounding [m]
};

/// What a contact is doing.
enum class ContactPhase : std::uint8_t {
  open,         ///< apart
  approach,     ///< pressed, still closing
  restitution,  ///< pressed, opening
  slack,        ///< overlapping, but the law's force is cut at zero
  resting       ///< held at zero rate by whatever force that needs (rigid contact after its last bounce)
};

/// Pressed together, with a force or held.
constexpr bool presses(ContactPhase phase) noexcept {
  return phase == ContactPhase::approach || phase == ContactPhase::restitution || phase == ContactPhase::resting;
}

/// Phases are set from the state at a located instant, never toggled.
class Contact {
 public:
  static constexpr int max_event_functions = 3;
  /// Numbers that are positive while a phase lasts; infinite where one has no meaning.
  using EventFunctions = std::array<double, max_event_functions>;

  virtual ~Contact() = default;

  /// The phase since the last kept state.
  virtual ContactPhase phase() const noexcept = 0;
  /// Penetration when the two ends have closed on each other by `relative_displacement` [m] since the undeformed state.
  virtual double penetration(double relative_displacement) const noexcept = 0;
  /// Pure: force and slopes in the present phase, continued smoothly past its end so that a trial step may overshoot.
  virtual laws::Response evaluate(const LinkMotion& motion) const noexcept = 0;
  /// The law as published pulls near the separation; the force of any other that dips below zero inside a step is zero there.
  virtual bool may_pull() const noexcept { return false; }
  /// Pure: values that are positive while the present phase lasts; unused ones are infinite.
  /// `force` is the link force of the state (only a resting contact needs it).
  virtual EventFunctions event_functions(const LinkMotion& motion, double force) const noexcept = 0;
  /// Pure: what the rounding of the motion makes of a margin that follows the sign of a force.
  virtual double force_event_noise(const LinkMotion& /*motion*/, const LinkMotion& /*rounding*/) const noexcept { return 0; }
  /// A step was kept. Moves histories and peaks.
  virtual void accept(const LinkStep& step) = 0;
  /// The margin with this index reached zero at a kept state: enter the next phase.
  virtual void on_event(int event, double time, const LinkMotion& motion) = 0;

  /// A rigid contact answers a touch with a velocity jump: the rate after is -restitution times the rate before.
  virtual bool is_rigid() const noexcept { return false; }
  virtual double restitution() const noexcept { return 1; }
  /// The jump was applied at a kept state. `held` when the bodies rest on each other after it.
  virtual void jumped(double /*time*/, const Jump& /*jump*/, bool /*held*/) {}

  /// Work done on the link so far, stored and lost [J].
  virtual double work() const noexcept = 0;
  /// One row an impact, in the order of their touches; the last one is unfinished (t_end NaN) while it lasts.
  virtual std::span<const ImpactRow> impacts() const noexcept = 0;
  /// Everything that moves in accept() and on_event().
  virtual void archive(Archive& archive) = 0;
};

}  // namespace pounding
