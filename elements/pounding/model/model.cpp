#include <pounding/model/model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/text.hpp>
#include <pounding/core/units.hpp>
#include <pounding/model/arrivals.hpp>
#include <pounding/model/cost.hpp>
#include <pounding/model/first_yield.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/place_ends.hpp>
#include <pounding/model/reducible.hpp>
#include <pounding/model/refuse_option.hpp>
#include <pounding/model/start/start.hpp>
#include <pounding/model/warning_names.hpp>
#include <pounding/structures/storey_heights.hpp>

namespace pounding {
namespace {

// Supports with arrivals within this distance have the same motion [m].
constexpr double together = 1e-6;

void require_free_name(const std::string& name, const std::vector<Structure>& others) {
  for (const Structure& other : others)
    if (other.name == name)
      throw ModelError(ModelOption::name,
                       fmt::format("a structure \"{}\" exists already; give this one another name", name));
}

void damp(Structure& s, const std::optional<Damping>& damping, const ModeSolver& modes) {
  const bool is_damped = !s.damping_note.empty();
  if (s.is_rigid() || s.is_free) {
    if (damping) refuse_idle(ModelOption::damping, fmt::format("a {} has no damping; remove it", s.kind));
    return;
  }
  if (!damping && !is_damped)
    refuse(ModelOption::structure, "damping is missing; type damping: 5 %, or damping: 0 for none");
  if (damping && is_damped)
    refuse(ModelOption::damping, "the structure was created with its damping; keep one of the two");
  if (s.frequencies.size() == 0) checked(ModelOption::structure, [&] { set_frequencies(s, modes); });
  if (damping) checked(ModelOption::damping, [&] { set_damping(s, *damping, modes); });
}

// With large rotations, K is not the stiffness of the displaced structure.
void refuse_initial_yield(const Structure& s) {
  if (!s.elastic) return;
  for (const YieldingPart& part : s.yielding) {
    const double strained = part.at_rest + part.deformation.dot(s.initial_displacement);
    if (const auto yield = yields_before(part, strained))
      throw ModelError(ModelOption::initial_displacement,
                       fmt::format("deforms {} by {}, but it yields at {}; give less, or an initial_velocity",
                                   part.name, deformation_text(s, part, strained), deformation_text(s, part, *yield)));
  }
}

// Floors of a structure along x are its unknowns. A frame has one initial velocity along x including its supports, and
// initial displacements of its floors.
Eigen::VectorXd initial_motion(const OneOrEach& given, const Structure& s, ModelOption option, const char* what) {
  if (given.empty()) return Eigen::VectorXd::Zero(s.size());
  if (s.is_rigid()) refuse_idle(option, "a wall moves with the ground; remove it");
  if (s.dimension > 1 && option == ModelOption::initial_displacement)
    return shape_of_floors(s, given.of_each(static_cast<int>(s.floors.size()), what));
  if (s.dimension > 1) {
    Eigen::VectorXd whole = Eigen::VectorXd::Zero(s.size());
    for (const Support& support : s.supports) whole += support.influence.col(0);
    return given.of_each(1, what).front() * whole;
  }
  const std::vector<double> values = given.of_each(s.size(), what);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), s.size());
}

void apply_forces(Structure& s, const std::vector<ForceOptions>& forces) {
  for (std::size_t i = 0; i < forces.size(); ++i) {
    try {
      s.applied_forces.push_back(applied_force(s, forces[i]));
    } catch (const std::invalid_argument& error) {
      throw ModelError(ModelOption::forces, error.what()).of(static_cast<int>(i));
    }
  }
}

void set_initial_motion(Structure& s, const StructureOptions& options) {
  const auto read = [&](const OneOrEach& given, ModelOption option, const char* what) {
    return checked(option, [&] { return initial_motion(given, s, option, what); });
  };
  s.initial_velocity = read(options.initial_velocity, ModelOption::initial_velocity, "initial_velocity");
  s.initial_displacement =
      read(options.initial_displacement, ModelOption::initial_displacement, "initial_displacement");
  if (!options.initial_node_displacements.empty()) {
    constexpr auto option = ModelOption::initial_node_displacements;
    if (!options.initial_displacement.empty())
      refuse_idle(option, "initial_displacement is given too; keep one of the two");
    s.initial_displacement = checked(option, [&] { return shape_of_nodes(s, options.initial_node_displacements); });
  }
  refuse_initial_yield(s);
}

void take_face(Structure& s, const std::optional<Face>& face) {
  if (!face) return;
  if (!s.surface->plan())
    refuse_idle(
        ModelOption::face,
        fmt::format("face applies only to drawn frames; gaps to this {} are given from face to face: remove face",
                    s.kind));
  require_face(*face, ModelOption::face);
  s.face = face;
}

bool is_still(const GroundComponents& ground) {
  return std::all_of(ground.begin(), ground.end(), [](const GroundMotion& motion) { return motion.is_still(); });
}

// Rejects components that structures of at most this dimension ignore.
void refuse_idle_components(const GroundComponents& ground, int dimension, int structure) {
  const auto refuse = [&](int axis, const std::string& text) {
    throw ModelError(ModelOption::ground_component, structure, text).along(axis).as_idle();
  };
  const bool of_one = structure >= 0;
  if (!ground[1].is_still() && dimension < 3)
    refuse(1,
           fmt::format("{} in space; remove the motion along y", of_one ? "the structure is not" : "no structure is"));
  if (!ground[2].is_still() && dimension < 2)
    refuse(2, fmt::format("{} up and down; remove the motion along z",
                          of_one ? "the structure does not move" : "no structure moves"));
}

// The elongation of a device depends only on the unknowns.
void require_devices_on_one_ground(const Model& model) {
  for (const Structure& s : model.structures)
    if (s.supports.size() > 1)
      for (const YieldingPart& part : s.yielding)
        if (part.is_device())
          throw ModelError(ModelOption::structures,
                           fmt::format("{} has a device, {}, but its supports move differently; remove their delay and "
                                       "ground_motion, the wave, or the device",
                                       s.name, part.name));
}

// Reduced structures, and large ones with all their modes, need no matrix of their modal damping.
void form_modal_damping(Model& model) {
  for (std::size_t i = 0; i < model.structures.size(); ++i) {
    Structure& s = model.structures[i];
    const Reduction how = reduction_of(model, static_cast<int>(i));
    const bool is_small = count_of_modes(s) <= small_structure;
    if (s.modal_ratio == 0 || how.is_explicit() || (how.kind != Reduction::Kind::none && !is_small)) continue;
    try {
      s.modal_damping = modal_damping_matrix(s.mass, s.stiffness, s.modal_ratio);
    } catch (const std::invalid_argument& error) {
      throw ModelError(
          ModelOption::damping, static_cast<int>(i),
          fmt::format("{}, or analysis: {{reduction: auto}}, which needs no matrix where it reduces the structure",
                      error.what()));
    }
  }
}

// A delayed ground motion starts from rest, so an initial velocity would be a jump.
bool begins_with_velocity(const GroundComponents& ground) {
  return std::any_of(ground.begin(), ground.end(),
                     [](const GroundMotion& motion) { return motion.initial_velocity() != 0; });
}

}  // namespace

void require_structure_name(const std::string& name) {
  if (name.empty() || name.find_first_of("/.") != std::string::npos)
    throw ModelError(ModelOption::name,
                     "a name must not be empty or contain \".\" or \"/\"; type a name such as left_building");
  if (const std::string wrong = wrong_name(name); !wrong.empty()) throw ModelError(ModelOption::name, wrong);
}

void Model::require_open() const {
  if (is_on_ground_) throw std::logic_error("the model is complete; nothing can be added");
}

StructureHandle Model::add(const std::string& name, Structure s, const StructureOptions& options) {
  require_open();
  require_structure_name(name);
  require_free_name(name, structures);
  s.name = name;
  if (s.damping.size() == 0) s.damping.resize(s.size(), s.size());
  if (!s.is_rigid() && count_of_modes(s) == 0)
    throw ModelError(ModelOption::structure,
                     "it has no mass; type masses: {NODE: 10 t}, floor_mass: 60 t in a grid, or density: 2500 "
                     "kg/m^3 in a material");
  damp(s, options.damping, mode_solver);
  set_initial_motion(s, options);
  apply_forces(s, options.forces);
  if (!(options.delay >= 0) || std::isinf(options.delay))
    throw ModelError(ModelOption::delay, "delay must be finite and not negative");
  take_face(s, options.face);
  structures.push_back(std::move(s));
  own_ground_.push_back({options.delay, options.ground_motion});
  return StructureHandle(static_cast<int>(structures.size()) - 1);
}

std::vector<Support> Model::supports_on_ground(int structure) const {
  const Structure& s = structures[structure];
  const OwnGround& own = own_ground_[structure];
  std::vector<Support> supports;
  if (ground.wave && !own.motion && s.supports_along) {
    try {
      supports = s.supports_along(ground.wave->direction);
    } catch (const std::invalid_argument& error) {
      throw ModelError(ModelOption::wave, structure, error.what());
    }
  } else {
    supports = s.supports;
  }
  if (own.motion) {
    refuse_idle_components(*own.motion, s.dimension, structure);
    for (Support& support : supports)
      if (!support.motion) support.motion = *own.motion;
  }
  for (Support& support : supports) support.delay += own.delay;
  for (const Support& support : supports)
    if (support.delay > 0 && begins_with_velocity(support.motion ? *support.motion : ground.components))
      throw ModelError(ModelOption::delay, structure,
                       "the ground motion starts with a velocity, which would be a jump after a delay; remove the "
                       "delay, or give harmonics another phase");
  if (!is_still(ground.components)) return supports;
  for (const Support& support : supports) {
    if (support.motion || support.delay == 0) continue;
    const std::string what = own.delay > 0 ? "" : fmt::format("support {} has a delay, and ", support.name);
    throw ModelError(ModelOption::delay, structure,
                     what + "the ground motion is missing; give a ground_motion, or remove the delay")
        .as_idle();
  }
  return supports;
}

void Model::put_on_ground() {
  if (is_on_ground_) return;
  if (ground.wave) {
    std::vector<bool> on_wave;
    for (const OwnGround& own : own_ground_) on_wave.push_back(!own.motion);
    place_by_links(structures, links, devices, on_wave, ground.wave->direction);
  }
  std::vector<std::vector<Support>> supports;
  for (std::size_t i = 0; i < structures.size(); ++i) supports.push_back(supports_on_ground(static_cast<int>(i)));
  for (std::size_t i = 0; i < structures.size(); ++i) structures[i].supports = std::move(supports[i]);
  is_on_ground_ = true;
}

void Model::check_ground() const {
  int dimension = 1;
  for (const Structure& s : structures)
    if (!s.is_rigid()) dimension = std::max(dimension, s.dimension);
  refuse_idle_components(ground.components, dimension, -1);
  if (!ground.wave) return;
  if (begins_with_velocity(ground.components))
    throw ModelError(ModelOption::wave,
                     "the ground motion starts with a velocity, which would be a jump at the arrival of the wave; use "
                     "a motion that starts at rest");
  // A wave with equal arrival times has no effect.
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const Structure& s : structures)
    for (const Support& support : s.supports) {
      if (support.motion) continue;
      const double along = support.position.dot(ground.wave->direction);
      nearest = std::min(nearest, along);
      farthest = std::max(farthest, along);
    }
  if (!(farthest - nearest > together))
    refuse_idle(ModelOption::wave, "reaches all supports at the same time; give each frame an origin, or remove it");
}

namespace {

// Reason why this collapse_drift cannot be monitored; empty if it can, or if there is none.
std::string fault_of_collapse(const std::vector<Structure>& structures, double collapse_drift) {
  if (collapse_drift == 0) return {};
  if (!(collapse_drift > 0 && std::isfinite(collapse_drift)))
    return fmt::format("collapse_drift must be finite and positive; {:g} was given", collapse_drift);
  bool any = false;
  for (const Structure& s : structures) {
    const bool known = !storey_heights(s).empty();
    any = any || known;
    if (!known && s.kind == "shear_building" && !s.yielding.empty())
      return fmt::format(
          "collapse_drift is relative to the storey height, but {} has no heights; type height: 3 m in it, or leave "
          "out "
          "collapse_drift",
          s.name);
  }
  return any ? std::string()
             : "collapse_drift is relative to the storey height, but no structure has heights; type height: 3 m in "
               "one, or leave it out";
}

}  // namespace

void Model::check_settings() const {
  const auto refuse = [](const std::string& text) { throw ModelError(ModelOption::analysis, text); };
  const auto is_time = [](double value) { return value >= 0 && std::isfinite(value); };
  if (!is_time(analysis.duration) || !is_time(analysis.output_step) || !is_time(analysis.max_step))
    refuse("duration, output_step and max_step must be finite and not negative");
  if (!(analysis.tolerance >= min_tolerance && analysis.tolerance <= max_tolerance))
    refuse(fmt::format("the tolerance must be in [{:g}, {:g}]; {:g} was given", min_tolerance, max_tolerance,
                       analysis.tolerance));
  if (analysis.duration > 0 && analysis.output_step > analysis.duration)
    refuse(fmt::format("the output_step of {:g} s is longer than the duration of {:g} s", analysis.output_step,
                       analysis.duration));
  if (analysis.max_steps < 1 || analysis.max_steps > max_step_count)
    refuse(fmt::format("most_steps must be in [1, {}]; {} was given", max_step_count, analysis.max_steps));
  if (const std::string text = fault_of_collapse(structures, analysis.collapse_drift); !text.empty()) refuse(text);
  if (const double radius = analysis.scheme.spectral_radius; !(radius >= 0 && radius <= 1))
    refuse(fmt::format("the spectral_radius must be in [0, 1]; {:g} was given", radius));
  for (const std::string& name : accept)
    if (std::find(warning_names.begin(), warning_names.end(), name) == warning_names.end())
      throw ModelError(ModelOption::accept,
                       fmt::format("unknown warning \"{}\".{}", excerpt(name), suggestion(name, warning_names)));
  if (!is_time(checkpoint.every) || !is_time(checkpoint.every_simulated))
    throw ModelError(ModelOption::checkpoint, "every and every_simulated must be finite and not negative");
}

void Model::complete() {
  if (is_complete_) return;
  if (std::all_of(structures.begin(), structures.end(), [](const Structure& s) { return s.is_rigid(); }))
    throw ModelError(ModelOption::structures,
                     "no structure can move; add a body, an oscillator, a shear_building or a frame");
  check_settings();
  put_on_ground();
  check_ground();
  require_devices_on_one_ground(*this);
  form_modal_damping(*this);
  press_preloaded(structures, links);
  given_duration_ = analysis.duration, given_output_step_ = analysis.output_step;
  fill_in_times();
  is_complete_ = true;
}

bool Model::can_move_otherwise() const noexcept {
  if (!is_complete_ || ground.wave) return false;
  for (const Structure& s : structures)
    for (const Support& support : s.supports)
      if (support.delay != 0) return false;
  return true;
}

void Model::move_otherwise(const GroundSection& other) {
  if (!can_move_otherwise() || other.wave)
    throw std::logic_error("the ground motion of this model cannot be replaced; create a new model");
  ground = other;
  analysis.duration = given_duration_, analysis.output_step = given_output_step_;
  check_ground();
  require_devices_on_one_ground(*this);
  fill_in_times();
}

void Model::fill_in_times() {
  const GroundPlan plan = ground_plan(*this);
  if (analysis.duration == 0) analysis.duration = plan.duration();
  if (analysis.duration == 0 || std::isinf(analysis.duration))
    throw ModelError(ModelOption::analysis, "the duration is missing; type analysis: {duration: 10 s}");
  if (analysis.output_step == 0) {
    const double sample = plan.sample_step();
    analysis.output_step = sample > 0 ? std::min(sample, analysis.duration) : analysis.duration / 1000;
  }
  require_affordable(*this);
}

}  // namespace pounding
