#include <pounding/results/summary.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pounding/results/comparison.hpp>

namespace pounding {
namespace {

using Json = nlohmann::ordered_json;

// An energy imbalance above this multiple of the tolerance indicates an unresolved motion.
constexpr double suspicious_imbalance = 100;

constexpr double none = std::numeric_limits<double>::quiet_NaN();  // null in JSON, as every number that is not finite

// An object with capacity for this number of members, which avoids copies while it grows.
Json object_of(std::size_t members) {
  Json made = Json::object();
  made.get_ref<Json::object_t&>().reserve(members);
  return made;
}

// One number a place, or a list a place where there are several directions or components.
Json places_json(const std::vector<double>& values, std::size_t along) {
  if (along == 1) return values;
  Json all = Json::array();
  for (auto at = values.begin(); at != values.end(); at += static_cast<std::ptrdiff_t>(along))
    all.push_back(std::vector<double>(at, at + static_cast<std::ptrdiff_t>(along)));
  return all;
}

Json extremes_json(const Extremes& e, std::size_t along) {
  Json all = object_of(4);
  all["min"] = places_json(e.min, along);
  all["max"] = places_json(e.max, along);
  all["t_min"] = places_json(e.t_min, along);
  all["t_max"] = places_json(e.t_max, along);
  return all;
}

// The lowest storey in a list of storeys.
Extremes lowest(const Extremes& storeys, std::size_t along) {
  Extremes base(along);
  for (std::size_t i = 0; i < along; ++i) base.copy(i, storeys, i);
  return base;
}

Json envelope_json(const StructureSummary& s) {
  const StructureEnvelope& e = s.envelope;
  Json all = object_of(15);
  const std::size_t directions = s.directions.size(), storey_directions = directions == 1 ? 1 : 2;
  if (e.displacement.size() > 0) {
    all["displacement"] = extremes_json(e.displacement, directions);
    all["acceleration"] = extremes_json(e.acceleration, directions);
  }
  if (e.edge_displacement.size() > 0) {
    all["edges"] = e.edges;
    all["edge_displacement"] = extremes_json(e.edge_displacement, e.edges.size());
  }
  if (e.drift.size() > 0) all["drift"] = extremes_json(e.drift, storey_directions);
  if (e.storey_shear.size() > 0) {
    all["storey_shear"] = extremes_json(e.storey_shear, storey_directions);
    all["base_shear"] = extremes_json(lowest(e.storey_shear, storey_directions), storey_directions);
  }
  if (e.member_force.size() > 0) {
    all["members"] = e.members;
    all["components"] = e.components;
    all["member_force"] = extremes_json(e.member_force, e.components.size());
    all["axial_force"] = extremes_json(axial_forces(e), 1);
  }
  if (e.member_force.size() > 0 || e.reaction.size() > 0) {
    all["gravity_included"] = e.with_gravity;
    all["included"] = e.included;
  }
  if (e.reaction.size() > 0) {
    all["supports"] = e.supports;
    all["directions"] = e.directions;
    all["reaction"] = extremes_json(e.reaction, e.directions.size());
  }
  return all;
}

// The yielding parts, and the one with the largest ductility.
Json yielding_json(const std::vector<SpringSummary>& springs) {
  Json parts = Json::array();
  for (const SpringSummary& s : springs)
    parts.push_back({{"name", s.name},
                     {"law", s.law},
                     {"state", s.state()},
                     {"peak", s.peak},
                     {"time", s.peak_time},
                     {"ductility", s.ductility},
                     {"plastic", s.plastic},
                     {"ultimate_rotation", s.ultimate},
                     {"cycles", s.cycles},
                     {"residual", s.residual},
                     {"peak_force", s.peak_force},
                     {"energy_lost", s.energy_lost},
                     {"first_yield", s.first_yield},
                     {"damping_shear", s.damping_shear}});
  const SpringSummary& maximum = *most_ductile(springs);
  Json all = object_of(3);
  all["yielded"] = std::ranges::count_if(springs, &SpringSummary::yielded);
  all["largest"] = {{"name", maximum.name},
                    {"ductility", maximum.ductility},
                    {"deformation", maximum.peak},
                    {"time", maximum.peak_time}};
  all["springs"] = std::move(parts);
  return all;
}

Json structures_json(const std::vector<StructureSummary>& structures) {
  Json all = object_of(structures.size());
  for (const StructureSummary& s : structures) {
    Json& one = all[s.name] = object_of(10);
    one["peak_displacement"] = s.peak_displacement;
    one["peak_drift"] = s.peak_drift;
    one["peak_acceleration"] = s.peak_acceleration;
    if (!s.peak_rotation.empty()) {
      one["peak_rotation"] = s.peak_rotation;
      one["peak_edge_displacement"] = s.peak_edge_displacement;
    }
    one["envelope"] = envelope_json(s);
    if (s.springs.empty()) continue;
    one["residual_displacement"] = s.residual_displacement;
    one["residual_drift"] = s.residual_drift;
    if (!s.residual_drift_ratio.empty()) one["residual_drift_ratio"] = s.residual_drift_ratio;
    one["yielding"] = yielding_json(s.springs);
  }
  return all;
}

// The hinges of all frames; null if there are none.
Json hinges_json(const std::vector<StructureSummary>& structures) {
  long count = 0, yielded = 0, beyond = 0;
  const SpringSummary* maximum = nullptr;
  const StructureSummary* of = nullptr;
  for (const StructureSummary& s : structures)
    for (const SpringSummary& part : s.springs) {
      if (!part.is_hinge) continue;
      ++count;
      yielded += part.yielded();
      beyond += part.is_beyond_ultimate();
      if (maximum && part.ductility <= maximum->ductility) continue;
      maximum = &part;
      of = &s;
    }
  if (!maximum) return {};
  return {{"count", count},
          {"yielded", yielded},
          {"beyond_ultimate", beyond},
          {"largest",
           {{"structure", of->name},
            {"name", maximum->name},
            {"ductility", maximum->ductility},
            {"rotation", maximum->plastic}}}};
}

// Energy dissipated by each part [J]; empty if no structure yields.
Json hysteretic_json(const std::vector<StructureSummary>& structures) {
  Json all = object_of(structures.size());
  for (const StructureSummary& s : structures) {
    if (s.springs.empty()) continue;
    Json parts = object_of(s.springs.size());
    for (const SpringSummary& part : s.springs) parts[part.name] = part.energy_lost;
    all[s.name] = std::move(parts);
  }
  return all;
}

Json impacts_json(const Summary& summary) {
  Json all = Json::array();
  for (const ImpactRow& row : summary.impacts)
    all.push_back({{"link", summary.links[row.link].name},
                   {"t_start", row.t_start},
                   {"t_end", row.t_end},
                   {"v_approach", row.v_approach},
                   {"v_separation", row.v_separation},
                   {"restitution", row.restitution},
                   {"peak_force", row.peak_force},
                   {"t_peak", row.t_peak},
                   {"peak_penetration", row.peak_penetration},
                   {"impulse", row.impulse},
                   {"energy_lost", row.energy_lost},
                   {"energy_stored", row.energy_stored}});
  return all;
}

Json devices_json(const std::vector<DeviceSummary>& devices) {
  Json all = Json::array();
  for (const DeviceSummary& s : devices) {
    Json one = {{"name", s.name}};
    for (std::size_t i = 0; const char* quantity : {"elongation", "force"}) {
      const Extremes& e = s.extremes;
      one[quantity] = {{"min", e.min[i]}, {"max", e.max[i]}, {"t_min", e.t_min[i]}, {"t_max", e.t_max[i]}};
      ++i;
    }
    one["energy_lost"] = s.energy_lost;
    all.push_back(std::move(one));
  }
  return all;
}

Json reduction_json(const std::vector<ReducedStructure>& structures) {
  Json all = Json::object();
  for (const ReducedStructure& s : structures) {
    all[s.name] = {{"coordinates", s.coordinates},
                   {"unknowns", s.unknowns},
                   {"blocks", {s.link_blocks, s.ground_blocks}},
                   {"inputs",
                    {{"links", s.links},
                     {"friction", s.frictions},
                     {"devices", s.devices},
                     {"parts", s.parts},
                     {"ground", s.grounds}}},
                   {"frequency", s.frequency},
                   {"error_force", s.error_force},
                   {"error_displacement", s.error_displacement},
                   {"error_acceleration", s.error_acceleration},
                   {"error_members", s.error_members}};
    if (s.checked_windows > 0)
      all[s.name]["check"] = {
          {"windows", s.checked_windows}, {"error_force", s.check_force}, {"error_displacement", s.check_displacement}};
  }
  return all;
}

// If structures collapse without links, no gap is sufficient.
Json separations_json(const std::vector<LinkSeparation>& separations, bool complete) {
  const auto of_run = [&](double value) { return complete ? value : none; };
  Json all = Json::array();
  for (const LinkSeparation& s : separations)
    all.push_back({{"link", s.link},
                   {"gap", s.gap},
                   {"enough", of_run(s.enough)},
                   {"time", of_run(s.time)},
                   {"left", of_run(s.left)},
                   {"right", of_run(s.right)},
                   {"abs", of_run(s.absolute_sum)},
                   {"srss", of_run(s.srss)},
                   {"ddc", of_run(s.ddc)}});
  return all;
}

}  // namespace

LinkSummary summary_of(const std::string& name, std::span<const ImpactRow> impacts) {
  LinkSummary s;
  s.name = name;
  if (!impacts.empty()) s.peak_force = none;  // fmax() replaces it by the first finite force
  for (const ImpactRow& row : impacts) {
    ++s.impacts;
    s.peak_force = std::fmax(s.peak_force, row.peak_force);
    s.peak_penetration = std::max(s.peak_penetration, row.peak_penetration);
    s.impulse += row.impulse;
    s.energy_lost += row.energy_lost;
    s.energy_stored += row.energy_stored;
    s.presses = s.presses || still_presses(row);
  }
  return s;
}

std::string to_json(const Summary& summary) {
  Json links = Json::array();
  for (const LinkSummary& s : summary.links)
    links.push_back({{"name", s.name},
                     {"impacts", s.impacts},
                     {"peak_force", s.peak_force},
                     {"peak_penetration", s.peak_penetration},
                     {"impulse", s.impulse},
                     {"energy_lost", s.energy_lost},
                     {"energy_stored", s.energy_stored},
                     {"presses", s.presses},
                     {"largest_opening", s.largest_opening},
                     {"t_opening", s.t_opening},
                     {"seat", s.seat.value_or(none)},
                     {"unseated", s.unseated()}});
  const EnergySummary& e = summary.energy;
  Json all = object_of(14);
  all["status"] = summary.status;
  all["links"] = std::move(links);
  all["impacts"] = impacts_json(summary);
  all["structures"] = structures_json(summary.structures);
  all["energy"] = {{"input", e.input},           {"kinetic", e.kinetic}, {"strain", e.strain}, {"damping", e.damping},
                   {"hysteretic", e.hysteretic}, {"impact", e.impact},   {"error", e.error}};
  all["solver"] = {{"integrator", summary.integrator},
                   {"tolerance", summary.tolerance},
                   {"duration", summary.duration},
                   {"steps", summary.solver.steps},
                   {"rejected", summary.solver.rejected},
                   {"events", summary.solver.events},
                   {"wall_seconds", summary.solver.wall_seconds}};
  if (!summary.options.empty()) all["solver"]["options"] = summary.options;
  if (!summary.reduced.empty()) all["solver"]["reduction"] = reduction_json(summary.reduced);
  if (!summary.devices.empty()) all["devices"] = devices_json(summary.devices);
  if (!summary.devices.empty() || e.devices > 0) all["energy"]["devices"] = e.devices;
  if (Json hinges = hinges_json(summary.structures); !hinges.empty()) all["hinges"] = std::move(hinges);
  if (Json by = hysteretic_json(summary.structures); !by.empty()) all["hysteretic_by"] = std::move(by);
  if (!summary.without_pounding.empty()) {
    Json amplification = Json::object();
    // Peaks of a run that ended early are not comparable.
    const bool both_complete = summary.status == "done" && summary.without_links_status == "done";
    for (std::size_t k = 0; k < summary.structures.size(); ++k) {
      Json ratios = Json::array();
      for (std::size_t i = 0; i < summary.structures[k].peak_displacement.size(); ++i)
        ratios.push_back(both_complete ? summary.structures[k].peak_displacement[i] /
                                             summary.without_pounding[k].peak_displacement[i]
                                       : none);
      amplification[summary.structures[k].name] = ratios;
    }
    Json& part = all["no_pounding"] = object_of(4);
    part["status"] = summary.without_links_status;
    part["structures"] = structures_json(summary.without_pounding);
    part["amplification"] = std::move(amplification);
    part["separations"] = separations_json(summary.separations, summary.without_links_status == "done");
  }
  if (!summary.without_pounding.empty()) all["comparison"] = comparison_json(summary);
  if (!summary.model_json.empty()) all["model"] = Json::parse(summary.model_json);
  all["warnings"] = summary.warnings;
  // Names in a model may not be valid UTF-8, which JSON requires.
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string warning(const Summary& summary, double tolerance) {
  if (!(summary.energy.error > suspicious_imbalance * tolerance)) return {};
  return fmt::format(
      "energies do not balance: the largest imbalance is {:.1e} of the input; reduce the tolerance by a factor of ten "
      "or, if the number of steps does not change, reduce analysis.max_step",
      summary.energy.error);
}

}  // namespace pounding
