// A separate code with our gap link, without PETSc: Newmark's average acceleration, a ball on a wall.
#include <pounding/links.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#ifdef EIGEN_WORLD_VERSION
#error "a header of the links includes Eigen"
#endif

int main() {
  const double mass = 6e4, h = 1e-6;
  pounding::GapLink link(pounding::laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.65}, 0.01);
  double t = 0, u = 0, v = 1, a = 0;
  while (link.impacts().empty() || link.phase() != pounding::ContactPhase::open) {
    const double u0 = u, v0 = v, a0 = a;
    pounding::LinkMotion motion;
    pounding::laws::Response f;
    for (double change = 1; std::abs(change) > 1e-16; u += change) {
      a = 4 * (u - u0 - h * v0) / (h * h) - a0;
      v = v0 + h / 2 * (a0 + a);
      motion = {link.penetration(u), v};
      f = link.evaluate(motion);
      change = -(mass * a + f.force) / (4 / (h * h) * mass + f.by_penetration + 2 / h * f.by_rate);
    }
    pounding::LinkStep step;
    step.begin = t, step.end = t += h;
    step.motion_begin = {link.penetration(u0), v0}, step.motion_end = motion;
    step.acceleration_begin = a0, step.acceleration_end = a;
    step.motion_middle = interpolate(step, 0.5);
    step.force_begin = link.evaluate(step.motion_begin).force;
    step.force_middle = link.evaluate(step.motion_middle).force;
    step.force_end = f.force;
    link.accept(step);
    const auto values = link.event_functions(motion, f.force);
    const auto ended = std::find_if(values.begin(), values.end(), [](double value) { return value < 0; });
    if (ended != values.end()) link.on_event(static_cast<int>(ended - values.begin()), t, motion);
  }
  const pounding::ImpactRow& row = link.impacts().front();
  std::printf("restitution %.6f, peak force %.0f N\n", row.restitution, row.peak_force);
  return std::abs(row.restitution - 0.65) < 1e-4 ? 0 : 1;
}
