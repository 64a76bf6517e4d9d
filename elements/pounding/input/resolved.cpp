#include <pounding/input/resolved.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/model/reducible.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {
namespace {

// Larger damping matrices are described by a note.
constexpr int max_shown_matrix = 20;

// Shortest text that determines the double.
std::string exact(double value) { return fmt::format("{}", value); }

// Text that needs no quotes. The regular expressions with which the emitter checks this dominate its run time.
struct Plain {
  std::string_view text;
};
YAML::Emitter& operator<<(YAML::Emitter& out, const Plain& plain) { return out.WriteIntegralType(plain.text); }

// Writes the key, which needs no quotes, before its value.
YAML::Emitter& field(YAML::Emitter& out, std::string_view key) { return out << YAML::Key << Plain{key} << YAML::Value; }

void emit(YAML::Emitter& out, std::string_view key, double value) { field(out, key) << Plain{exact(value)}; }

void emit_list(YAML::Emitter& out, const std::string& key, const std::vector<double>& values) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double value : values) out << Plain{exact(value)};
  out << YAML::EndSeq;
}

std::vector<double> periods(const Structure& s) {
  std::vector<double> all;
  for (const double w : s.frequencies) all.push_back(2 * M_PI / w);
  return all;
}

// Law, parameters and capacity of each isolator.
void emit_isolators(YAML::Emitter& out, const Structure& s) {
  if (!is_isolated(s)) return;
  field(out, "isolators") << YAML::BeginMap;
  for (const YieldingPart& part : s.yielding) {
    if (!isolates(part)) continue;
    out << YAML::Key << part.name << YAML::Value << YAML::Flow << YAML::BeginMap << YAML::Key << "law" << YAML::Value
        << part.law;
    for (const YieldingPart::Parameter& parameter : part.parameters)
      if (std::isfinite(parameter.value)) emit(out, parameter.name, parameter.value);
    emit(out, "stiffness", part.stiffness());
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
  if (const double period = isolated_period(s); std::isfinite(period)) emit(out, "isolated_period", period);
}

// Springs that act in compression only.
void emit_uplifts(YAML::Emitter& out, const std::vector<YieldingPart>& parts) {
  const auto lifts = [](const YieldingPart& part) { return part.kind == YieldingPart::Kind::support; };
  if (std::ranges::none_of(parts, lifts)) return;
  field(out, "uplift") << YAML::BeginMap;
  for (const YieldingPart& part : parts) {
    if (!lifts(part)) continue;
    out << YAML::Key << part.name << YAML::Value << YAML::Flow << YAML::BeginMap;
    for (const YieldingPart::Parameter& parameter : part.parameters) emit(out, parameter.name, parameter.value);
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
}

// Law, parameters and static moment of each hinge.
void emit_hinges(YAML::Emitter& out, const std::vector<YieldingPart>& parts) {
  const auto is_hinge = [](const YieldingPart& part) { return part.kind == YieldingPart::Kind::hinge; };
  if (std::ranges::none_of(parts, is_hinge)) return;
  field(out, "hinges") << YAML::BeginMap;
  for (const YieldingPart& hinge : parts) {
    if (!is_hinge(hinge)) continue;
    out << YAML::Key << hinge.name << YAML::Value << YAML::Flow << YAML::BeginMap;
    field(out, "law") << hinge.law;
    for (const YieldingPart::Parameter& parameter : hinge.parameters) emit(out, parameter.name, parameter.value);
    if (std::isnan(hinge.parameter("yield_rotation")))  // most laws have no such parameter
      emit(out, "yield_rotation", hinge.yield_deformation());
    if (hinge.at_rest != 0) emit(out, "moment_at_rest", hinge.stiffness() * hinge.at_rest);
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
}

// Frames without their matrices, which are too large.
void emit_frame(YAML::Emitter& out, const Structure& s) {
  field(out, "unknowns") << s.size();
  std::vector<double> masses, elevations;
  for (const Floor& floor : s.floors) {
    masses.push_back(floor.mass);
    elevations.push_back(floor.elevation.value_or(0));
  }
  emit_list(out, "floor_mass", masses);
  emit_list(out, "floor_elevation", elevations);
  double mass = 0;
  for (const Support& support : s.supports) mass += support.load.col(0).sum();
  emit(out, "load_along_x", mass);
  emit_list(out, "periods", periods(s));
  if (s.supports.size() > 1) {
    field(out, "supports") << YAML::Flow << YAML::BeginSeq;
    for (const Support& support : s.supports) out << support.name;
    out << YAML::EndSeq;
  }
  emit_hinges(out, s.yielding);
  emit_isolators(out, s);
}

// Law and parameters of the storeys. A bilinear law uses the keys yield_force and hardening if these are sufficient.
void emit_springs(YAML::Emitter& out, std::span<const YieldingPart> storeys) {
  const YieldingPart& first = storeys.front();
  const bool plain = first.law == "bilinear" && first.parameters.size() == 2;
  if (!plain) field(out, "spring") << YAML::BeginMap << YAML::Key << first.law << YAML::Value << YAML::BeginMap;
  for (std::size_t k = 0; k < first.parameters.size(); ++k) {
    const auto choices = hysteresis::find_law(first.law).choices;
    if (const auto choice = std::ranges::find(choices, first.parameters[k].name, &hysteresis::ChoiceInfo::name);
        choice != choices.end()) {
      out << YAML::Key << first.parameters[k].name << YAML::Value
          << std::string(choice->words[static_cast<std::size_t>(first.parameters[k].value)]);
      continue;
    }
    std::vector<double> values;
    for (const YieldingPart& storey : storeys) values.push_back(storey.parameters[k].value);
    emit_list(out, first.parameters[k].name, values);
  }
  if (!plain) out << YAML::EndMap << YAML::EndMap;
}

void emit_storeys(YAML::Emitter& out, const Structure& s) {
  const Eigen::VectorXd masses = s.mass.diagonal();
  emit_list(out, "mass", {masses.begin(), masses.end()});
  if (!s.storey_stiffness.empty()) {
    emit_list(out, "stiffness", s.storey_stiffness);
    const std::span storeys = std::span(s.yielding).first(s.members_that_yield()).subspan(is_isolated(s) ? 1 : 0);
    if (!storeys.empty()) emit_springs(out, storeys);
    emit_isolators(out, s);
    emit_list(out, "periods", periods(s));
    if (s.size() <= max_shown_matrix) {
      const Eigen::MatrixXd damping = s.whole_damping();
      emit_list(out, "damping_matrix", {damping.data(), damping.data() + damping.size()});
    }
  }
  if (s.floors.front().elevation) {
    std::vector<double> heights;
    double below = 0;
    for (const Floor& floor : s.floors) {
      heights.push_back(*floor.elevation - below);
      below = *floor.elevation;
    }
    emit_list(out, "height", heights);
  }
  emit_list(out, "initial_displacement", {s.initial_displacement.begin(), s.initial_displacement.end()});
  emit_list(out, "initial_velocity", {s.initial_velocity.begin(), s.initial_velocity.end()});
}

// Devices inside a structure.
void emit_devices(YAML::Emitter& out, const Structure& s) {
  if (s.members_that_yield() == s.yielding.size()) return;
  field(out, "devices") << YAML::BeginMap;
  for (const YieldingPart& part : s.yielding) {
    if (!part.is_device()) continue;
    out << YAML::Key << part.name << YAML::Value << YAML::BeginMap << YAML::Key << "device" << YAML::Value
        << part.device;
    for (const YieldingPart::Parameter& parameter : part.parameters) emit(out, parameter.name, parameter.value);
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
}

void emit_structure(YAML::Emitter& out, const Structure& s) {
  out << YAML::Key << s.name << YAML::Value << YAML::BeginMap;
  field(out, "kind") << s.kind;
  if (!s.is_rigid()) {
    if (s.dimension == 1)
      emit_storeys(out, s);
    else
      emit_frame(out, s);
    emit_devices(out, s);
    emit_uplifts(out, s.yielding);
    field(out, "damping") << s.damping_note;
    if (const std::vector<double> ratios = damping_ratios(s); !ratios.empty()) emit_list(out, "damping_ratios", ratios);
    if (s.dimension > 1) {
      emit(out, "damping_by_mass", s.by_mass);
      emit(out, "damping_by_stiffness", s.by_stiffness);
    }
  }
  if (!s.applied_forces.empty()) {
    field(out, "forces") << YAML::BeginSeq;
    for (const AppliedForce& force : s.applied_forces) {
      out << YAML::BeginMap << YAML::Key << "place" << YAML::Value << force.place;
      field(out, "source") << force.history.source();
      emit(out, "peak", force.history.peak());
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  }
  if (s.supports.front().delay > 0) emit(out, "delay", s.supports.front().delay);
  out << YAML::EndMap;
}

void emit_ground(YAML::Emitter& out, const Model& model) {
  const GroundComponents& components = model.ground.components;
  const auto emit_motion = [&](const GroundMotion& motion) {
    field(out, "source") << (motion.is_still() ? "none" : motion.source());
    emit(out, "peak_acceleration", motion.peak());
    emit(out, "duration", motion.duration());
  };
  field(out, "ground_motion") << YAML::BeginMap;
  if (components[1].is_still() && components[2].is_still()) {
    emit_motion(components[0]);
  } else {
    constexpr const char* names[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      if (components[i].is_still()) continue;
      field(out, names[i]) << YAML::BeginMap;
      emit_motion(components[i]);
      out << YAML::EndMap;
    }
  }
  if (model.ground.wave) {
    emit(out, "wave_velocity", model.ground.wave->velocity);
    const Eigen::Vector3d& d = model.ground.wave->direction;
    emit_list(out, "wave_direction", {d.begin(), d.end()});
  }
  out << YAML::EndMap;
}

std::string face_source(const LinkEnd& end) {
  return !end.face_column.empty() ? end.face_column : end.face ? "the input" : "none";
}

void emit_link(YAML::Emitter& out, const Model& model, const Link& link) {
  out << YAML::BeginMap;
  field(out, "name") << link.name;
  field(out, "between") << YAML::Flow << YAML::BeginSeq << end_name(model, link.left) << end_name(model, link.right)
                        << YAML::EndSeq;
  emit(out, "gap", link.gap);
  if (link.left.face || link.right.face) {
    emit_list(out, "face", {link.left.face.value_or(0), link.right.face.value_or(0)});
    if (!link.left.face_column.empty() || !link.right.face_column.empty())
      field(out, "face_from") << YAML::Flow << YAML::BeginSeq << face_source(link.left) << face_source(link.right)
                              << YAML::EndSeq;
  }
  if (link.preload) field(out, "preload") << true;
  if (link.seat) emit(out, "seat", *link.seat);
  field(out, "law") << link.law;
  if (!link.formula.empty()) field(out, "formula") << link.formula;
  emit(out, "reduced_mass", link.reduced_mass);
  field(out, "reduced_mass_from") << (link.reduced_mass_given ? "the input" : "the masses of the two ends");
  if (!link.stiffness_from.empty()) field(out, "stiffness_from") << link.stiffness_from;
  if (link.friction > 0) {
    if (link.tangential_stiffness == 0 && link.tangential_ratio == 0) {
      emit(out, "friction", link.friction);
      emit(out, "sliding_velocity", link.sliding_velocity);
    } else {
      field(out, "friction") << YAML::BeginMap;
      emit(out, "coefficient", link.friction);
      if (link.static_friction > 0) {
        emit(out, "static", link.static_friction);
        emit(out, "stribeck_velocity", link.stribeck_velocity);
      }
      if (link.tangential_stiffness > 0) emit(out, "tangential_stiffness", link.tangential_stiffness);
      if (link.tangential_ratio > 0) emit(out, "tangential_ratio", link.tangential_ratio);
      out << YAML::EndMap;
    }
  }
  field(out, "parameters") << YAML::BeginMap;
  for (const laws::ResolvedValue& value : link.parameters)
    field(out, value.name) << Plain{exact(value.value)} << YAML::Comment(value.unit.empty() ? "-" : value.unit);
  out << YAML::EndMap << YAML::EndMap;
}

void emit_device(YAML::Emitter& out, const Model& model, const Device& device) {
  out << YAML::Key << device.name << YAML::Value << YAML::BeginMap;
  field(out, "between") << YAML::Flow << YAML::BeginSeq << end_name(model, device.left) << end_name(model, device.right)
                        << YAML::EndSeq;
  emit_list(out, "direction", {device.direction.begin(), device.direction.end()});
  if (device.length) emit(out, "length", *device.length);
  if (device.parts.bar) {
    field(out, "bar") << YAML::BeginMap;
    emit(out, "stiffness", device.parts.bar->stiffness);
    out << YAML::EndMap;
  }
  if (const auto& law = device.parts.law) {
    out << YAML::Key << law->law << YAML::Value << YAML::BeginMap;
    for (const auto& [name, value] : law->values) emit(out, name, value);
    for (const auto& [name, spec] : law->words) out << YAML::Key << name << YAML::Value << spec;
    out << YAML::EndMap;
  }
  if (const auto& damper = device.parts.damper) {
    field(out, "damper") << YAML::BeginMap;
    emit(out, "coefficient", damper->coefficient);
    emit(out, "exponent", damper->exponent);
    if (damper->has_stiffness())
      emit(out, "stiffness", damper->stiffness);
    else if (!damper->is_linear())
      emit(out, "rounding_velocity", damper->rounding_velocity);
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
}

}  // namespace

std::string resolved_yaml(const Model& model) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  field(out, "title") << model.title;
  if (!model.project.empty()) field(out, "project") << model.project;
  field(out, "units") << "SI";
  emit_ground(out, model);
  field(out, "structures") << YAML::BeginMap;
  for (const Structure& s : model.structures) emit_structure(out, s);
  out << YAML::EndMap;
  field(out, "links") << YAML::BeginSeq;
  for (const Link& link : model.links) emit_link(out, model, link);
  out << YAML::EndSeq;
  if (!model.devices.empty()) {
    field(out, "devices") << YAML::BeginMap;
    for (const Device& device : model.devices) emit_device(out, model, device);
    out << YAML::EndMap;
  }
  field(out, "analysis") << YAML::BeginMap;
  emit(out, "duration", model.analysis.duration);
  emit(out, "tolerance", model.analysis.tolerance);
  emit(out, "output_step", model.analysis.output_step);
  field(out, "integrator") << std::string(model.analysis.scheme.name());
  if (model.analysis.scheme.kind == Scheme::Kind::generalized_alpha)
    emit(out, "spectral_radius", model.analysis.scheme.spectral_radius);
  if (model.analysis.max_step > 0) emit(out, "max_step", model.analysis.max_step);
  field(out, "most_steps") << model.analysis.max_steps;
  if (model.analysis.reduction.kind != Reduction::Kind::none || !model.analysis.reductions.empty()) {
    field(out, "reduction") << YAML::BeginMap;
    for (std::size_t i = 0; i < model.structures.size(); ++i)
      if (!model.structures[i].is_rigid())
        out << YAML::Key << model.structures[i].name << YAML::Value << reduction_of(model, static_cast<int>(i)).text();
    out << YAML::EndMap;
  }
  if (model.analysis.collapse_drift > 0) emit(out, "collapse_drift", model.analysis.collapse_drift);
  out << YAML::EndMap;
  if (model.checkpoint.requested()) {
    field(out, "checkpoint") << YAML::BeginMap;
    if (model.checkpoint.every > 0) emit(out, "every", model.checkpoint.every);
    if (model.checkpoint.every_simulated > 0) emit(out, "every_simulated", model.checkpoint.every_simulated);
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace pounding
