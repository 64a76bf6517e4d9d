#pragma once
/// Unilateral link, as used by the integrator: pure forces, event functions whose zeros end the current phase, and a
/// memory that changes only at accepted states.

#include <array>

#include <pounding/laws/law.hpp>
#include <pounding/links/contact_memory.hpp>
#include <pounding/links/link_step.hpp>

namespace pounding {

/// Velocity jump of a rigid contact. Several impulses at one instant, as in a row of bodies that transmit them back and
/// forth, are combined.
struct Jump {
  double impulse = 0;                      ///< [N s]
  double work = 0;                         ///< kinetic energy taken from the bodies [J]
  double rate_before = 0, rate_after = 0;  ///< > 0 closes [m/s]
  double penetration = 0;                  ///< zero up to round-off [m]
};

/// A contact between two ends that approach each other: constant during a run. What changes is its ContactMemory, which
/// the caller owns; many runs may use one contact at the same time. The integrator evaluates forces and event functions
/// any number of times, and passes accepted steps and located events.
class Contact {
 public:
  static constexpr int max_event_functions = 3;
  /// Values that are positive during the current phase and zero at its end; unused ones are infinite.
  using EventFunctions = std::array<double, max_event_functions>;

  virtual ~Contact() = default;

  /// Memory before the first step: open, with the initial gap.
  virtual ContactMemory initial() const = 0;
  /// Force on the bodies, and its slope by the penetration, for a first slow loading to this penetration [m]. Pure.
  virtual laws::Response first_loading(double /*penetration*/) const noexcept { return {}; }
  /// Starts the run with the bodies at rest and pressed together by this penetration > 0 [m]; the stored energy is
  /// included in the work. Throws std::invalid_argument for a contact that cannot start closed.
  virtual void press(ContactMemory& memory, double penetration) const;

  /// Force [N] and its slopes in the current phase. Pure. The formula of the law is continued smoothly beyond the end
  /// of the phase, including negative forces, so that a trial step may overshoot; see acting_force.
  virtual laws::Response evaluate(const ContactMemory& memory, const LinkMotion& motion) const noexcept = 0;
  /// True if the published law may yield tension near separation.
  virtual bool may_pull() const noexcept { return false; }
  /// Force on the bodies [N] for the force `law_force` of `evaluate` within a step [N]: without tension unless the law
  /// may pull.
  double acting_force(double law_force) const noexcept { return may_pull() ? law_force : laws::no_tension(law_force); }
  /// Event functions of the current phase. Pure. `force` is the link force of the state [N]; only a resting contact
  /// uses it.
  virtual EventFunctions event_functions(const ContactMemory& memory, const LinkMotion& motion,
                                         double force) const noexcept = 0;
  /// Round-off of an event function that has the sign of a force, for this round-off of penetration [m] and rate [m/s].
  /// Pure; in the scale of the event function, without unit.
  virtual double force_event_noise(const ContactMemory& /*memory*/, const LinkMotion& /*motion*/,
                                   const LinkMotion& /*rounding*/) const noexcept {
    return 0;
  }
  /// True for a law whose stiffness follows from the closing speed of each impact; a contact that is closed at rest has
  /// no closing speed.
  virtual bool needs_closing_speed() const noexcept { return false; }
  /// Accepts a step: updates the current impact and its peaks. Throws laws::BeyondDesign if the penetration exceeds
  /// the range of the law.
  virtual void accept(ContactMemory& memory, const LinkStep& step) const = 0;
  /// Enters the next phase: the event function with this index is zero at an accepted state, at this time [s].
  virtual void on_event(ContactMemory& memory, int event, double time, const LinkMotion& motion) const = 0;

  /// True for a contact with a velocity jump at touch: rate after = -restitution * rate before.
  virtual bool is_rigid() const noexcept { return false; }
  /// Coefficient of restitution of that jump, in [0, 1].
  virtual double restitution() const noexcept { return 1; }
  /// Records a jump at an accepted state, at this time [s]. `held`: the bodies rest on each other afterwards.
  virtual void jumped(ContactMemory& /*memory*/, double /*time*/, const Jump& /*jump*/, bool /*held*/) const {}
};

}  // namespace pounding
