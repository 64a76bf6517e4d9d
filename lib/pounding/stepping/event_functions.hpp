#pragma once
/// Event functions of the contacts and their round-off: detects which phases have ended at an instant.

#include <algorithm>

#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/links/rigid_impacts.hpp>

namespace pounding {

/// Round-off of displacements and velocities, relative to their scales.
inline constexpr double motion_noise = 1e-12;
/// Steps and hops shorter than this do not advance time [s]; `time`: time at their beginning [s].
inline double no_time(double time) { return 1e-13 * std::max(1.0, time); }

/// An event function is positive during the current phase of its contact (Contact::event_functions). A phase has ended
/// if one of them is negative beyond round-off.
class EventFunctions {
 public:
  /// Event function 0 of an open contact: start of contact.
  static constexpr int touch = 0;

  /// All arguments must outlive this object. `longest_step`: current maximum step, see Stepper::longest_step() [s].
  EventFunctions(const LinkSet& links, const RigidContacts& rigid, const MotionScales& scales,
                 const double& longest_step)
      : links_(links), rigid_(rigid), scales_(scales), longest_step_(longest_step) {}

  /// The links and scales passed to the constructor.
  const LinkSet& links() const { return links_; }
  const MotionScales& scales() const { return scales_; }
  double longest_step() const { return longest_step_; }

  /// All event functions of a contact at a motion and force [N].
  Contact::EventFunctions values(int link, const LinkMotion& motion, double force) const {
    return links_.contact(link).event_functions(links_.of_contact(link), motion, force);
  }
  /// Value of one event function at an instant.
  double value(const EventId& id, const Instant& x) const {
    return values(id.link, links_.motion(id.link, x), x.force[id.link])[id.event];
  }
  /// Round-off of an event function at this motion of the link. The scale is the larger of the structural displacements
  /// and the ground displacements at `now`.
  double noise(const EventId& id, const LinkMotion& motion, const Instant& now) const;
  /// True if `value` is negative beyond round-off.
  bool has_ended(const EventId& id, double value, const LinkMotion& motion, const Instant& now) const {
    return value < 0 && value < -noise(id, motion, now);
  }

 private:
  const LinkSet& links_;
  const RigidContacts& rigid_;
  const MotionScales& scales_;
  const double& longest_step_;
};

}  // namespace pounding
