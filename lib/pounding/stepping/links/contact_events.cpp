#include <pounding/stepping/links/contact_events.hpp>

#include <algorithm>

namespace pounding {

void ContactEvents::apply(const std::vector<EventId>& events, bool in_place, Instant& now) {
  std::vector<int> rigid;
  for (const EventId& event : events) {
    const Contact& contact = links_.contact(event.link);
    const LinkMotion here = links_.motion(event.link, now);
    const bool touches = links_.phase(event.link) == ContactPhase::open;
    ++count_;
    if (touches && contact.is_rigid()) {
      rigid.push_back(event.link);
      continue;
    }
    if (touches) norm_.begin_impact(event.link, here.rate);
    contact.on_event(links_.of_contact(event.link), event.event, now.time, here);
  }
  if (!rigid.empty()) {
    strike(rigid, in_place, now);
    equations_.gather(now);
  }
  settle(now);
}

// A velocity jump may end the phase of any active compliant contact on the same bodies.
void ContactEvents::settle(const Instant& now) {
  for (int i = 0; i < links_.contacts(); ++i) {
    const LinkMotion here = links_.motion(i, now);
    // At most two changes: from a reversal to a release or to the separation.
    for (int change = 0; change < 2; ++change) {
      if (links_.phase(i) == ContactPhase::open || links_.is_held(i)) break;
      const Contact::EventFunctions values = functions_.values(i, here, now.force[i]);
      for (int k = 0; k < Contact::max_event_functions; ++k) {
        if (!functions_.has_ended({i, k}, values[k], here, now)) continue;
        links_.contact(i).on_event(links_.of_contact(i), k, now.time, here);
        break;
      }
    }
  }
}

// All closed rigid contacts take part in the bounce; those that touch come first.
void ContactEvents::strike(const std::vector<int>& touching, bool in_place, Instant& now) {
  const MotionScales& scales = norm_.scales();
  std::vector<int> closed = touching;
  for (int i = 0; i < links_.contacts(); ++i) {
    const LinkMotion here = links_.motion(i, now);
    if (!links_.contact(i).is_rigid() || std::find(touching.begin(), touching.end(), i) != touching.end()) continue;
    const EventId touch{i, EventFunctions::touch};
    if (links_.is_held(i) || functions_.values(i, here, 0)[touch.event] <= functions_.noise(touch, here, now))
      closed.push_back(i);
  }
  const int count = static_cast<int>(closed.size());
  Strikes strikes;
  strikes.flexibility = equations_.rigid.flexibility(closed, closed);
  strikes.rate = now.relative.col(Instant::v)(closed);
  strikes.restitution.resize(count);
  strikes.slowest.resize(count);
  strikes.still = motion_noise * scales.max_velocity();
  strikes.parting = in_place ? static_cast<int>(touching.size()) : 0;
  for (int k = 0; k < count; ++k) {
    const int i = closed[k];
    strikes.rate[k] += links_.ground_part(now.by_ground, i, Instant::v);
    strikes.restitution[k] = links_.contact(i).restitution();
    const double press = links_.acceleration(i, now);
    strikes.slowest[k] = std::max(tolerance_ * scales.max_velocity(),
                                  slowest_bounce(press, strikes.restitution[k], scales.max_displacement(), now.time));
  }
  const RigidBounce result = bounce(strikes);
  for (int k = 0; k < count; ++k) {
    const int i = closed[k];
    const double impulse = result.impulse[k], rate = result.rate[k];
    const bool stays = rate >= -strikes.still, touches = k < static_cast<int>(touching.size());
    // Without an impulse, a touch at rest becomes held and a rest may end; all other contacts are unchanged.
    if (impulse == 0 && !(touches && stays) && !(links_.is_held(i) && !stays)) continue;
    now.motion.col(Instant::v) -= impulse * equations_.rigid.response.col(i);
    ledger_.add_impulse(impulse, links_.ground_part(now.by_ground, i, Instant::v));
    links_.contact(i).jumped(
        links_.of_contact(i), now.time,
        {std::max(0.0, impulse), result.work[k], strikes.rate[k], rate, links_.motion(i, now).penetration}, stays);
  }
}

}  // namespace pounding
