#include <pounding/input/read_model.hpp>

#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <pounding/input/bare_numbers.hpp>
#include <pounding/input/changed_keys.hpp>
#include <pounding/input/device_input.hpp>
#include <pounding/input/fail_at.hpp>
#include <pounding/input/ground_input.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/link_input.hpp>
#include <pounding/input/reduction_input.hpp>
#include <pounding/input/structure_input.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/reports/plausible.hpp>

namespace pounding {
namespace {

AnalysisSettings read_analysis(const Input& node) {
  AnalysisSettings settings;
  node.only_keys();
  settings.duration = node.find_quantity("duration").value_or(0);
  settings.tolerance = node.quantity("tolerance");
  if (const auto output_step = node.find("output_step")) {
    const double longest = settings.duration > 0 ? settings.duration : std::numeric_limits<double>::infinity();
    settings.output_step =
        output_step->as_quantity(dimension::time, Bounds{.low = 0, .high = longest, .without_low = true});
  }
  if (const auto integrator = node.find("integrator")) settings.scheme.kind = Scheme::kind_of(integrator->as_choice());
  if (const auto radius = node.find("spectral_radius")) {
    if (settings.scheme.kind != Scheme::Kind::generalized_alpha)
      radius->fail(
          node.find("integrator")
              ? fmt::format("belongs to generalized_alpha; leave it out with integrator: {}", settings.scheme.name())
              : "belongs to generalized_alpha; add integrator: generalized_alpha");
    settings.scheme.spectral_radius = radius->as_quantity();
  }
  settings.max_step = node.find_quantity("max_step").value_or(0);
  if (const auto maximum = node.find("most_steps")) settings.max_steps = static_cast<long>(maximum->as_integer());
  if (const auto reduction = node.find("reduction")) settings.reduction = read_reduction(*reduction);
  settings.collapse_drift = node.find_quantity("collapse_drift").value_or(0);
  return settings;
}

CheckpointSettings read_checkpoints(const Input& node) {
  if (!node.is_map() || node.entries().empty())
    node.fail(
        "takes an interval; type checkpoint: {every: 60 s} for wall-clock time, {every_simulated: 1 s} for simulated "
        "time");
  node.only_keys();
  return {node.find_quantity("every").value_or(0), node.find_quantity("every_simulated").value_or(0)};
}

Input component(const Input& motion, int axis) {
  constexpr const char* names[] = {"x", "y", "z"};
  return motion.at("components").at(names[axis]);
}

// Modal damping of a structure, at its level or inside its kind.
Input modal_damping_in(const Input& location) {
  std::optional<Input> damping = location.find("damping");
  for (const auto& [spec, inside] : location.entries())
    if (!damping && inside.is_map()) damping = inside.find("damping");
  return damping && damping->is_map() ? damping->find("modal").value_or(location) : location;
}

// Location in the input of an error of the complete model.
Input location_of(const ModelError& error, const Input& input) {
  const Input structures = input.at("structures");
  const auto motion = input.find("ground_motion");
  if (error.option() == ModelOption::structures) return structures;
  if (error.structure() >= 0) {
    const Input location = structures.entries()[error.structure()].second;
    if (error.option() == ModelOption::damping) return modal_damping_in(location);
    if (error.option() == ModelOption::delay) return location.find("delay").value_or(location);
    if (error.option() == ModelOption::ground_component) return component(location.at("ground_motion"), error.axis());
    return location;
  }
  if (error.option() == ModelOption::ground_component) return component(*motion, error.axis());
  if (error.option() == ModelOption::wave) return motion->at("wave");
  if (error.option() == ModelOption::analysis) return input.find("analysis").value_or(input);
  if (error.option() == ModelOption::preload)
    for (const Input& link : input.at("links").items())
      if (link.has("preload")) return link.at("preload");
  return input;
}

// A file of many runs is not a single model.
void refuse_many_runs(const Input& input) {
  if (!input.is_map()) return;
  for (const auto& [name, value] : input.entries()) {
    if (name == "records")
      value.fail(
          "these records are those of a suite, and this command reads a model with one ground motion; type pounding "
          "suite FILE, or ground_motion: {record: FILE.AT2} instead of records");
    if (name == "study")
      value.fail(
          "this is the file of a study, and this command reads a single model; type pounding study FILE, or name the "
          "file of the model");
  }
}

}  // namespace

Model read_model(const Input& input, const ModeSolver& modes, double stiffness_factor, const GroundSection* ground) {
  refuse_many_runs(input);
  const Input root = input.in(keys::model);
  root.only_keys();
  Model model;
  model.mode_solver = modes;
  model.stiffness_factor = stiffness_factor;
  model.source_text = input.text();
  model.source_file = input.file();
  if (const auto title = root.find("title")) model.title = title->as_text();
  if (const auto project = root.find("project")) model.project = project->as_text();
  if (ground)
    model.ground = *ground;
  else if (const auto motion = root.find("ground_motion"))
    model.ground = read_ground_section(*motion);
  const Input structures = root.at("structures");
  for (const auto& [name, location] : structures.entries()) read_structure(name, location, model);
  if (const auto links = root.find("links")) {
    if (!links->is_list())
      links->fail(
          "takes a list with one link per line; type - {between: [left, right], gap: 20 mm, law: hertz_damped, ...}");
    for (const Input& link : links->items()) read_link(link, model);
  }
  if (const auto devices = root.find("devices"))
    for (const auto& [name, device] : devices->entries()) read_device(name, device, model);
  if (const auto analysis = root.find("analysis")) model.analysis = read_analysis(*analysis);
  for (const auto& [name, location] : structures.entries())
    if (const auto reduction = location.find("reduction")) model.analysis.reductions[name] = read_reduction(*reduction);
  if (const auto checkpoint = root.find("checkpoint")) model.checkpoint = read_checkpoints(*checkpoint);
  if (const auto compare = root.find("compare")) {
    compare->as_choice();
    model.compare_no_pounding = true;
  }
  if (const auto accept = root.find("accept"))
    for (const Input& name : accept->items()) model.accept.push_back(name.as_choice());
  model.read_warnings = doubtful_numbers(input);
  for (Warning& warning : changed_keys(input)) model.read_warnings.push_back(std::move(warning));
  try {
    model.complete();
  } catch (const ModelError& error) {
    fail_at(location_of(error, root), error);
  }
  check_reductions(model, root);
  return model;
}

}  // namespace pounding
