#include <pounding/input/resolved.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>
#include <nlohmann/json.hpp>

#include <pounding/hysteresis/all.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/model/reducible.hpp>
#include <pounding/reports/assumptions.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {
namespace {

using Resolved = nlohmann::ordered_json;

// Larger damping matrices are described by a note.
constexpr int max_shown_matrix = 20;

// Text that needs no quotes. The regular expressions with which the emitter checks this dominate its run time.
struct Plain {
  std::string_view text;
};

YAML::Emitter& operator<<(YAML::Emitter& out, const Plain& plain) { return out.WriteIntegralType(plain.text); }

void write(YAML::Emitter& out, const std::string& text) {
  const bool is_plain = !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos;
  if (is_plain && text != "null")
    out << Plain{text};
  else
    out << text;
}

// Lists of single values take one line. Numbers have the shortest text that determines them.
void write(YAML::Emitter& out, const Resolved& value) {
  if (value.is_object()) {
    out << YAML::BeginMap;
    for (const auto& [key, each] : value.items()) {
      out << YAML::Key;
      write(out, key);
      out << YAML::Value;
      write(out, each);
    }
    out << YAML::EndMap;
  } else if (value.is_array()) {
    if (std::ranges::all_of(value, [](const Resolved& each) { return each.is_primitive(); })) out << YAML::Flow;
    out << YAML::BeginSeq;
    for (const Resolved& each : value) write(out, each);
    out << YAML::EndSeq;
  } else if (value.is_string()) {
    write(out, value.get_ref<const std::string&>());
  } else if (value.is_number_float()) {
    out << Plain{fmt::format("{}", value.get<double>())};
  } else {
    out << Plain{value.dump()};
  }
}

// Adds an entry with a new name. The operator [] would search all other names.
void add(Resolved& map, const std::string& name, Resolved value) {
  if (map.is_null()) map = Resolved::object();
  map.get_ref<Resolved::object_t&>().emplace_back(name, std::move(value));
}

std::vector<double> values_of(const auto& values) { return {values.begin(), values.end()}; }

std::vector<double> periods(const Structure& s) {
  std::vector<double> all;
  for (const double w : s.frequencies) all.push_back(2 * M_PI / w);
  return all;
}

// Law, parameters and stiffness of a part.
Resolved resolved(const YieldingPart& part, bool in_space) {
  Resolved one{{"law", part.law}};
  for (const auto& [name, value] : part.parameters)
    if (std::isfinite(value)) one[name] = value;
  if (part.is_device()) one["device"] = part.device;
  if (isolates(part)) {
    if (in_space) one["coupled"] = !part.has_spring();
    one["stiffness"] = part.stiffness();
  }
  if (part.kind != YieldingPart::Kind::hinge) return one;
  // Most laws have no parameter of this name.
  if (!one.contains("yield_rotation")) one["yield_rotation"] = part.yield_deformation();
  if (part.at_rest != 0) one["moment_at_rest"] = part.stiffness() * part.at_rest;
  return one;
}

// Adds hinges, isolators, devices and springs that lift off, by name. Storeys are values by storey.
void add_parts(Resolved& to, const Structure& s) {
  constexpr const char* groups[] = {nullptr, "hinges", "isolators", "devices", "uplift"};
  for (const YieldingPart& part : s.yielding)
    if (const char* const group = groups[static_cast<int>(part.kind)])
      add(to[group], part.name, resolved(part, s.dimension == 3));
  if (!is_isolated(s)) return;
  if (const double period = isolated_period(s); std::isfinite(period)) to["isolated_period"] = period;
}

// Sections of fibres by name, with the initial moduli of their materials and the values of confined concrete.
void add_fibre_sections(Resolved& to, const Structure& s) {
  for (const FibreSectionReport& section : s.fibre_sections) {
    Resolved laws = Resolved::object();
    for (const FibreSectionReport::Law& law : section.laws) {
      Resolved one{{"law", law.law}, {"modulus", law.modulus}};
      for (const YieldingPart::Parameter& value : law.confinement) one[value.name] = value.value;
      add(laws, law.name, std::move(one));
    }
    add(to["fibre_sections"], section.name,
        {{"area", section.area}, {"bending_stiffness", section.bending_stiffness}, {"materials", std::move(laws)}});
  }
}

// Adds properties of a frame without its matrices, which are too large.
void add_frame(Resolved& to, const Structure& s) {
  std::vector<double> masses, elevations;
  for (const Floor& floor : s.floors) {
    masses.push_back(floor.mass);
    elevations.push_back(floor.elevation.value_or(0));
  }
  std::vector<std::string> supports;
  double mass = 0;
  for (const Support& support : s.supports) {
    supports.push_back(support.name);
    mass += support.load.col(0).sum();
  }
  to.update({{"unknowns", s.size()},
             {"floor_mass", masses},
             {"floor_elevation", elevations},
             {"load_along_x", mass},
             {"periods", periods(s)}});
  add_fibre_sections(to, s);
  if (supports.size() > 1) to["supports"] = supports;
}

// Law and parameters of the storeys. A bilinear law uses the keys yield_force and hardening if these are sufficient.
void add_storey_springs(Resolved& to, std::span<const YieldingPart> storeys) {
  const YieldingPart& first = storeys.front();
  const bool is_plain = first.law == "bilinear" && first.parameters.size() == 2;
  Resolved& law = is_plain ? to : to["spring"][first.law];
  const auto choices = hysteresis::find_law(first.law).choices;
  for (std::size_t k = 0; k < first.parameters.size(); ++k) {
    const auto& [name, value] = first.parameters[k];
    const auto choice = std::ranges::find(choices, name, &hysteresis::ChoiceInfo::name);
    if (choice != choices.end())
      law[name] = choice->words[static_cast<std::size_t>(value)];
    else
      for (const YieldingPart& storey : storeys) law[name].push_back(storey.parameters[k].value);
  }
}

void add_storeys(Resolved& to, const Structure& s) {
  to["mass"] = values_of(Eigen::VectorXd(s.mass.diagonal()));
  if (!s.storey_stiffness.empty()) {
    to["stiffness"] = s.storey_stiffness;
    const std::span storeys = std::span(s.yielding).first(s.members_that_yield()).subspan(is_isolated(s) ? 1 : 0);
    if (!storeys.empty()) add_storey_springs(to, storeys);
    to["periods"] = periods(s);
    if (s.size() <= max_shown_matrix) to["damping_matrix"] = values_of(Eigen::MatrixXd(s.whole_damping()).reshaped());
  }
  double below = 0;
  for (const Floor& floor : s.floors) {
    if (!floor.elevation) break;
    to["height"].push_back(*floor.elevation - below);
    below = *floor.elevation;
  }
  to["initial_displacement"] = values_of(s.initial_displacement);
  to["initial_velocity"] = values_of(s.initial_velocity);
}

Resolved resolved(const Structure& s) {
  Resolved one{{"kind", s.kind}};
  if (!s.is_rigid()) {
    s.dimension == 1 ? add_storeys(one, s) : add_frame(one, s);
    add_parts(one, s);
    one["damping"] = s.damping_note;
    if (const std::vector<double> ratios = damping_ratios(s); !ratios.empty()) one["damping_ratios"] = ratios;
    if (s.dimension > 1) one.update({{"damping_by_mass", s.by_mass}, {"damping_by_stiffness", s.by_stiffness}});
  }
  for (const AppliedForce& force : s.applied_forces)
    one["forces"].push_back(
        {{"place", force.place}, {"source", force.history.source()}, {"peak", force.history.peak()}});
  if (s.supports.front().delay > 0) one["delay"] = s.supports.front().delay;
  return one;
}

Resolved resolved(const GroundSection& ground) {
  const GroundComponents& components = ground.components;
  const auto facts = [](const GroundMotion& motion) -> Resolved {
    return {{"source", motion.is_still() ? "none" : motion.source()},
            {"peak_acceleration", motion.peak()},
            {"duration", motion.duration()}};
  };
  Resolved all;
  if (components[1].is_still() && components[2].is_still())
    all = facts(components[0]);
  else
    for (int i = 0; i < 3; ++i)
      if (!components[i].is_still()) all[std::string(1, "xyz"[i])] = facts(components[i]);
  if (ground.wave)
    all.update({{"wave_velocity", ground.wave->velocity}, {"wave_direction", values_of(ground.wave->direction)}});
  return all;
}

std::string face_source(const LinkEnd& end) {
  return !end.face_column.empty() ? end.face_column : end.face ? "the input" : "none";
}

// Constant friction, or that of a contact that sticks.
void add_friction(Resolved& to, const Link& link) {
  if (link.tangential_stiffness == 0 && link.tangential_ratio == 0) {
    to.update({{"friction", link.friction}, {"sliding_velocity", link.sliding_velocity}});
    return;
  }
  Resolved& friction = to["friction"] = {{"coefficient", link.friction}};
  if (link.static_friction > 0)
    friction.update({{"static", link.static_friction}, {"stribeck_velocity", link.stribeck_velocity}});
  if (link.tangential_stiffness > 0) friction["tangential_stiffness"] = link.tangential_stiffness;
  if (link.tangential_ratio > 0) friction["tangential_ratio"] = link.tangential_ratio;
}

Resolved resolved(const Model& model, const Link& link) {
  Resolved one = link_json(model, link);
  if (link.left.face || link.right.face) one["face"] = {link.left.face.value_or(0), link.right.face.value_or(0)};
  if (!link.left.face_column.empty() || !link.right.face_column.empty())
    one["face_from"] = {face_source(link.left), face_source(link.right)};
  if (link.seat) one["seat"] = *link.seat;
  if (!link.formula.empty()) one["formula"] = link.formula;
  if (link.friction > 0) add_friction(one, link);
  return one;
}

Resolved resolved(const Model& model, const Device& device) {
  Resolved one{{"between", {end_name(model, device.left), end_name(model, device.right)}},
               {"direction", values_of(device.direction)}};
  if (device.length) one["length"] = *device.length;
  if (device.parts.bar) one["bar"] = {{"stiffness", device.parts.bar->stiffness}};
  if (const auto& law = device.parts.law) {
    one[law->law] = Resolved::object();
    for (const auto& [name, value] : law->values) one[law->law][name] = value;
    for (const auto& [name, word] : law->words) one[law->law][name] = word;
  }
  if (const auto& damper = device.parts.damper) {
    one["damper"] = {{"coefficient", damper->coefficient}, {"exponent", damper->exponent}};
    if (damper->has_stiffness())
      one["damper"]["stiffness"] = damper->stiffness;
    else if (!damper->is_linear())
      one["damper"]["rounding_velocity"] = damper->rounding_velocity;
  }
  return one;
}

Resolved resolved_analysis(const Model& model) {
  const AnalysisSettings& analysis = model.analysis;
  Resolved one{{"duration", analysis.duration},
               {"tolerance", analysis.tolerance},
               {"output_step", analysis.output_step},
               {"integrator", analysis.scheme.name()}};
  if (analysis.scheme.kind == Scheme::Kind::generalized_alpha) one["spectral_radius"] = analysis.scheme.spectral_radius;
  if (analysis.max_step > 0) one["max_step"] = analysis.max_step;
  one["most_steps"] = analysis.max_steps;
  if (analysis.reduction.kind != Reduction::Kind::none || !analysis.reductions.empty())
    for (std::size_t i = 0; i < model.structures.size(); ++i)
      if (const Structure& s = model.structures[i]; !s.is_rigid())
        add(one["reduction"], s.name, reduction_of(model, static_cast<int>(i)).text());
  if (analysis.collapse_drift > 0) one["collapse_drift"] = analysis.collapse_drift;
  return one;
}

}  // namespace

std::string resolved_yaml(const Model& model) {
  Resolved all{{"title", model.title}};
  if (!model.project.empty()) all["project"] = model.project;
  all["units"] = "SI";
  all["ground_motion"] = resolved(model.ground);
  for (const Structure& s : model.structures) add(all["structures"], s.name, resolved(s));
  all["links"] = Resolved::array();
  for (const Link& link : model.links) all["links"].push_back(resolved(model, link));
  for (const Device& device : model.devices) add(all["devices"], device.name, resolved(model, device));
  all["analysis"] = resolved_analysis(model);
  if (model.checkpoint.every > 0) all["checkpoint"]["every"] = model.checkpoint.every;
  if (model.checkpoint.every_simulated > 0) all["checkpoint"]["every_simulated"] = model.checkpoint.every_simulated;
  YAML::Emitter out;
  write(out, all);
  return std::string(out.c_str()) + "\n";
}

}  // namespace pounding
