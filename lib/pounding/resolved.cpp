#include <cmath>
#include <yaml-cpp/yaml.h>

#include <fmt/format.h>

#include <pounding/damping.hpp>
#include <pounding/model.hpp>

namespace pounding {
namespace {

// Larger damping matrices are told by their note.
constexpr int largest_shown_matrix = 20;

// Every digit that a double needs, and no more.
std::string exact(double value) { return fmt::format("{}", value); }

void emit(YAML::Emitter& out, const char* key, double value) { out << YAML::Key << key << YAML::Value << exact(value); }

void emit_list(YAML::Emitter& out, const char* key, const std::vector<double>& values) {
  out << YAML::Key << key << YAML::Value << YAML::Flow << YAML::BeginSeq;
  for (const double value : values) out << exact(value);
  out << YAML::EndSeq;
}

void emit_structure(YAML::Emitter& out, const Structure& s) {
  out << YAML::Key << s.name << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "kind" << YAML::Value << s.kind;
  if (!s.is_rigid()) {
    const Eigen::VectorXd masses = s.mass.diagonal();
    emit_list(out, "mass", {masses.begin(), masses.end()});
    if (!s.storey_stiffness.empty()) {
      emit_list(out, "stiffness", s.storey_stiffness);
      if (!s.yielding.empty()) {
        std::vector<double> forces, hardening;
        for (const YieldingStorey& storey : s.yielding) {
          forces.push_back(storey.yield_force);
          hardening.push_back(storey.hardening);
        }
        emit_list(out, "yield_force", forces);
        emit_list(out, "hardening", hardening);
      }
      const Eigen::VectorXd w = eigenmodes(s.mass, s.stiffness).frequencies;
      std::vector<double> periods;
      for (const double each : w) periods.push_back(2 * M_PI / each);
      emit_list(out, "periods", periods);
      std::vector<double> matrix(s.damping.data(), s.damping.data() + s.damping.size());
      if (s.size() <= largest_shown_matrix) emit_list(out, "damping_matrix", matrix);
    }
    if (!s.heights.empty()) emit_list(out, "height", s.heights);
    emit_list(out, "initial_displacement", {s.initial_displacement.begin(), s.initial_displacement.end()});
    emit_list(out, "initial_velocity", {s.initial_velocity.begin(), s.initial_velocity.end()});
    out << YAML::Key << "damping" << YAML::Value << s.damping_note;
  }
  out << YAML::EndMap;
}

std::string end_of(const Model& model, int structure, int floor) {
  const Structure& s = model.structures[structure];
  return floor < 0 ? s.name : fmt::format("{}.{}", s.name, floor + 1);
}

void emit_link(YAML::Emitter& out, const Model& model, const Link& link) {
  out << YAML::BeginMap;
  out << YAML::Key << "name" << YAML::Value << link.name;
  out << YAML::Key << "between" << YAML::Value << YAML::Flow << YAML::BeginSeq
      << end_of(model, link.left, link.left_floor) << end_of(model, link.right, link.right_floor) << YAML::EndSeq;
  emit(out, "gap", link.gap);
  out << YAML::Key << "law" << YAML::Value << link.law;
  if (!link.formula.empty()) out << YAML::Key << "formula" << YAML::Value << link.formula;
  emit(out, "reduced_mass", link.reduced_mass);
  out << YAML::Key << "reduced_mass_from" << YAML::Value
      << (link.reduced_mass_given ? "the input" : "the masses of the two floors");
  out << YAML::Key << "parameters" << YAML::Value << YAML::BeginMap;
  for (const Value& value : link.parameters)
    out << YAML::Key << value.name << YAML::Value << exact(value.value)
        << YAML::Comment(value.unit.empty() ? "-" : value.unit);
  out << YAML::EndMap << YAML::EndMap;
}

}  // namespace

std::string resolved_yaml(const Model& model) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  out << YAML::Key << "title" << YAML::Value << model.title;
  out << YAML::Key << "units" << YAML::Value << "SI";
  out << YAML::Key << "ground_motion" << YAML::Value << YAML::BeginMap;
  out << YAML::Key << "source" << YAML::Value << (model.ground.is_still() ? "none" : model.ground.source());
  emit(out, "peak_acceleration", model.ground.peak());
  emit(out, "duration", model.ground.duration());
  out << YAML::EndMap;
  out << YAML::Key << "structures" << YAML::Value << YAML::BeginMap;
  for (const Structure& s : model.structures) emit_structure(out, s);
  out << YAML::EndMap;
  out << YAML::Key << "links" << YAML::Value << YAML::BeginSeq;
  for (const Link& link : model.links) emit_link(out, model, link);
  out << YAML::EndSeq;
  out << YAML::Key << "analysis" << YAML::Value << YAML::BeginMap;
  emit(out, "duration", model.analysis.duration);
  emit(out, "tolerance", model.analysis.tolerance);
  emit(out, "output_step", model.analysis.output_step);
  out << YAML::Key << "integrator" << YAML::Value << std::string(model.analysis.scheme.name());
  if (model.analysis.scheme.kind == Scheme::Kind::generalized_alpha)
    emit(out, "spectral_radius", model.analysis.scheme.spectral_radius);
  if (model.analysis.max_step > 0) emit(out, "max_step", model.analysis.max_step);
  out << YAML::EndMap;
  if (model.checkpoint.asked()) {
    out << YAML::Key << "checkpoint" << YAML::Value << YAML::BeginMap;
    if (model.checkpoint.every > 0) emit(out, "every", model.checkpoint.every);
    if (model.checkpoint.every_simulated > 0) emit(out, "every_simulated", model.checkpoint.every_simulated);
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

}  // namespace pounding
