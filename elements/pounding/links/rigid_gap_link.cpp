#include <pounding/links/rigid_gap_link.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pounding {

RigidGapLink::RigidGapLink(double restitution, double gap, int link)
    : restitution_(restitution), gap_(gap), log_(link) {
  if (gap < 0)
    throw std::invalid_argument(
        "a rigid contact cannot start closed, having no force: gap must be finite and not negative");
  if (!(gap >= 0) || std::isinf(gap)) throw std::invalid_argument("gap must be finite and not negative");
  if (!(restitution >= 0 && restitution <= 1)) throw std::invalid_argument("restitution must lie in [0, 1]");
}

Contact::EventFunctions RigidGapLink::event_functions(const LinkMotion& motion, double force) const noexcept {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (phase_ == ContactPhase::resting) return {force, never, never};
  return {drift_ - motion.penetration, never, never};
}

void RigidGapLink::archive(Archive& archive) {
  archive(drift_, phase_);
  log_.archive(archive);
}

// A touch is handled in jumped(). The only event here is the end of rest: the force has become tensile.
void RigidGapLink::on_event(int, double time, const LinkMotion& motion) {
  if (phase_ != ContactPhase::resting) return;
  phase_ = ContactPhase::open;
  drift_ = std::max(0.0, motion.penetration);
  log_.end(time, motion.rate);
}

void RigidGapLink::jumped(double time, const Jump& jump, bool held) {
  if (phase_ == ContactPhase::open) log_.begin(time, std::max(0.0, jump.rate_before));
  log_.push(jump.impulse, jump.work);
  if (!held) {
    if (phase_ == ContactPhase::resting) drift_ = std::max(0.0, jump.penetration);
    log_.end(time, jump.rate_after);
  }
  phase_ = held ? ContactPhase::resting : ContactPhase::open;
}

}  // namespace pounding
