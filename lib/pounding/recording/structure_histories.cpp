#include <pounding/recording/structure_histories.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include <pounding/recording/headings.hpp>
#include <pounding/recording/histories.hpp>

namespace pounding {
namespace {

void add(const Eigen::VectorXd& more, std::vector<double>& values, std::size_t from) {
  for (Eigen::Index i = 0; i < more.size(); ++i) values[from + i] += more[i];
}

// Adds `amount` times the factors to the last sample of a history.
template <class Factors>
void add_to_last(std::vector<double>& values, const Factors& factors, double amount) {
  const std::size_t from = values.size() - factors.size();
  for (int i = 0; i < factors.size(); ++i) values[from + i] += amount * factors[i];
}

}  // namespace

StructureHistories::StructureHistories(const Model& model, const GroundPlan& plan, const FloorResponse& response,
                                       const StepView& stepper, std::vector<StructureHistory>& histories)
    : model_(model),
      plan_(plan),
      response_(response),
      stepper_(stepper),
      histories_(histories),
      first_unknown_(offsets(model)) {
  std::size_t spring = stepper.system().contact_count();
  int group = 0;
  const std::vector<StructureSolver::Segment>& segments = stepper.base().layout().segments;
  for (const Structure& s : model.structures) {
    histories_.push_back(heading(s));
    first_spring_.push_back(spring);
    spring += s.yielding.size();
    const bool is_frame =
        !s.nodes.motion.empty() || s.forces.rows.rows() > 0 || (s.has_storeys() && s.storey_stiffness.empty());
    reported_.push_back(reported_forces(s));
    rows_.emplace_back();
    // Yielding parts add contributions to displacements and forces that no mode represents.
    const bool by_modes = !s.is_rigid() && s.supports.size() == 1 && s.yielding.empty() && stepper.is_linear();
    const auto own = std::ranges::find(segments, group, &StructureSolver::Segment::group);
    if (by_modes && own != segments.end() && own->modes) rows_.back().emplace(s, reported_.back(), *own);
    needs_unknowns_ = needs_unknowns_ || (is_frame && !rows_.back());
    has_rows_ = has_rows_ || rows_.back();
    group += s.is_rigid() ? 0 : 1;
  }
}

void StructureHistories::sample(const OutputInstant& at) {
  for (std::size_t k = 0; k < histories_.size(); ++k) sample_floors(static_cast<int>(k), at);
  if (needs_unknowns_ || has_rows_) sample_frames(at);
}

void StructureHistories::sample_floors(int k, const OutputInstant& at) {
  const Structure& s = model_.structures[k];
  StructureHistory& history = histories_[k];
  const int directions = response_.directions(k),
            yielding = s.storey_stiffness.empty() ? 0 : static_cast<int>(s.members_that_yield());
  for (int i = 0; i < static_cast<int>(s.floors.size()); ++i)
    for (int j = 0; j < directions; ++j) {
      const int row = response_.row(k, i, j);
      history.displacement.push_back(at.floors(row, 0));
      history.velocity.push_back(at.floors(row, 1));
      history.acceleration.push_back(at.floors(row, 2));
      if (!s.has_storeys() || j > 1) continue;
      const double drift = at.floors(row, 0) - (i > 0 ? at.floors(row - directions, 0) : 0);
      history.drift.push_back(drift);
      if (s.storey_stiffness.empty()) continue;
      double shear = s.storey_stiffness[i] * drift;
      if (i < yielding) {
        const int link = static_cast<int>(first_spring_[k] + i);
        shear += at.inside ? spring_force(stepper_.links(), link, stepper_.link_step(link), at.time, drift)
                           : stepper_.links().law(link, {.penetration = drift}).force;
      }
      shear += shear_by_devices(s.floors[i], [&](std::size_t part) { return device_force(k, part, at); });
      history.storey_shear.push_back(shear);
    }
}

// Force of a device inside a structure.
double StructureHistories::device_force(int k, std::size_t part, const OutputInstant& at) const {
  const int link = static_cast<int>(first_spring_[k] + part);
  if (!at.inside) return stepper_.link_forces()[link];
  const LinkStep& step = stepper_.link_step(link);
  const double d = interpolate(step, (at.time - step.begin) / (step.end - step.begin)).penetration;
  return spring_force(stepper_.links(), link, step, at.time, d);
}

void StructureHistories::take_motion(const OutputInstant& at) {
  if (has_rows_ && at.inside)
    stepper_.interpolate_coordinates(at.time, coordinates_);
  else if (has_rows_)
    coordinates_ = stepper_.instant().motion.leftCols(3);
  if (!needs_unknowns_) return;
  if (at.inside) {
    stepper_.interpolate(at.time, u_, v_);
    stepper_.interpolate_acceleration(at.time, a_);
    stepper_.interpolate_springs(at.time, springs_);
  } else {
    const State& now = stepper_.state();
    springs_ = now.force.segment(stepper_.system().contact_count(), stepper_.system().spring_count());
    u_ = now.u;
    v_ = now.v;
    a_ = now.a;
  }
}

void StructureHistories::sample_frames(const OutputInstant& at) {
  take_motion(at);
  for (std::size_t k = 0; k < histories_.size(); ++k) {
    const Structure& s = model_.structures[k];
    if (s.dimension == 1) continue;
    const int structure = static_cast<int>(k);
    if (rows_[k]) {
      append(structure, rows_[k]->at(coordinates_),
             Eigen::VectorXd::Zero(static_cast<Eigen::Index>(reported_[k].size())), at);
      continue;
    }
    const int first = first_unknown_[k];
    Eigen::VectorXd u = u_.segment(first, s.size()), v = v_.segment(first, s.size()), a = a_.segment(first, s.size());
    if (s.at_rest.size() > 0) u += s.at_rest;
    const SupportMotion& ground = plan_.supports[k];
    const auto influence = [&](std::size_t support, int axis) { return s.supports[support].influence.col(axis); };
    ground.displacement(at.time, [&](std::size_t q, int axis, double amount) { u += amount * influence(q, axis); });
    ground.velocity(at.time, [&](std::size_t q, int axis, double amount) { v += amount * influence(q, axis); });
    ground.acceleration(at.ground, [&](std::size_t q, int axis, double amount) { a += amount * influence(q, axis); });
    const std::size_t shears = histories_[k].storey_shear.size();
    const Eigen::VectorXd in_members = stepper_.member_forces(first, at.time);
    append(structure, frame_quantities(s, reported_[k], u, v, a), forces_beside(structure, u, in_members), at);
    if (s.storey_shears) add(s.storey_shears(u, in_members), histories_[k].storey_shear, shears);
    if (s.supports.size() > 1) add_enforced(structure, at);
  }
}

// Contribution of nonlinear members and yielding parts to the reported forces.
Eigen::VectorXd StructureHistories::forces_beside(int k, const Eigen::VectorXd& u,
                                                  const Eigen::VectorXd& in_members) const {
  const InternalForces& of = model_.structures[k].forces;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(of.rows.rows());
  if (of.nonlinear) all = of.nonlinear(u, in_members);
  if (of.by_yielding.size() > 0)
    if (const Eigen::VectorXd yielding = yielding_forces(k); !yielding.isZero(0)) all += of.by_yielding * yielding;
  return all(reported_[k]);
}

// Displacements and velocities are relative to the ground at the first support, accelerations absolute; `added`: forces
// in addition to those of the system.
void StructureHistories::append(int k, const FrameQuantities& of, const Eigen::VectorXd& added,
                                const OutputInstant& at) {
  const Structure& s = model_.structures[k];
  StructureHistory& history = histories_[k];
  std::vector<double> ground_acceleration;
  for (const std::string& direction : s.nodes.directions) {
    const int axis = direction == "x" ? 0 : direction == "y" ? 1 : direction == "z" ? 2 : -1;
    const int motion = axis < 0 ? -1 : plan_.supports[k].at_first(axis);
    ground_acceleration.push_back(motion < 0 ? 0.0 : at.ground[motion]);
  }
  history.node_displacement.insert(history.node_displacement.end(), of.displacement.begin(), of.displacement.end());
  history.node_velocity.insert(history.node_velocity.end(), of.velocity.begin(), of.velocity.end());
  Eigen::Index number = 0;
  for (const std::vector<Row>& node : s.nodes.motion)
    for (std::size_t j = 0; j < node.size(); ++j)
      history.node_acceleration.push_back(of.acceleration[number++] + ground_acceleration[j]);
  const Eigen::VectorXd yielding = yielding_forces(k);
  number = 0;
  for (const Floor& floor : s.floors)
    for (std::size_t j = 0; j < floor.storey_shear.size(); ++j) {
      double by_yielding = 0;
      if (!floor.storey_shear_by_yielding.empty())
        for (Row::InnerIterator it(floor.storey_shear_by_yielding[j]); it; ++it)
          by_yielding += it.value() * yielding[it.index()];
      history.storey_shear.push_back(of.shears[number++] + by_yielding);
    }
  const std::size_t from = history.end_forces.size(), ends = s.reported_members.size() * s.forces.components.size();
  for (std::size_t i = 0; i < reported_[k].size(); ++i) {
    const auto at_row = static_cast<Eigen::Index>(i);
    const double force = (of.forces[at_row] + s.forces.at_rest[reported_[k][i]]) + added[at_row];
    (i < ends ? history.end_forces : history.reaction).push_back(force);
  }
  if (stepper_.system().contact_count() > 0) add_fixed_end_forces(k, from, at);
}

// Forces of the yielding parts of a structure, at the output time.
Eigen::VectorXd StructureHistories::yielding_forces(int k) const {
  const Eigen::Index count = static_cast<Eigen::Index>(model_.structures[k].yielding.size());
  if (count == 0) return {};
  return springs_.segment(static_cast<Eigen::Index>(first_spring_[k]) - stepper_.system().contact_count(), count);
}

// Adds the fixed-end forces of contacts that act on a member between its ends, and their reactions.
void StructureHistories::add_fixed_end_forces(int k, std::size_t from, const OutputInstant& at) {
  const Structure& s = model_.structures[k];
  const std::size_t components = s.forces.components.size();
  for (std::size_t i = 0; i < model_.links.size(); ++i) {
    const Link& link = model_.links[i];
    for (const auto& [end, sign] : {std::pair(&link.left, -1.0), std::pair(&link.right, 1.0)}) {
      if (end->structure != k || end->point.member < 0) continue;
      const LinkStep& step = stepper_.link_step(static_cast<int>(i));
      const double force = at.inside ? force_inside(step, (at.time - step.begin) / (step.end - step.begin))
                                     : stepper_.link_forces()[static_cast<int>(i)];
      if (force == 0) continue;
      add_to_last(histories_[k].reaction, Eigen::VectorXd(end->point.reactions * link.direction), sign * force);
      const auto found = std::find(s.reported_members.begin(), s.reported_members.end(), end->point.member);
      if (found == s.reported_members.end()) continue;
      const std::size_t m = found - s.reported_members.begin();
      const Eigen::Matrix<double, 12, 1> fixed = end->point.fixed_ends * (sign * force * link.direction);
      for (std::size_t j = 0; j < components; ++j)
        histories_[k].end_forces[from + m * components + j] += fixed[s.forces.places[j]];
    }
  }
}

// For supports that move differently: adds their direct contribution, with zero unknowns, to the last sample.
void StructureHistories::add_enforced(int k, const OutputInstant& at) {
  const Structure& s = model_.structures[k];
  const std::vector<Support>& supports = s.supports;
  const int components = static_cast<int>(s.forces.components.size());
  const int first_reaction = static_cast<int>(s.forces.members.size()) * components;
  const SupportMotion& ground = plan_.supports[k];
  StructureHistory& history = histories_[k];
  ground.displacement(at.time, [&](std::size_t q, int axis, double amount) {
    add_to_last(history.node_displacement, supports[q].nodes.col(axis), amount);
    add_to_last(history.storey_shear, supports[q].shears.col(axis), amount);
    std::size_t member = history.end_forces.size() - s.reported_members.size() * components;
    for (const int number : s.reported_members)
      for (int j = 0; j < components; ++j)
        history.end_forces[member++] += amount * supports[q].forces(number * components + j, axis);
    add_to_last(history.reaction, supports[q].forces.col(axis).tail(s.forces.rows.rows() - first_reaction), amount);
  });
  ground.velocity(at.time, [&](std::size_t q, int axis, double amount) {
    add_to_last(history.node_velocity, supports[q].nodes.col(axis), amount);
  });
  ground.acceleration(at.ground, [&](std::size_t q, int axis, double amount) {
    add_to_last(history.node_acceleration, supports[q].nodes.col(axis), amount);
  });
}

}  // namespace pounding
