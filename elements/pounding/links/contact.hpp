#pragma once
/// A unilateral link as the integrator sees it: pure forces, event functions whose zeros end the present phase, and a
/// history that moves at kept states only.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <pounding/base/quintic.hpp>
#include <pounding/core/archive.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/links/contact_state.hpp>
#include <pounding/links/impact_row.hpp>

namespace pounding {

/// Relative motion of a link. penetration > 0 is overlap, rate > 0 closes.
struct LinkMotion {
  double penetration = 0;  ///< [m]
  double rate = 0;         ///< [m/s]
  // Of a spring with a dashpot inside alone (Spring::slips), else zero:
  double slip = 0;  ///< length that the dashpot has got, but for what follows [m]
  double lag = 0;   ///< to which this time at its present rate is added [s]; infinite for what is at rest
};

/// One kept step of a link: motion and force at its beginning, its middle and its end.
struct LinkStep {
  double begin = 0, end = 0;  ///< [s]
  LinkMotion motion_begin, motion_middle, motion_end;
  double force_begin = 0, force_middle = 0, force_end = 0;  ///< [N]
  double acceleration_begin = 0, acceleration_end = 0;      ///< time derivative of the rate [m/s^2]
};

/// Penetration inside a kept step, with its rate: the polynomial of degree five through motions and accelerations at
/// its ends.
constexpr Quintic path(const LinkStep& step) noexcept {
  return {{step.motion_begin.penetration, step.motion_begin.rate, step.acceleration_begin},
          {step.motion_end.penetration, step.motion_end.rate, step.acceleration_end},
          step.end - step.begin};
}

/// Motion inside a kept step on that path, s from 0 to 1.
constexpr LinkMotion interpolate(const LinkStep& step, double s) noexcept {
  const Jet at = path(step).at(s);
  return {at.x, at.v};
}

/// Penetration inside a trial step, s from 0 to 1: the cubic polynomial through the motions at its ends.
class CubicPenetration {
 public:
  CubicPenetration(const LinkMotion& begin, const LinkMotion& end, double h) noexcept : begin_(begin), h_(h) {
    const double mean = (end.penetration - begin.penetration) / h;
    a_ = 3 * (begin.rate + end.rate - 2 * mean);
    b_ = 2 * (3 * mean - 2 * begin.rate - end.rate);
  }

  /// Penetration at s [m].
  double at(double s) const noexcept { return begin_.penetration + h_ * s * (begin_.rate + s * (b_ / 2 + s * a_ / 3)); }
  /// The s at which the rate is zero, for rates of opposite sign at the two ends.
  double turn() const noexcept {
    const double root = std::sqrt(std::max(0.0, b_ * b_ - 4 * a_ * begin_.rate));
    return 2 * begin_.rate / (-b_ + std::copysign(root, begin_.rate));
  }

 private:
  LinkMotion begin_;
  double h_, a_, b_;  // the rate is begin.rate + b s + a s^2
};

/// Velocity jump of a rigid contact. Several impulses at one instant, as in a row of bodies that pass them back and
/// forth, count as one.
struct Jump {
  double impulse = 0;                      ///< [N s]
  double work = 0;                         ///< kinetic energy taken from the bodies [J]
  double rate_before = 0, rate_after = 0;  ///< > 0 closes [m/s]
  double penetration = 0;                  ///< zero but for rounding [m]
};

/// One contact between two ends that approach each other. The integrator asks for forces and event functions as often
/// as it likes, and tells which steps it keeps and where it has located an event.
class Contact {
 public:
  static constexpr int max_event_functions = 3;
  /// Values that are positive while the present phase lasts and zero where it ends; unused ones are infinite.
  using EventFunctions = std::array<double, max_event_functions>;

  virtual ~Contact() = default;

  /// Force on the bodies, and slopes, when they have come slowly to this penetration [m], the first time. Pure.
  virtual laws::Response first_loading(double /*penetration*/) const noexcept { return {}; }
  /// The run begins with the bodies at rest and pressed together by this penetration > 0 [m]; the energy stored in it
  /// is part of work(). Throws std::invalid_argument for a contact that cannot begin so.
  virtual void press(double penetration);

  /// Present phase, as the last kept state left it.
  virtual ContactPhase phase() const noexcept = 0;
  /// Penetration [m] when the two ends have approached each other by `relative_displacement` [m] since the undeformed
  /// state.
  virtual double penetration(double relative_displacement) const noexcept = 0;
  /// Force [N] and its slopes in the present phase. Pure. The law's formula is continued smoothly past the end of the
  /// phase, also to negative forces, so that a trial step may overshoot; see acting_force.
  virtual laws::Response evaluate(const LinkMotion& motion) const noexcept = 0;
  /// True if the published law may give tension near the separation.
  virtual bool may_pull() const noexcept { return false; }
  /// Force on the bodies [N] where `evaluate` gives `law_force` [N] inside a step: without tension unless the law may
  /// pull.
  double acting_force(double law_force) const noexcept { return may_pull() ? law_force : laws::no_tension(law_force); }
  /// Event functions of the present phase. Pure. `force` is the link force of the state [N]; only a resting contact
  /// uses it.
  virtual EventFunctions event_functions(const LinkMotion& motion, double force) const noexcept = 0;
  /// Round-off of an event function that follows the sign of a force, for this round-off of penetration [m] and rate
  /// [m/s]. Pure; has the scale of the event function, no unit.
  virtual double force_event_noise(const LinkMotion& /*motion*/, const LinkMotion& /*rounding*/) const noexcept {
    return 0;
  }
  /// True for a law whose stiffness follows from the closing speed of each impact; a contact that is closed at rest has
  /// none.
  virtual bool needs_closing_speed() const noexcept { return false; }
  /// A step was kept: moves histories and peaks. Throws laws::BeyondDesign for a contact that is pressed further than
  /// its law allows.
  virtual void accept(const LinkStep& step) = 0;
  /// The event function with this index is zero at a kept state, at this time [s]: enters the next phase.
  virtual void on_event(int event, double time, const LinkMotion& motion) = 0;

  /// True for a contact that answers a touch with a velocity jump: rate after = -restitution * rate before.
  virtual bool is_rigid() const noexcept { return false; }
  /// Coefficient of restitution of that jump, in [0, 1].
  virtual double restitution() const noexcept { return 1; }
  /// A jump was applied at a kept state, at this time [s]. `held`: the bodies rest on each other after it.
  virtual void jumped(double /*time*/, const Jump& /*jump*/, bool /*held*/) {}
  /// A rigid contact that rests has this force [N] at a time [s] inside the step that is accepted next.
  virtual void record_force(double /*time*/, double /*force*/) {}

  /// Work done on the link since the beginning, stored and lost [J]; with what it stored at the beginning.
  virtual double work() const noexcept = 0;
  /// One row per impact, in the order of the touches; the last one is unfinished (t_end NaN) while the impact lasts,
  /// and splits its work so far into what is lost and what is stored.
  virtual std::span<const ImpactRow> impacts() const noexcept = 0;
  /// Reads or writes all that moves in accept(), on_event() and jumped().
  virtual void archive(Archive& archive) = 0;
};

}  // namespace pounding
