#pragma once
/// Unilateral link, as used by the integrator: pure forces, event functions whose zeros end the current phase, and a
/// history that changes only at accepted states.

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
  // Only for a spring with an internal dashpot (Spring::slips), otherwise zero:
  double slip = 0;  ///< elongation of the dashpot, except the following term [m]
  double lag = 0;   ///< that term is this time multiplied by the current rate [s]; infinite at rest
};

/// An accepted step of a link: motion and force at its beginning, middle and end.
struct LinkStep {
  double begin = 0, end = 0;  ///< [s]
  LinkMotion motion_begin, motion_middle, motion_end;
  double force_begin = 0, force_middle = 0, force_end = 0;  ///< [N]
  double acceleration_begin = 0, acceleration_end = 0;      ///< time derivative of the rate [m/s^2]
};

/// Penetration and rate within an accepted step: polynomial of degree five through motions and accelerations at its
/// ends.
constexpr Quintic path(const LinkStep& step) noexcept {
  return {{step.motion_begin.penetration, step.motion_begin.rate, step.acceleration_begin},
          {step.motion_end.penetration, step.motion_end.rate, step.acceleration_end},
          step.end - step.begin};
}

/// Motion within an accepted step on that path, s from 0 to 1.
constexpr LinkMotion interpolate(const LinkStep& step, double s) noexcept {
  const Jet at = path(step).at(s);
  return {at.x, at.v};
}

/// Penetration within a trial step, s from 0 to 1: cubic polynomial through the motions at its ends.
class CubicPenetration {
 public:
  CubicPenetration(const LinkMotion& begin, const LinkMotion& end, double h) noexcept : begin_(begin), h_(h) {
    const double mean = (end.penetration - begin.penetration) / h;
    a_ = 3 * (begin.rate + end.rate - 2 * mean);
    b_ = 2 * (3 * mean - 2 * begin.rate - end.rate);
  }

  /// Penetration at s [m].
  double at(double s) const noexcept { return begin_.penetration + h_ * s * (begin_.rate + s * (b_ / 2 + s * a_ / 3)); }
  /// The s at which the rate is zero, for rates of opposite sign at the ends.
  double turn() const noexcept {
    const double root = std::sqrt(std::max(0.0, b_ * b_ - 4 * a_ * begin_.rate));
    return 2 * begin_.rate / (-b_ + std::copysign(root, begin_.rate));
  }

 private:
  LinkMotion begin_;
  double h_, a_, b_;  // the rate is begin.rate + b s + a s^2
};

/// Velocity jump of a rigid contact. Several impulses at one instant, as in a row of bodies that transmit them back and
/// forth, are combined.
struct Jump {
  double impulse = 0;                      ///< [N s]
  double work = 0;                         ///< kinetic energy taken from the bodies [J]
  double rate_before = 0, rate_after = 0;  ///< > 0 closes [m/s]
  double penetration = 0;                  ///< zero up to round-off [m]
};

/// A contact between two ends that approach each other. The integrator evaluates forces and event functions any number
/// of times, and passes accepted steps and located events.
class Contact {
 public:
  static constexpr int max_event_functions = 3;
  /// Values that are positive during the current phase and zero at its end; unused ones are infinite.
  using EventFunctions = std::array<double, max_event_functions>;

  virtual ~Contact() = default;

  /// Force on the bodies, and its slope by the penetration, for a first slow loading to this penetration [m]. Pure.
  virtual laws::Response first_loading(double /*penetration*/) const noexcept { return {}; }
  /// Starts the run with the bodies at rest and pressed together by this penetration > 0 [m]; the stored energy is
  /// included in work(). Throws std::invalid_argument for a contact that cannot start closed.
  virtual void press(double penetration);

  /// Current phase, from the last accepted state.
  virtual ContactPhase phase() const noexcept = 0;
  /// Penetration [m] for an approach of the two ends by `relative_displacement` [m] since the undeformed state.
  virtual double penetration(double relative_displacement) const noexcept = 0;
  /// Force [N] and its slopes in the current phase. Pure. The formula of the law is continued smoothly beyond the end
  /// of the phase, including negative forces, so that a trial step may overshoot; see acting_force.
  virtual laws::Response evaluate(const LinkMotion& motion) const noexcept = 0;
  /// True if the published law may yield tension near separation.
  virtual bool may_pull() const noexcept { return false; }
  /// Force on the bodies [N] for the force `law_force` of `evaluate` within a step [N]: without tension unless the law
  /// may pull.
  double acting_force(double law_force) const noexcept { return may_pull() ? law_force : laws::no_tension(law_force); }
  /// Event functions of the current phase. Pure. `force` is the link force of the state [N]; only a resting contact
  /// uses it.
  virtual EventFunctions event_functions(const LinkMotion& motion, double force) const noexcept = 0;
  /// Round-off of an event function that has the sign of a force, for this round-off of penetration [m] and rate [m/s].
  /// Pure; in the scale of the event function, without unit.
  virtual double force_event_noise(const LinkMotion& /*motion*/, const LinkMotion& /*rounding*/) const noexcept {
    return 0;
  }
  /// True for a law whose stiffness follows from the closing speed of each impact; a contact that is closed at rest has
  /// no closing speed.
  virtual bool needs_closing_speed() const noexcept { return false; }
  /// Passes an accepted step: updates histories and peaks. Throws laws::BeyondDesign if the penetration exceeds the
  /// range of the law.
  virtual void accept(const LinkStep& step) = 0;
  /// Enters the next phase: the event function with this index is zero at an accepted state, at this time [s].
  virtual void on_event(int event, double time, const LinkMotion& motion) = 0;

  /// True for a contact with a velocity jump at touch: rate after = -restitution * rate before.
  virtual bool is_rigid() const noexcept { return false; }
  /// Coefficient of restitution of that jump, in [0, 1].
  virtual double restitution() const noexcept { return 1; }
  /// Records a jump at an accepted state, at this time [s]. `held`: the bodies rest on each other afterwards.
  virtual void jumped(double /*time*/, const Jump& /*jump*/, bool /*held*/) {}
  /// Records the force [N] of a resting rigid contact at a time [s] within the step that is accepted next.
  virtual void record_force(double /*time*/, double /*force*/) {}

  /// Work done on the link since the beginning, stored and lost [J], including the energy stored at the beginning.
  virtual double work() const noexcept = 0;
  /// One row per impact, in the order of the touches. During an impact the last row is unfinished (t_end NaN) and
  /// splits its work into lost and stored energy.
  virtual std::span<const ImpactRow> impacts() const noexcept = 0;
  /// Reads or writes the state changed by accept(), on_event() and jumped().
  virtual void archive(Archive& archive) = 0;
};

}  // namespace pounding
