// The installed library runs a model.
#include <cstdio>

#include <pounding/analysis.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/structures.hpp>

int main() {
  const pounding::petsc::Environment environment;
  const pounding::Model model = pounding::read_model(
      pounding::Input::read_text("structures:\n  ball: {body: {mass: 60 t}, initial_velocity: 1 m/s}\n  wall: {wall: {}}\n"
                                 "links: [{between: [ball, wall], gap: 10 mm, law: jankowski, stiffness: 2.75e9, "
                                 "restitution: 0.65}]\nanalysis: {duration: 0.2}\n",
                                 "inline.yaml"),
      pounding::kinds());
  const pounding::Outcome outcome = pounding::run(model);
  const double restitution = outcome.results.impacts.at(0).restitution;
  std::printf("restitution %.5f\n", restitution);
  return restitution > 0.6499 && restitution < 0.6501 ? 0 : 1;
}
