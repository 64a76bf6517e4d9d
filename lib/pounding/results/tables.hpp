#pragma once
/// The datasets of a results file, by the object that contains them.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/results/results.hpp>
#include <pounding/results/variable.hpp>

namespace pounding::tables {

using Energy = EnergyHistory;
using Envelope = StructureEnvelope;
using Labels = std::vector<std::string>;
using Part = SpringSummary;
using Solver = SolverStatistics;
using Springs = SpringHistory;

inline const Labels extremes{"minimum", "maximum"};

// Members of members.
template <auto member>
inline constexpr auto energy = stored<&Results::energy, member>;
template <auto member>
inline constexpr auto solver = value<&Results::solver, member>;
template <auto member>
inline constexpr auto springs = stored<&StructureHistory::springs, member>;
template <auto member>
inline constexpr auto envelope = value<&StructureHistory::envelope, member>;
template <auto member>
inline constexpr auto geometry = value<&StructureHistory::geometry, member>;

// --- Results: the file itself, or the group of the run without links

inline constexpr Variable<Results> results_variables[] = {
    {"input/model.yaml", "", "text", "input as given", value<&Results::model_yaml>},
    {"input/resolved.yaml", "", "text", "input with every default and calibrated parameter",
     value<&Results::resolved_yaml>},
    {"ground/time", "time", "s", "output times", stored<&Results::time>},
    {"ground/acceleration", "time", "m/s^2", "acceleration of the ground at the output times",
     stored<&Results::ground_acceleration>},
    {"ground/acceleration_y", "time", "m/s^2", "ground acceleration along y at the output times",
     stored<&Results::ground_acceleration_y>, [](const Results& r) { return r.shakes_y; }},
    {"ground/acceleration_z", "time", "m/s^2", "ground acceleration along z at the output times, positive up",
     stored<&Results::ground_acceleration_z>, [](const Results& r) { return r.shakes_z; }},
    {"energy/time", "time", "s", "time", energy<&Energy::time>},
    {"energy/input", "time", "J",
     "relative input energy: work of -M r ag and of forces on the motion relative to the ground, and the energy at the "
     "start",
     energy<&Energy::input>},
    {"energy/kinetic", "time", "J", "kinetic energy of the motion relative to the ground", energy<&Energy::kinetic>},
    {"energy/strain", "time", "J", "elastic energy", energy<&Energy::strain>},
    {"energy/damping", "time", "J", "energy dissipated by the damping of the structures", energy<&Energy::damping>},
    {"energy/hysteretic", "time", "J", "energy dissipated by yielding", energy<&Energy::hysteretic>},
    {"energy/impact", "time", "J", "work done on the links: lost, and stored while they press",
     energy<&Energy::impact>},
    {"energy/devices", "time", "J", "energy dissipated by dampers", energy<&Energy::devices>,
     [](const Results& r) { return r.has_devices(); }},
    {"energy/error", "time", "J", "input minus all other parts", energy<&Energy::error>},
    {"summary", "", "text", "summary as JSON", value<&Results::summary_json>},
    {"solver/steps", "", "1", "steps kept", solver<&Solver::steps>},
    {"solver/rejected", "", "1", "steps thrown away by the error control", solver<&Solver::rejected>},
    {"solver/events", "", "1", "located touches, reversals, releases and separations", solver<&Solver::events>},
    {"solver/iterations", "", "1", "iterations of the link equations", solver<&Solver::iterations>},
    {"solver/wall_seconds", "", "s", "wall time", solver<&Solver::wall_seconds>},
    {"solver/wall_setup", "", "s", "wall time before the first step", solver<&Solver::wall_setup>},
    {"solver/wall_solve", "", "s", "wall time of the steps", solver<&Solver::wall_solve>},
    {"solver/wall_output", "", "s", "wall time of recording and writing", solver<&Solver::wall_output>},
};

inline constexpr Table<Results> of_results{{}, {}, results_variables};

// --- structures/NAME

/// One value per yielding part.
template <auto member>
inline constexpr auto of_springs = [](const StructureHistory& s) {
  std::vector<double> values;
  for (const SpringSummary& row : summaries(s.springs)) values.push_back(row.*member);
  return values;
};

template <auto member>
inline constexpr auto yield_limits = [](const StructureHistory& s) {
  std::vector<double> values;
  for (const YieldLimits& limits : s.springs.limits) values.push_back(limits.*member);
  return values;
};

inline constexpr bool (*has_plan)(const StructureHistory&) = [](const StructureHistory& s) { return !s.plans.empty(); };

inline Labels storey_directions(const StructureHistory& s) {
  return s.storey_directions() == 1 ? Labels{"x"} : Labels{"x", "y"};
}

/// Shear of the lowest storey: [time, direction].
inline std::vector<double> base_shear(const StructureHistory& s) {
  const std::size_t directions = s.storey_directions(), row = s.floors.size() * directions;
  std::vector<double> lowest;
  for (std::size_t first = 0; first + row <= s.storey_shear.size(); first += row)
    lowest.insert(lowest.end(), s.storey_shear.begin() + first, s.storey_shear.begin() + first + directions);
  return lowest;
}

inline const StructureEnvelope& loads(const StructureHistory& s) { return s.envelope; }

/// Storeys in the plane have one direction, without a dimension. The floors of a structure without storeys have none.
inline const char* structure_dims(const Variable<StructureHistory>& variable, const StructureHistory& s,
                                  std::size_t count) {
  if (std::string_view(variable.dims) != "time floor storey_direction") return variable.dims;
  return count == 0 ? "time storey" : s.storey_directions() == 1 ? "time floor" : variable.dims;
}

inline constexpr Group<StructureHistory> structure_groups[] = {
    {"", nullptr, "elevation"},
    {"nodes", [](const StructureHistory& s) { return !s.nodes.empty(); }},
    {"members", [](const StructureHistory& s) { return !s.members.empty(); }},
    {"reactions", [](const StructureHistory& s) { return !s.envelope.supports.empty(); }},
    {"springs", [](const StructureHistory& s) { return s.springs.size() > 0; }},
    {"geometry", [](const StructureHistory& s) { return !s.geometry.positions.empty(); }, "node_names member_names"},
};

inline constexpr Dimension<StructureHistory> structure_dimensions[] = {
    {"floor", value<&StructureHistory::floors>, "floors"},
    {"direction", value<&StructureHistory::directions>, "directions"},
    {"storey_direction", storey_directions},
    {"storey", [](const StructureHistory&) { return Labels{}; }, "floors"},
    {"extent", [](const StructureHistory&) { return Labels{"smallest x", "largest x", "smallest y", "largest y"}; }},
    {"nodes/node", value<&StructureHistory::nodes>},
    {"nodes/node_direction", value<&StructureHistory::node_directions>, "directions"},
    {"members/member", value<&StructureHistory::members>},
    {"members/component", value<&StructureHistory::member_components>, "components"},
    {"reactions/support", envelope<&Envelope::supports>},
    {"reactions/support_direction", envelope<&Envelope::directions>, "directions"},
    {"springs/spring", value<&StructureHistory::springs, &Springs::names>},
    {"geometry/node", [](const StructureHistory& s) { return s.geometry.positions.size(); }},
    {"geometry/member", [](const StructureHistory& s) { return s.geometry.members.size(); }},
    {"geometry/axis", [](const StructureHistory&) { return Labels{"x", "y", "z"}; }},
    {"geometry/end", [](const StructureHistory&) { return Labels{"start", "end"}; }},
};

inline constexpr Variable<StructureHistory> structure_variables[] = {
    {"elevation", "floor", "m", "elevation of the floor", stored<&StructureHistory::elevations>,
     [](const StructureHistory& s) { return !s.elevations.empty(); }},
    {"plan", "floor extent", "m",
     "extent of rigid floors about the point whose motion is reported: smallest x, largest x, smallest y, largest y",
     stored<&StructureHistory::plans>, has_plan},
    {"displacement", "time floor direction", "m", "displacement relative to the ground",
     stored<&StructureHistory::displacement>},
    {"velocity", "time floor direction", "m/s", "velocity relative to the ground", stored<&StructureHistory::velocity>},
    {"acceleration", "time floor direction", "m/s^2", "absolute acceleration", stored<&StructureHistory::acceleration>},
    {"drift", "time floor storey_direction", "m", "storey drift: displacement relative to the floor below",
     stored<&StructureHistory::drift>},
    {"storey_shear", "time floor storey_direction", "N", "shear force of the storey below the floor",
     stored<&StructureHistory::storey_shear>},
    {"base_shear", "time storey_direction", "N", "shear force of the lowest storey", base_shear,
     [](const StructureHistory& s) { return !s.storey_shear.empty(); }},
    {"nodes/names", "node", "text", "names of the nodes", value<&StructureHistory::nodes>},
    {"nodes/displacement", "time node node_direction", "m", "displacement relative to the ground",
     stored<&StructureHistory::node_displacement>},
    {"nodes/velocity", "time node node_direction", "m/s", "velocity relative to the ground",
     stored<&StructureHistory::node_velocity>},
    {"nodes/acceleration", "time node node_direction", "m/s^2", "absolute acceleration",
     stored<&StructureHistory::node_acceleration>},
    {"members/names", "member", "text", "names of the members", value<&StructureHistory::members>},
    {"members/end_forces", "time member component", "N",
     "forces [N] and moments [N m] on the ends of members, local axes", stored<&StructureHistory::end_forces>, nullptr,
     loads},
    {"reactions/names", "support", "text", "names of the nodes", envelope<&Envelope::supports>},
    {"reactions/force", "time support support_direction", "N",
     "forces [N] and moments [N m] of the ground on the structure, without damping",
     stored<&StructureHistory::reaction>, nullptr, loads},
    {"springs/names", "spring", "text", "names of the parts that yield",
     value<&StructureHistory::springs, &Springs::names>},
    {"springs/laws", "spring", "text", "laws of their forces", value<&StructureHistory::springs, &Springs::laws>},
    {"springs/stiffness", "spring", "N/m", "initial stiffness; of hinges [N m/rad]", springs<&Springs::stiffness>},
    {"springs/yield_deformation", "spring", "m", "deformation at the first yield; for hinges [rad]",
     yield_limits<&YieldLimits::positive>},
    {"springs/negative_yield_deformation", "spring", "m", "magnitude in the negative direction; for hinges [rad]",
     yield_limits<&YieldLimits::negative>},
    {"springs/ultimate_rotation", "spring", "rad", "ultimate plastic rotation of a hinge; NaN if not given",
     springs<&Springs::ultimate>},
    {"springs/deformation", "time spring", "m", "drift of a storey, elongation of a device; rotation of a hinge [rad]",
     springs<&Springs::deformation>},
    {"springs/force", "time spring", "N", "shear of a storey, tension of a device; moment of a hinge [N m]",
     springs<&Springs::force>},
    {"springs/hysteretic", "time spring", "J",
     "cumulative energy dissipated by yielding, and by the damper of a device", springs<&Springs::hysteretic>},
    {"springs/summary/peak_deformation", "spring", "m", "deformation of largest magnitude, signed; for hinges [rad]",
     of_springs<&Part::peak>},
    {"springs/summary/peak_time", "spring", "s", "time of peak_deformation", of_springs<&Part::peak_time>},
    {"springs/summary/peak_force", "spring", "N", "largest absolute force; for hinges [N m]",
     of_springs<&Part::peak_force>},
    {"springs/summary/ductility", "spring", "1",
     "largest ratio of deformation to the yield deformation in its direction; of a coupled isolator, of the resultant; "
     "for hinges, of the rotation of the member end to its yield rotation",
     of_springs<&Part::ductility>},
    {"springs/summary/peak_plastic", "spring", "m", "largest absolute plastic deformation; for hinges [rad]",
     of_springs<&Part::plastic>},
    {"springs/summary/cycles", "spring", "1",
     "half the number of swings that exceed the sum of both yield deformations", of_springs<&Part::cycles>},
    {"springs/summary/residual", "spring", "m",
     "deformation at the end of the run, possibly still moving; for hinges [rad]", of_springs<&Part::residual>},
    {"springs/summary/hysteretic", "spring", "J", "energy dissipated by yielding", of_springs<&Part::energy_lost>},
    {"springs/summary/first_yield", "spring", "s",
     "time at which the yield deformation was first exceeded; NaN if never", of_springs<&Part::first_yield>},
    {"springs/summary/damping_shear", "spring", "1",
     "largest damping force across the storey divided by its yield force; NaN for hinges",
     of_springs<&Part::damping_shear>},
    {"springs/summary/state", "spring", "text", "elastic, yielded once at least, or beyond ultimate",
     [](const StructureHistory& s) {
       Labels states;
       for (const SpringSummary& row : summaries(s.springs)) states.emplace_back(row.state());
       return states;
     }},
    {"geometry/nodes", "node axis", "m", "undeformed positions of the nodes: x, y, z",
     [](const StructureHistory& s) {
       std::vector<double> nodes;
       for (const Eigen::Vector3d& p : s.geometry.positions) nodes.insert(nodes.end(), p.begin(), p.end());
       return nodes;
     }},
    {"geometry/members", "member end", "1", "nodes of the members, counted from 0",
     [](const StructureHistory& s) {
       std::vector<int> members;
       for (const auto& ends : s.geometry.members) members.insert(members.end(), ends.begin(), ends.end());
       return members;
     }},
    {"geometry/floor_of_node", "node", "1", "floor of each node, counted from 0 at the lowest; -1 for none",
     geometry<&Geometry::floor_of_node>},
    {"geometry/node_names", "node", "text", "names of the nodes", geometry<&Geometry::node_names>},
    {"geometry/member_names", "member", "text", "names of the members", geometry<&Geometry::member_names>},
};

inline constexpr Table<StructureHistory> of_structure{structure_groups, structure_dimensions, structure_variables,
                                                      structure_dims};

// --- envelopes/structures/NAME

/// The first rows of extremes over floors and storey directions.
inline Extremes base_shear_extremes(const StructureHistory& s) {
  const std::size_t directions = s.storey_directions();
  Extremes lowest(std::min(directions, s.envelope.storey_shear.size()));
  for (std::size_t i = 0; i < lowest.size(); ++i) lowest.copy(i, s.envelope.storey_shear, i);
  return lowest;
}

inline constexpr Dimension<StructureHistory> envelope_dimensions[] = {
    {"floor", value<&StructureHistory::floors>},
    {"direction", value<&StructureHistory::directions>, "directions"},
    {"storey_direction", storey_directions, "directions"},
    {"base", [](const StructureHistory&) { return std::size_t{1}; }},
    {"edge",
     [](const StructureHistory&) { return Labels(StructureEnvelope::edges.begin(), StructureEnvelope::edges.end()); },
     "edges"},
    {"member", envelope<&Envelope::members>},
    {"component", envelope<&Envelope::components>, "components"},
    {"axial", [](const StructureHistory&) { return Labels{"N"}; }, "components"},
    {"support", envelope<&Envelope::supports>},
    {"support_direction", envelope<&Envelope::directions>, "directions"},
};

inline constexpr Variable<StructureHistory> envelope_variables[] = {
    {"displacement", "floor direction extreme", "m", "minimum and maximum displacement relative to the ground",
     envelope<&Envelope::displacement>},
    {"edge_displacement", "floor edge extreme", "m",
     "minimum and maximum displacement of an edge of a rigid floor along itself",
     envelope<&Envelope::edge_displacement>},
    {"acceleration", "floor direction extreme", "m/s^2", "minimum and maximum absolute acceleration",
     envelope<&Envelope::acceleration>},
    {"drift", "floor storey_direction extreme", "m", "minimum and maximum storey drift", envelope<&Envelope::drift>},
    {"storey_shear", "floor storey_direction extreme", "N",
     "minimum and maximum shear force of the storey below the floor", envelope<&Envelope::storey_shear>},
    {"base_shear", "base storey_direction extreme", "N", "minimum and maximum shear force of the lowest storey",
     base_shear_extremes},
    {"members", "member", "text", "names of the members", envelope<&Envelope::members>,
     [](const StructureHistory& s) { return !s.envelope.members.empty(); }},
    {"member_force", "member component extreme", "N",
     "minimum and maximum force [N] or moment [N m] on an end of a member, local axes",
     envelope<&Envelope::member_force>, nullptr, loads},
    {"axial_force", "member axial extreme", "N",
     "minimum and maximum axial force of a member over both ends, positive in tension",
     [](const StructureHistory& s) { return axial_forces(s.envelope); }, nullptr, loads},
    {"supports", "support", "text", "names of the nodes that the ground holds", envelope<&Envelope::supports>,
     [](const StructureHistory& s) { return !s.envelope.supports.empty(); }},
    {"reaction", "support support_direction extreme", "N",
     "minimum and maximum force [N] or moment [N m] of the ground on the structure", envelope<&Envelope::reaction>,
     nullptr, loads},
};

inline constexpr Table<StructureHistory> of_envelope{{}, envelope_dimensions, envelope_variables};

// --- links/NAME

inline constexpr bool (*has_friction)(const LinkHistory&) = [](const LinkHistory& link) { return link.tangents > 0; };

inline constexpr Dimension<LinkHistory> link_dimensions[] = {
    {"tangent", [](const LinkHistory& link) { return link.tangents == 1 ? Labels{"up"} : Labels{"along", "up"}; }},
};

inline constexpr Variable<LinkHistory> link_variables[] = {
    {"time", "time", "s", "time, dense inside contacts", stored<&LinkHistory::time>},
    {"penetration", "time", "m", "penetration, positive when overlapping, negative when open",
     stored<&LinkHistory::penetration>},
    {"velocity", "time", "m/s", "rate of the penetration, positive when closing", stored<&LinkHistory::velocity>},
    {"force", "time", "N", "contact force, positive when it pushes apart", stored<&LinkHistory::force>},
    {"energy", "time", "J", "work done on the link, stored and lost", stored<&LinkHistory::energy>},
    {"friction", "time tangent", "N",
     "friction force on the left body, opposite to its sliding: along the edge, then up; in the plane up only",
     stored<&LinkHistory::friction>, has_friction},
};

inline constexpr Table<LinkHistory> of_link{{}, link_dimensions, link_variables};

// --- devices/NAME

/// Extremes of one quantity of a device.
template <std::size_t quantity>
Extremes device_extremes(const DeviceHistory& device) {
  Extremes one(1);
  one.copy(0, device.extremes, quantity);
  return one;
}

inline constexpr Dimension<DeviceHistory> device_dimensions[] = {
    {"envelope/extreme", [](const DeviceHistory&) { return extremes; }},
};

inline constexpr Variable<DeviceHistory> device_variables[] = {
    {"elongation", "time", "m", "elongation, positive when longer", stored<&DeviceHistory::elongation>},
    {"force", "time", "N", "force, positive in tension", stored<&DeviceHistory::force>},
    {"envelope/elongation", "extreme", "m", "minimum and maximum elongation", device_extremes<0>},
    {"envelope/force", "extreme", "N", "minimum and maximum force", device_extremes<1>},
};

inline constexpr Table<DeviceHistory> of_device{{}, device_dimensions, device_variables};

// --- solver/reduction/NAME

inline constexpr bool (*has_check)(const ReducedStructure&) = [](const ReducedStructure& s) {
  return s.checked_windows > 0;
};

inline constexpr Dimension<ReducedStructure> reduction_dimensions[] = {
    {"chain", [](const ReducedStructure&) { return Labels{"links", "ground"}; }},
    {"input", [](const ReducedStructure&) { return Labels{"links", "friction", "devices", "parts", "ground"}; }},
};

inline constexpr Variable<ReducedStructure> reduction_variables[] = {
    {"coordinates", "", "1", "coordinates of the structure", value<&ReducedStructure::coordinates>},
    {"blocks", "chain", "1", "blocks of the chain of the links and of that of the ground",
     [](const ReducedStructure& s) { return std::vector<int>{s.link_blocks, s.ground_blocks}; }},
    {"inputs", "input", "1",
     "vectors that drive the chain of the links, those of friction and of devices among them, parts that yield, and "
     "vectors of the ground",
     [](const ReducedStructure& s) { return std::vector<int>{s.links, s.frictions, s.devices, s.parts, s.grounds}; }},
    {"frequency", "", "Hz", "of the block at the contact; 0 for none", value<&ReducedStructure::frequency>},
    {"error_force", "", "1", "three times the estimated error of peak forces of links over the largest force",
     value<&ReducedStructure::error_force>},
    {"error_displacement", "", "1", "the same of displacements of floors",
     value<&ReducedStructure::error_displacement>},
    {"error_acceleration", "", "1", "the same of accelerations of floors",
     value<&ReducedStructure::error_acceleration>},
    {"error_members", "", "1", "the same of forces and moments of members", value<&ReducedStructure::error_members>},
    {"checked_windows", "", "1", "hardest impacts through which all unknowns were stepped",
     value<&ReducedStructure::checked_windows>, has_check},
    {"check_force", "", "1",
     "difference of peak forces of links in them over the largest force; NaN where none hits the structure",
     value<&ReducedStructure::check_force>, has_check},
    {"check_displacement", "", "1", "the same of displacements of floors", value<&ReducedStructure::check_displacement>,
     has_check},
};

inline constexpr Table<ReducedStructure> of_reduction{{}, reduction_dimensions, reduction_variables};

// --- checkpoint

inline constexpr Dimension<Checkpoint> checkpoint_dimensions[] = {
    {"byte", [](const Checkpoint& c) { return c.state.size(); }},
};

inline constexpr Variable<Checkpoint> checkpoint_variables[] = {
    {"model_file", "", "text", "absolute path of the input file", value<&Checkpoint::model_file>},
    {"options", "", "text", "PETSc options that affect the results",
     [](const Checkpoint& c) { return fmt::format("{}", fmt::join(c.options, "\n")); }},
    {"state", "byte", "byte", "state of the program that wrote it",
     [](const Checkpoint& c) -> const std::vector<std::byte>& { return c.state; }},
};

inline constexpr Table<Checkpoint> of_checkpoint{{}, checkpoint_dimensions, checkpoint_variables};

}  // namespace pounding::tables
