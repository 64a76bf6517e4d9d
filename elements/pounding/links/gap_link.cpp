#include <pounding/links/gap_link.hpp>

#include <algorithm>
#include <type_traits>
#include <variant>

namespace pounding {

RigidGapLink::RigidGapLink(double restitution, double gap, int link) : restitution_(restitution), gap_(gap), log_(link) {
  if (!(gap >= 0) || std::isinf(gap)) throw std::invalid_argument("gap must be finite and not negative");
  if (!(restitution > 0 && restitution <= 1)) throw std::invalid_argument("restitution must lie in (0, 1]");
}

Contact::EventFunctions RigidGapLink::event_functions(const LinkMotion& motion, double force) const noexcept {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (phase_ == ContactPhase::resting) return {force, never, never};
  return {drift_ - motion.penetration, never, never};
}

void RigidGapLink::accept(const LinkStep& step) {
  if (phase_ == ContactPhase::resting) log_.add(step);
}

void RigidGapLink::archive(Archive& archive) {
  archive(drift_);
  archive(phase_);
  log_.archive(archive);
}

// A touch is answered by a jump, not here: what ends here is a rest whose force has come to pull.
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

std::unique_ptr<Contact> make_gap_link(const laws::AnyLaw& law, double gap, int link) {
  return std::visit(
      [&](const auto& chosen) -> std::unique_ptr<Contact> {
        using Law = std::decay_t<decltype(chosen)>;
        if constexpr (laws::instantaneous<Law>)
          return std::make_unique<RigidGapLink>(chosen.restitution, gap, link);
        else
          return std::make_unique<GapLink<Law>>(chosen, gap, link);
      },
      law);
}

}  // namespace pounding
