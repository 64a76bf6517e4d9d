#include "ball_on_wall.h"

double speed_after(const pnd_law* law, double mass, double closing_speed, double step, pnd_contact* contact) {
  double penetration = contact->indentation, rate = closing_speed;
  pnd_response r;
  if (pnd_touch(law, closing_speed, contact) != PND_OK) return -1;
  while (contact->touching != 0) {
    if (pnd_respond(law, contact, penetration, rate, &r) != PND_OK) return -1;
    rate -= step * r.force / mass;
    penetration += step * rate;
    if (pnd_accept(law, penetration, rate, contact) != PND_OK) return -1;
  }
  return -rate;
}
