// A user-defined law: first in a link that a program steps, then in a whole model.

#include <cstdio>

#include <pounding/elements.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/run/run.hpp>

#include "bumper.hpp"

using namespace pounding;

constexpr Bumper bumper{.stiffness = 50e6, .hardening = 200e9, .loss = 0.5};
constexpr double mass = 60e3, speed = 0.5;  // [kg], [m/s]

// A ball on a wall, by symplectic Euler steps; returns its restitution.
double step_by_hand() {
  GapLink<Bumper> link(bumper, 0.0);
  LinkMotion motion{.penetration = 0, .rate = speed};
  link.on_event(0, 0, motion);  // it touches
  const double h = 1e-7;
  while (motion.penetration >= 0) {
    const double force = link.evaluate(motion).force;
    motion.rate -= h * force / mass;
    motion.penetration += h * motion.rate;
  }
  return -motion.rate / speed;
}

Outcome two_oscillators() {
  Model model;
  const auto left = model.add("left", make_oscillator({.mass = 100e3, .period = 0.8, .damping_ratio = 0.05}));
  const auto right = model.add("right", make_oscillator({.mass = 150e3, .period = 0.4, .damping_ratio = 0.05}));
  model.link(left, right, {.gap = 0.02}, bumper);
  model.ground = Harmonic{.amplitude = 3.0, .period = 0.6, .duration = 3.0};
  model.analysis = {.duration = 3.0, .tolerance = 1e-6};
  return run(model);
}

int main() {
  const petsc::Environment environment;
  const Outcome outcome = two_oscillators();
  const LinkSummary& link = outcome.summary.links[0];
  std::printf("%.6f %.0f %d\n", step_by_hand(), link.peak_force, link.impacts);
}
