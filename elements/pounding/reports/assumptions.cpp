#include <pounding/reports/assumptions.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <pounding/core/sha256.hpp>
#include <pounding/reports/describe.hpp>

namespace pounding {
namespace {

using AssumptionsJson = nlohmann::ordered_json;

// Number of periods per structure.
constexpr int max_reported_periods = 3;

AssumptionsJson ground_json(const GroundComponents& components) {
  AssumptionsJson all = AssumptionsJson::array();
  for (int i = 0; i < 3; ++i) {
    const GroundMotion& motion = components[i];
    if (motion.is_still()) continue;
    all.push_back({{"direction", std::string(1, "xyz"[i])},
                   {"source", motion.source()},
                   {"peak", motion.peak()},
                   {"duration", motion.duration()}});
  }
  return all;
}

AssumptionsJson structure_json(const Structure& s) {
  AssumptionsJson one{{"kind", s.kind}};
  if (s.is_rigid()) return one;
  one["floors"] = s.floors.size();
  one["mass"] = s.total_mass()[0];
  std::vector<double> periods;
  for (int i = 0; i < s.frequencies.size() && i < max_reported_periods; ++i)
    if (s.frequencies[i] > 0) periods.push_back(2 * M_PI / s.frequencies[i]);
  one["periods"] = periods;
  one["damping"] = s.damping_note;
  // Only frames have internal forces to which gravity could contribute.
  if (!s.forces.members.empty()) {
    one["gravity"] = s.forces.with_gravity;
    one["included"] = s.forces.included;
  }
  if (!s.yielding.empty()) one["yielding_parts"] = s.yielding.size();
  const Support& support = s.supports.front();
  if (support.motion) one["ground"] = ground_json(*support.motion);
  if (support.delay > 0) one["delay"] = support.delay;
  std::vector<std::string> devices, forces;
  for (const YieldingPart& part : s.yielding)
    if (part.is_device()) devices.push_back(part.name + ": " + part.device);
  for (const AppliedForce& force : s.applied_forces) forces.push_back(force.place + ": " + force.history.source());
  if (!devices.empty()) one["devices"] = std::move(devices);
  if (!forces.empty()) one["forces"] = std::move(forces);
  return one;
}

}  // namespace

AssumptionsJson link_json(const Model& model, const Link& link) {
  AssumptionsJson one{{"name", link.name},
                      {"between", {end_name(model, link.left), end_name(model, link.right)}},
                      {"law", link.law},
                      {"gap", link.gap}};
  if (link.preload) one["preload"] = true;
  if (link.friction > 0) one["friction"] = link.friction;
  if (link.reduced_mass > 0) {
    one["reduced_mass"] = link.reduced_mass;
    one["reduced_mass_from"] = link.reduced_mass_given ? "the input" : "the masses of the two ends";
  }
  one["stiffness_from"] = link.stiffness_from.empty() ? "the input" : link.stiffness_from;
  AssumptionsJson parameters = AssumptionsJson::object(), units = AssumptionsJson::object();
  for (const laws::ResolvedValue& value : link.parameters) {
    parameters[value.name] = value.value;
    if (!value.unit.empty()) units[value.name] = value.unit;
  }
  one["parameters"] = std::move(parameters);
  one["units"] = std::move(units);
  return one;
}

std::string assumptions_json(const Model& model) {
  AssumptionsJson all{{"title", model.title}};
  if (!model.project.empty()) all["project"] = model.project;
  if (!model.source_text.empty()) all["sha256"] = sha256(model.source_text);
  all["ground"] = ground_json(model.ground.components);
  if (model.ground.wave) all["wave_velocity"] = model.ground.wave->velocity;
  all["structures"] = AssumptionsJson::object();
  for (const Structure& s : model.structures) all["structures"][s.name] = structure_json(s);
  all["links"] = AssumptionsJson::array();
  for (const Link& link : model.links) all["links"].push_back(link_json(model, link));
  if (!model.devices.empty()) all["devices"] = AssumptionsJson::array();
  for (const Device& device : model.devices)
    all["devices"].push_back({{"name", device.name},
                              {"between", {end_name(model, device.left), end_name(model, device.right)}},
                              {"parts", describe(device.parts)}});
  return all.dump(-1, ' ', false, AssumptionsJson::error_handler_t::replace);
}

}  // namespace pounding
