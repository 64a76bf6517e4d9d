#include <pounding/model/cost.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include <pounding/core/limits.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>

namespace pounding {
namespace {

[[noreturn]] void refuse_analysis(const std::string& text) { throw ModelError(ModelOption::analysis, text); }

// Maximum step relative to the shortest of all first periods, and to the duration.
constexpr double max_part_of_period = 0.1;
constexpr double max_part_of_duration = 1.0 / 16;

bool vibrates(const Structure& s) { return !s.is_rigid() && !s.is_free; }

double longest_step(const Model& model, const GroundPlan& plan) {
  double longest = max_part_of_duration * model.analysis.duration;
  if (model.analysis.max_step > 0) longest = std::min(longest, model.analysis.max_step);
  double free = longest;
  for (const Structure& s : model.structures)
    if (vibrates(s)) free = std::min(free, max_part_of_period * 2 * M_PI / s.frequencies[0]);
  // Samples of a record are not subdivided for the periods of the structures alone.
  return std::max(free, std::min(plan.sample_step(), model.analysis.max_step > 0 ? longest : model.analysis.duration));
}

// Minimum number of steps, and its reason.
struct Steps {
  double count;
  std::string reason;
};

Steps min_steps(const Model& model) {
  const GroundPlan plan = ground_plan(model);
  const double duration = model.analysis.duration, step = longest_step(model, plan);
  Steps minimum{duration / step, ""};
  if (step == model.analysis.max_step) {
    minimum.reason = fmt::format("the reason is the max_step of {:g} s", step);
  } else {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Structure& s : model.structures)
      if (vibrates(s) && 2 * M_PI / s.frequencies[0] < shortest) {
        shortest = 2 * M_PI / s.frequencies[0];
        minimum.reason = fmt::format("the reason is the period of {:.3g} s of structure {}", shortest, s.name);
      }
  }
  for (const GroundMotion& motion : plan.motions) {
    const double lasts = std::min(duration, motion.duration()) - motion.start(),
                 of_motion = motion.longest_step(motion.start());
    if (lasts > minimum.count * of_motion)
      minimum = {lasts / of_motion, fmt::format("the reason is the ground motion ({})", motion.source())};
  }
  return minimum;
}

void require_steps(const Model& model) {
  const double maximum = static_cast<double>(model.analysis.max_steps);
  const Steps minimum = min_steps(model);
  if (!(minimum.count > maximum)) return;
  const bool can_be_raised = minimum.count < max_step_count;
  refuse_analysis(
      fmt::format("a run of {:g} s takes at least {:.3g} steps, but at most {:.10g} are allowed: {}; check the units, "
                  "or type analysis: "
                  "{{duration: "
                  "{:.2g} s}}{}",
                  model.analysis.duration, minimum.count, maximum, minimum.reason,
                  model.analysis.duration * maximum / minimum.count,
                  can_be_raised ? fmt::format(", or {{most_steps: {:.0f}}}", std::ceil(2 * minimum.count)) : ""));
}

// Number of values recorded at each output time.
double numbers_of(const Structure& s) {
  const double directions = s.dimension == 3 ? 3 : 1, floors = static_cast<double>(s.floors.size());
  const double on_floors = 3 * directions + (s.has_storeys() ? 2 * std::min(directions, 2.0) : 0);
  const double on_nodes = 3.0 * static_cast<double>(s.nodes.motion.size() * s.nodes.directions.size());
  const double of_members = static_cast<double>(s.reported_members.size() * s.forces.components.size());
  const double reactions = static_cast<double>(s.forces.rows.rows()) -
                           static_cast<double>(s.forces.members.size() * s.forces.components.size());
  return floors * on_floors + on_nodes + of_members + std::max(reactions, 0.0);
}

void require_outputs(const Model& model) {
  const auto& [duration, output_step] = std::pair(model.analysis.duration, model.analysis.output_step);
  const double outputs = duration / output_step;
  if (outputs > limits::outputs)
    refuse_analysis(fmt::format("{:.3g} output times are too many; type analysis: {{output_step: {:.3g}}}", outputs,
                                duration / 1e4));
  double numbers = 0;
  for (const Structure& s : model.structures) numbers += numbers_of(s);
  const double bytes = outputs * numbers * sizeof(double), memory = limits::memory();
  if (bytes > memory)
    refuse_analysis(
        fmt::format("{:.3g} output times of {:.3g} numbers each take {}, but only {} are available; type analysis: "
                    "{{output_step: {:.2g} s}}, or report "
                    "fewer nodes and members",
                    outputs, numbers, limits::text_of_bytes(bytes), limits::text_of_bytes(memory),
                    4 * output_step * bytes / memory));
}

}  // namespace

double longest_step(const Model& model) { return longest_step(model, ground_plan(model)); }

void require_affordable(const Model& model) {
  require_outputs(model);
  require_steps(model);
}

}  // namespace pounding
