#include <pounding/model/model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <pounding/input/ground_input.hpp>
#include <pounding/input/link_input.hpp>
#include <pounding/input/structure_input.hpp>
#include <pounding/model/ground_plan.hpp>

namespace pounding {
namespace {

// Histories are kept in memory.
constexpr double max_outputs = 1e7;

AnalysisSettings read_analysis(const Input& input, const Model& model) {
  const GroundPlan ground = ground_plan(model);
  AnalysisSettings settings;
  const std::optional<Input> node = input.find("analysis");
  if (node) {
    node->only_keys({"duration", "tolerance", "output_step", "integrator", "spectral_radius", "max_step"});
    settings.duration = node->quantity_or("duration", dimension::time, 0, bounds::positive);
    settings.tolerance = node->quantity_or("tolerance", dimension::none, settings.tolerance,
                                           Bounds{.low = min_tolerance, .high = max_tolerance});
    if (const auto output_step = node->find("output_step")) {
      const double longest = settings.duration > 0 ? settings.duration : std::numeric_limits<double>::infinity();
      settings.output_step = output_step->as_quantity(dimension::time, Bounds{.low = 0, .high = longest, .without_low = true});
    }
    if (const auto integrator = node->find("integrator"))
      settings.scheme.kind = Scheme::kind_of(integrator->as_choice("integrator", Scheme::names));
    if (const auto radius = node->find("spectral_radius")) {
      if (settings.scheme.kind != Scheme::Kind::generalized_alpha)
        radius->fail(node->find("integrator")
                         ? fmt::format("belongs to generalized_alpha; leave it out with integrator: {}", settings.scheme.name())
                         : "belongs to generalized_alpha; type integrator: generalized_alpha beside it");
      settings.scheme.spectral_radius = radius->as_quantity(dimension::none, bounds::from_0_to_1);
    }
    settings.max_step = node->quantity_or("max_step", dimension::time, 0, bounds::positive);
  }
  if (settings.duration == 0) settings.duration = ground.duration();
  if (settings.duration == 0) input.fail("the duration is missing; type analysis: {duration: 10 s}");
  if (settings.output_step == 0) {
    const double sample = ground.sample_step();
    settings.output_step = sample > 0 ? std::min(sample, settings.duration) : settings.duration / 1000;
  }
  if (settings.duration / settings.output_step > max_outputs)
    input.fail(fmt::format("{:.3g} output times are too many; type analysis: {{output_step: {:.3g}}}",
                           settings.duration / settings.output_step, settings.duration / 1e4));
  return settings;
}

// A wave that arrives everywhere at once, and a delay of what never comes, would say nothing.
void refuse_idle_wave(const Input& wave, const Model& model) {
  constexpr double together = 1e-6;  // [m]
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const Structure& s : model.structures)
    for (const Support& support : s.supports) {
      if (support.motion) continue;
      const double along = support.position.dot(model.ground.wave->direction);
      nearest = std::min(nearest, along);
      farthest = std::max(farthest, along);
    }
  if (farthest - nearest > together) return;
  wave.fail_at_key("reaches all supports at once; give the frames an origin each, or leave it out");
}

void refuse_idle_delay(const Input& place, const Structure& s, const Model& model) {
  const GroundComponents& ground = model.ground.components;
  if (!std::all_of(ground.begin(), ground.end(), [](const GroundMotion& motion) { return motion.is_still(); })) return;
  for (const Support& support : s.supports) {
    if (support.motion || support.delay == 0) continue;
    const std::optional<Input> delay = place.find("delay");
    const std::string what = delay ? "" : fmt::format("support {} has a delay, and ", support.name);
    (delay ? *delay : place).fail_at_key(what + "nothing moves the ground here; give a ground_motion, or leave the delay out");
  }
}

CheckpointSettings read_checkpoints(const Input& node) {
  if (!node.is_map() || node.entries().empty())
    node.fail("takes how often; type checkpoint: {every: 60 s} for run time, {every_simulated: 1 s} for simulated time");
  node.only_keys({"every", "every_simulated"});
  return {node.quantity_or("every", dimension::time, 0, bounds::positive),
          node.quantity_or("every_simulated", dimension::time, 0, bounds::positive)};
}

}  // namespace

Model read_model(const Input& input, const Kinds& kinds, const ModeSolver& modes) {
  input.only_keys({"title", "ground_motion", "structures", "links", "analysis", "checkpoint", "compare"});
  Model model;
  model.source_text = input.text();
  model.source_file = input.file();
  if (const auto title = input.find("title")) model.title = title->as_text();
  if (const auto motion = input.find("ground_motion")) model.ground = read_ground_section(*motion);
  const Input structures = input.at("structures", "{left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}}");
  for (const auto& [name, place] : structures.entries()) {
    model.structures.push_back(read_structure(name, place, kinds, modes, model.ground.wave));
    refuse_idle_delay(place, model.structures.back(), model);
  }
  if (std::all_of(model.structures.begin(), model.structures.end(), [](const Structure& s) { return s.is_rigid(); }))
    structures.fail("no structure that can move; add a body, an oscillator, a shear_building or a frame");
  if (const auto motion = input.find("ground_motion")) {
    int dimension = 1;
    for (const Structure& s : model.structures)
      if (!s.is_rigid()) dimension = std::max(dimension, s.dimension);
    refuse_idle_components(*motion, dimension, false);
    if (const auto wave = motion->find("wave")) refuse_idle_wave(*wave, model);
  }
  if (const auto links = input.find("links")) {
    if (!links->is_list())
      links->fail("takes a list, one link a line; type - {between: [left, right], gap: 20 mm, law: hertz_damped, ...}");
    for (const Input& link : links->items()) read_link(link, model, kinds);
  }
  model.analysis = read_analysis(input, model);
  if (const auto checkpoint = input.find("checkpoint")) model.checkpoint = read_checkpoints(*checkpoint);
  if (const auto compare = input.find("compare")) {
    compare->as_choice("comparison", {"no_pounding"});
    model.compare_no_pounding = true;
  }
  return model;
}

}  // namespace pounding
