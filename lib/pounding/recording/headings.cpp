#include <pounding/recording/headings.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace pounding {

StructureHistory heading(const Structure& s) {
  StructureHistory history;
  history.name = s.name;
  history.kind = s.kind;
  history.dimension = s.is_rigid() ? 1 : s.dimension;
  for (const Floor& floor : s.floors) {
    history.floors.push_back(floor.label);
    history.elevations.push_back(floor.elevation.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (std::ranges::any_of(s.floors, [](const Floor& floor) { return floor.plan.has_value(); }))
    for (const Floor& floor : s.floors) {
      const std::array<double, 4> plan = floor.plan.value_or(std::array{none, none, none, none});
      history.plans.insert(history.plans.end(), plan.begin(), plan.end());
    }
  if (history.dimension == 3) history.directions = {"x", "y", "rz"};
  history.nodes = s.nodes.names;
  history.node_directions = s.nodes.directions;
  for (const int member : s.reported_members) history.members.push_back(s.forces.members[member]);
  history.member_components = s.forces.components;
  history.envelope.members = s.forces.members;
  history.envelope.components = s.forces.components;
  history.envelope.with_gravity = s.forces.with_gravity;
  history.envelope.included = s.forces.included;
  history.envelope.supports = s.forces.supports;
  history.envelope.directions = s.forces.directions;
  history.geometry = s.geometry;
  return history;
}

SpringHistory spring_heading(const Structure& s) {
  SpringHistory history;
  constexpr double never = std::numeric_limits<double>::quiet_NaN();
  for (const YieldingPart& part : s.yielding) {
    history.hinges.push_back(part.kind == YieldingPart::Kind::hinge);
    history.ultimate.push_back(part.hinge ? part.hinge->ultimate_rotation.value_or(never) : never);
    history.names.push_back(part.name);
    history.laws.push_back(part.law);
    history.stiffness.push_back(part.stiffness() + part.first_slope());
    history.limits.push_back(part.limits);
  }
  const std::size_t parts = s.yielding.size();
  history.deformations = history.forces = history.resultants = Extremes(parts);
  history.last.assign(parts, 0.0);
  for (std::vector<double>* values : {&history.lost, &history.plastic, &history.cycles.turn, &history.cycles.swings})
    values->assign(parts, 0.0);
  history.first_yield.assign(parts, never);
  history.damping_shear.assign(parts, never);
  if (!s.storey_stiffness.empty()) std::fill_n(history.damping_shear.begin(), s.members_that_yield(), 0.0);
  return history;
}

LinkHistory heading(const Link& link, const Model& model) {
  LinkHistory history;
  history.name = link.name;
  history.gap = link.gap;
  history.seat = link.seat.value_or(std::numeric_limits<double>::quiet_NaN());
  history.law = link.law;
  history.left = {model.structures[link.left.structure].name, link.left.floor + 1, link.left.label};
  history.right = {model.structures[link.right.structure].name, link.right.floor + 1, link.right.label};
  // A frame has a defined location; the other structures are placed where their links are.
  const bool only_right_has_place = model.structures[link.left.structure].geometry.positions.empty() &&
                                    !model.structures[link.right.structure].geometry.positions.empty();
  const LinkEnd& end = only_right_has_place ? link.right : link.left;
  const Eigen::Vector3d position =
      end.point.position + (only_right_has_place ? -1 : 1) * end.face.value_or(0) * link.direction;
  for (int i = 0; i < 3; ++i) {
    history.position[i] = position[i];
    history.direction[i] = link.direction[i];
  }
  return history;
}

DeviceHistory heading(const Device& device, const Model& model) {
  DeviceHistory history;
  history.name = device.name;
  history.left = {model.structures[device.left.structure].name, device.left.floor + 1, device.left.label};
  history.right = {model.structures[device.right.structure].name, device.right.floor + 1, device.right.label};
  for (int i = 0; i < 3; ++i) {
    history.position[i] = device.left.point.position[i];
    history.direction[i] = device.direction[i];
  }
  history.stiffness = device.member->first_slope();
  if (device.parts.damper) {
    history.coefficient = device.parts.damper->coefficient;
    history.exponent = device.parts.damper->exponent;
  }
  return history;
}

Results results_at_rest(const Model& model) {
  Results results;
  results.title = model.title;
  results.status = "not run";
  results.model_yaml = model.source_text;
  for (const Structure& s : model.structures) {
    StructureHistory history = heading(s);
    history.springs = spring_heading(s);
    // Files contain extremes of the forces on all members and supports.
    history.envelope.member_force = Extremes(s.forces.members.size() * s.forces.components.size());
    history.envelope.reaction = Extremes(s.forces.supports.size() * s.forces.directions.size());
    results.structures.push_back(std::move(history));
  }
  for (const Link& link : model.links) results.links.push_back(heading(link, model));
  for (const Device& device : model.devices) results.devices.push_back(heading(device, model));
  results.summary_json = "{}";
  return results;
}

}  // namespace pounding
