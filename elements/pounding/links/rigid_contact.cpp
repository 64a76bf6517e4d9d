#include <pounding/links/rigid_contact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pounding {

RigidContact::RigidContact(double restitution, double gap, int link)
    : restitution_(restitution), gap_(gap), link_(link) {
  if (gap < 0)
    throw std::invalid_argument(
        "a rigid contact cannot start closed, having no force: gap must be finite and not negative");
  if (!(gap >= 0) || std::isinf(gap)) throw std::invalid_argument("gap must be finite and not negative");
  if (!(restitution >= 0 && restitution <= 1)) throw std::invalid_argument("restitution must lie in [0, 1]");
}

Contact::EventFunctions RigidContact::event_functions(const ContactMemory& memory, const LinkMotion& motion,
                                                      double force) const noexcept {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (memory.state.phase == ContactPhase::resting) return {force, never, never};
  return {memory.drift - motion.penetration, never, never};
}

// A touch is handled in jumped(). The only event here is the end of rest: the force has become tensile.
void RigidContact::on_event(ContactMemory& memory, int, double time, const LinkMotion& motion) const {
  if (memory.state.phase != ContactPhase::resting) return;
  memory.state.phase = ContactPhase::open;
  memory.drift = std::max(0.0, motion.penetration);
  memory.log.end(time, motion.rate);
}

void RigidContact::jumped(ContactMemory& memory, double time, const Jump& jump, bool held) const {
  if (memory.state.phase == ContactPhase::open) memory.log.begin(time, std::max(0.0, jump.rate_before));
  memory.log.push(jump.impulse, jump.work);
  if (!held) {
    if (memory.state.phase == ContactPhase::resting) memory.drift = std::max(0.0, jump.penetration);
    memory.log.end(time, jump.rate_after);
  }
  memory.state.phase = held ? ContactPhase::resting : ContactPhase::open;
}

}  // namespace pounding
