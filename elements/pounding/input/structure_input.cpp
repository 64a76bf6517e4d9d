#include <pounding/input/structure_input.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/input/damping_input.hpp>
#include <pounding/input/device_input.hpp>
#include <pounding/input/face_input.hpp>
#include <pounding/input/fail_at.hpp>
#include <pounding/input/force_input.hpp>
#include <pounding/input/frames/frame_input.hpp>
#include <pounding/input/ground_input.hpp>
#include <pounding/input/isolator_input.hpp>
#include <pounding/input/spring_input.hpp>
#include <pounding/structures/oscillators.hpp>

namespace pounding {
namespace {

Structure read_body(const Input& body) {
  body.only_keys();
  return make_body({.mass = body.quantity("mass"), .gravity = body.quantity("gravity")});
}

void read_yielding(const Input& body, Structure& s) {
  const std::optional<Input> force = body.find("yield_force"), hardening = body.find("hardening");
  if (const auto spring = body.find("spring")) {
    for (const auto& beside : {force, hardening})
      if (beside) beside->fail_at_key("belongs to a bilinear storey, and spring is also given; keep one of the two");
    const std::vector<double> stiffness = stiffness_of_storeys(s);
    return let_storeys_yield(s,
                             read_storey_spring(*spring, stiffness, s.size() - static_cast<int>(stiffness.size()) + 1));
  }
  if (hardening && !force)
    hardening->fail_at_key("belongs to storeys that yield; add yield_force: 2 MN, or leave it out");
  if (!force) return;
  const int storeys = static_cast<int>(stiffness_of_storeys(s).size());
  const auto forces = force->as_quantities(storeys);
  const auto ratios = hardening ? hardening->as_quantities(storeys) : std::vector<double>(storeys, 0.0);
  let_storeys_yield(s, forces, ratios);
}

// Damping is read in common for all kinds.
Structure read_oscillator(const Input& body) {
  body.only_keys();
  OscillatorOptions options{.mass = body.quantity("mass")};
  const std::string given = body.chosen();
  (given == "period" ? options.period : options.stiffness) = body.quantity(given);
  if (const double k = options.period ? stiffness_of_period(options.mass, *options.period) : 1;
      !(std::isfinite(k) && k > 0))
    body.at("period").fail(fmt::format("is so {} that the stiffness m (2 pi/T)^2 is {}", k > 0 ? "short" : "long",
                                       k > 0 ? "no number" : "zero"));
  Structure s = make_oscillator(options);
  read_yielding(body, s);
  return s;
}

IsolatorOptions read_building_isolator(const Input& isolator) {
  IsolatorOptions options = read_isolator_law(isolator);
  if (const auto coupled = isolator.find("coupled"))
    coupled->fail_at_key("is for frames in space; a shear building moves along x only. Leave it out");
  return options;
}

// Stiffness of the storeys, or of those above the isolators.
std::vector<double> read_stiffness(const Input& node, int storeys, bool is_isolated) {
  if (is_isolated && node.is_list() && static_cast<int>(node.items().size()) != storeys)
    node.fail(
        fmt::format("takes one value, or a list of {} for the storeys above the isolators, whose stiffness follows "
                    "from their law; a list of {} was read",
                    storeys, node.items().size()));
  return node.as_quantities(storeys);
}

Structure read_shear_building(const Input& body) {
  body.only_keys();
  ShearBuildingOptions options{.storeys = static_cast<int>(body.at("storeys").as_integer())};
  const int storeys = options.storeys;
  options.mass = body.at("mass").as_quantities(storeys);
  if (const auto isolator = body.find("isolator")) options.isolator = read_building_isolator(*isolator);
  if (const int above = storeys - (options.isolator ? 1 : 0); above > 0) {
    options.stiffness = read_stiffness(body.at("stiffness"), above, options.isolator.has_value());
  } else if (const auto idle = body.find("stiffness")) {
    idle->fail_at_key("applies to storeys above the isolators, and there are none; type storeys: 2, or leave it out");
  }
  if (const auto height = body.find("height")) options.height = height->as_quantities(storeys);
  Structure s = make_shear_building(options);
  read_yielding(body, s);
  return s;
}

Structure read_wall(const Input& body) {
  constexpr std::string_view bare = "a wall has no parameters; type wall: {}";
  if (body.is_map())
    for (const auto& [key, value] : body.entries()) value.fail_at_key(bare);
  if (body.is_list() || (body.is_scalar() && !body.as_text().empty())) body.fail(bare);
  return make_wall();
}

struct Kind {
  std::string_view key;
  Structure (*read)(const Input& body);
};

// Kinds of structures. Each kind also has a key and a section in keys/structures.cpp.
constexpr Kind structure_kinds[] = {{"body", read_body},
                                    {"oscillator", read_oscillator},
                                    {"shear_building", read_shear_building},
                                    {"frame", read_frame_structure},
                                    {"wall", read_wall}};

const Kind& kind_of(const Input& location) {
  if (location.is_scalar() && location.as_text() == "wall") location.fail("a wall is written as {wall: {}}");
  location.only_keys();
  return *std::ranges::find(structure_kinds, location.chosen(), &Kind::key);
}

// A key is allowed inside the kind or at the level of the structure, but not at both.
std::optional<Input> beside_or_inside(const Input& location, const Input& body, std::string_view key) {
  const std::optional<Input> inside = body.is_map() ? body.find_known(key) : std::nullopt;
  const std::optional<Input> beside = location.find(key);
  if (inside && beside) beside->fail_at_key(fmt::format("\"{}\" is given twice; keep one of the two", key));
  return inside ? inside : beside;
}

// One value per floor, but one value for a frame. The model rejects values for walls and frames without floors.
OneOrEach read_velocity(const Input& node, const Structure& s) {
  if (s.dimension > 1) return node.as_quantity();
  return node.as_quantities(s.size());
}

OneOrEach read_displacement(const Input& node, const Structure& s) {
  if (s.floors.empty()) return node.as_quantity();
  return node.as_quantities(static_cast<int>(s.floors.size()));
}

std::vector<NodeDisplacement> read_node_displacements(const Input& nodes) {
  std::vector<NodeDisplacement> all;
  for (const auto& [name, node] : nodes.entries()) {
    if (!node.is_map()) node.fail("takes a map of degrees of freedom; type {ux: 5 mm}");
    node.only_keys();
    for (const auto& [dof, value] : node.entries()) all.push_back({name, dof, value.as_quantity()});
  }
  return all;
}

// Reads one structure and reports errors of the model at their location in the input.
class StructureInput {
 public:
  StructureInput(const std::string& name, const Input& location) : name_(name), location_(location) {}

  void read(Model& model) {
    try {
      require_structure_name(name_);
    } catch (const ModelError& error) {
      location_.fail_at_key(error.what());
    }
    const Kind& kind = kind_of(location_);
    body_.emplace(*location_.find(kind.key));
    Structure s = placed(*body_, [&] { return kind.read(*body_); });
    StructureOptions options;
    damping_ = beside_or_inside(location_, *body_, "damping");
    velocity_ = beside_or_inside(location_, *body_, "initial_velocity");
    displacement_ = beside_or_inside(location_, *body_, "initial_displacement");
    face_ = beside_or_inside(location_, *body_, "face");
    const std::optional<Input> delay = location_.find("delay"), motion = location_.find("ground_motion");
    const bool is_damped = !s.is_rigid() && !s.is_free;
    if (damping_) options.damping = is_damped ? read_damping(*damping_, s) : Damping(0);
    if (velocity_) options.initial_velocity = read_velocity(*velocity_, s);
    if (displacement_) options.initial_displacement = read_displacement(*displacement_, s);
    if (kind.key == "frame") node_displacements_ = body_->find("initial_node_displacements");
    if (node_displacements_) options.initial_node_displacements = read_node_displacements(*node_displacements_);
    if (motion) {
      GroundSection ground = read_ground_section(*motion);
      if (ground.wave)
        motion->fail("a wave is allowed only in the ground_motion of the model; give this structure a delay");
      options.ground_motion = std::move(ground.components);
    }
    if (delay) options.delay = delay->as_quantity();
    if (face_) options.face = read_face(*face_);
    if (const auto forces = location_.find("forces")) options.forces = read_forces(*forces);
    const StructureHandle handle = [&] {
      try {
        return model.add(name_, std::move(s), options);
      } catch (const ModelError& error) {
        fail(error);
      }
    }();
    if (const auto devices = body_->is_map() ? body_->find_known("devices") : std::nullopt)
      for (const auto& [device, node] : devices->entries()) read_own_device(device, node, handle, model);
  }

 private:
  [[noreturn]] void fail(const ModelError& error) const {
    const Input* at = &*body_;
    switch (error.option()) {
      case ModelOption::damping:
        if (error.is_idle()) damping_->fail_at_key(error.what());
        // These errors are detected by the model: too many modes for modal damping, and errors of the eigenvalue
        // solver.
        if (damping_->is_map() && damping_->has("modal")) damping_->at("modal").fail_at_key(error.what());
        if (damping_) at = &*damping_;
        break;
      case ModelOption::forces:
        location_.at("forces").items()[static_cast<std::size_t>(error.item())].fail(error.what());
      case ModelOption::initial_velocity: at = &*velocity_; break;
      case ModelOption::initial_displacement: at = &*displacement_; break;
      case ModelOption::face: at = &*face_; break;
      case ModelOption::initial_node_displacements: at = &*node_displacements_; break;
      default: break;
    }
    fail_at(*at, error);
  }

  const std::string& name_;
  const Input& location_;
  std::optional<Input> body_, damping_, velocity_, displacement_, face_, node_displacements_;
};

}  // namespace

void read_structure(const std::string& name, const Input& location, Model& model) {
  StructureInput(name, location).read(model);
}

}  // namespace pounding
