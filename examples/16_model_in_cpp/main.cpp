// The two oscillators of lesson 2, built by code.

#include <cstdio>

#include <pounding/elements.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/run/run.hpp>

using namespace pounding;

int main() {
  const petsc::Environment environment;
  Model model;
  const auto left = model.add("left", make_oscillator({.mass = 100e3, .period = 0.8, .damping_ratio = 0.05}));
  const auto right = model.add("right", make_oscillator({.mass = 150e3, .period = 0.4, .damping_ratio = 0.05}));
  model.link(left.floor(1), right.floor(1), {.gap = 0.02}, laws::Jankowski{.stiffness = 2.75e9, .restitution = 0.65});
  model.ground = Harmonic{.amplitude = 3.0, .period = 0.6, .duration = 3.0};
  model.analysis = {.duration = 3.0, .tolerance = 1e-6};
  const Outcome outcome = run(model);

  const Summary& summary = outcome.summary;
  std::printf("%.1f %.7f %.7f %d\n", summary.links[0].peak_force, summary.structures[0].peak_displacement[0],
              summary.structures[1].peak_displacement[0], summary.links[0].impacts);
}
