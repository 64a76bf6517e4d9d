#include <pounding/stepping/event_functions.hpp>

#include <cmath>

namespace pounding {
namespace {

// Round-off of the force of a law, relative to its terms.
constexpr double force_noise = 1e-10;

}  // namespace

double EventFunctions::noise(const EventId& id, const LinkMotion& motion, const Instant& now) const {
  double size_u = scales_.max_displacement(), size_v = scales_.max_velocity();
  if (links_.moved()) {
    size_u = std::max(size_u, std::abs(now.by_ground(id.link, Instant::u)));
    size_v = std::max(size_v, std::abs(now.by_ground(id.link, Instant::v)));
  }
  const auto of_force = [&] {
    return force_noise + links_.contact(id.link).force_event_noise(links_.of_contact(id.link), motion,
                                                                   {motion_noise * size_u, motion_noise * size_v});
  };
  switch (links_.phase(id.link)) {
    case ContactPhase::open: return motion_noise * size_u;
    case ContactPhase::approach: return id.event == 0 ? motion_noise * size_v : motion_noise * size_u;
    case ContactPhase::restitution:
      return id.event == 0 ? motion_noise * size_u : id.event == 2 ? motion_noise * size_v : of_force();
    case ContactPhase::slack: return id.event == 0 ? motion_noise * size_u : of_force();
    // The force that would stop a round-off rate within the longest step.
    case ContactPhase::resting: return motion_noise * size_v / (rigid_.flexibility(id.link, id.link) * longest_step_);
  }
  return 0;
}

}  // namespace pounding
