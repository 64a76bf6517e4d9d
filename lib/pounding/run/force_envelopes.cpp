#include <pounding/run/force_envelopes.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <pounding/run/histories.hpp>

namespace pounding {
namespace {

// Steps go on without a knot up to this part of the longest step,
constexpr double longest_without_knot = 1.0 / 8;
// and while the cubic misses floors by less than this part of their largest displacement: a bend that changes by da within a time t
// moves it by da t^2/64 at most.
constexpr double allowed_miss = 1e-5;

}  // namespace

ForceEnvelopes::ForceEnvelopes(const Model& model, const GroundPlan& plan, const Stepper& stepper, Results& results)
    : model_(model), plan_(plan), stepper_(stepper), results_(results), first_unknown_(offsets(model)) {
  const System& system = stepper.system();
  const bool with_links = system.contact_count() > 0;
  std::size_t spring = system.contact_count();
  for (int k = 0; k < static_cast<int>(model.structures.size()); ++k) {
    const Structure& s = model.structures[k];
    first_spring_.push_back(spring);
    spring += s.yielding.size();
    StructureEnvelope& envelope = results_.structures[k].envelope;
    if (s.has_storeys()) envelope.storey_shear = Extremes(s.floors.size() * results_.structures[k].storey_directions());
    if (s.dimension == 1) continue;
    const std::size_t ends = s.forces.members.size() * s.forces.components.size();
    envelope.member_force = Extremes(ends);
    envelope.reaction = Extremes(s.forces.supports.size() * s.forces.directions.size());
    blocks_.push_back({k, internal_forces(model, k, plan), {}, {}, {}, {}});
    if (s.forces.turned) blocks_.back().u = Eigen::VectorXd::Zero(1);
    for (int i = 0; with_links && i < static_cast<int>(model.links.size()); ++i) {
      const Link& link = model.links[i];
      rigid_ = rigid_ || link.contact->is_rigid();
      for (const auto& [end, sign] : {std::pair(&link.left, -1.0), std::pair(&link.right, 1.0)}) {
        if (end->structure != k || end->point.member < 0) continue;
        const Eigen::Matrix<double, 12, 1> fixed = end->point.fixed_ends * (sign * link.direction);
        const int components = static_cast<int>(s.forces.components.size());
        FixedEnds made{i, static_cast<int>(blocks_.size()) - 1,
                       static_cast<int>(envelope.storey_shear.size()) + end->point.member * components, Eigen::VectorXd(components)};
        for (int j = 0; j < components; ++j) made.by_force[j] = fixed[s.forces.places[j]];
        fixed_ends_.push_back(std::move(made));
      }
    }
  }
  if (!with_links && !model.links.empty()) {
    blocks_.push_back({-1, approaches(model, plan), {}, {}, {}, {}});
    results_.approach = Extremes(static_cast<std::size_t>(blocks_.back().quantities.size()));
  }
}

// Calls `update` for each quantity with its list of extremes and its place there.
template <class Update>
void ForceEnvelopes::update_each(const Block& block, Update&& update) {
  int quantity = 0;
  const auto each = [&](Extremes& extremes) {
    for (std::size_t i = 0; i < extremes.size(); ++i, ++quantity) update(extremes, i, quantity);
  };
  if (block.structure < 0) return each(results_.approach);
  StructureEnvelope& envelope = results_.structures[block.structure].envelope;
  each(envelope.storey_shear);
  each(envelope.member_force);
  each(envelope.reaction);
}

template <class Force>
void ForceEnvelopes::add_fixed_end_forces(const Block& block, Eigen::VectorXd& values, Force&& force) const {
  for (const FixedEnds& ends : fixed_ends_)
    if (&blocks_[ends.block] == &block) values.segment(ends.first, ends.by_force.size()) += force(ends.link) * ends.by_force;
}

void ForceEnvelopes::evaluate(const Block& block, double time, const Eigen::VectorXd& u, const Eigen::VectorXd& v,
                              Eigen::VectorXd& values, Eigen::VectorXd& rates) const {
  values.resize(block.quantities.size());
  rates.resize(block.quantities.size());
  block.quantities.evaluate(u, v, time, plan_.motions, values, rates);
  if (!block.turns()) return;
  const Structure& s = model_.structures[block.structure];
  Eigen::VectorXd q = u.segment(first_unknown_[block.structure], s.size());
  if (s.at_rest.size() > 0) q += s.at_rest;
  const Eigen::VectorXd shears = s.storey_shears(q);
  values.head(shears.size()) += shears;
  values.tail(values.size() - shears.size()) += s.forces.turned(q);
}

void ForceEnvelopes::start_from(const State& state, const Eigen::MatrixXd& floors) {
  knot_ = state.time;
  knot_accelerations_ = floors.col(2);
  for (Block& block : blocks_) {
    evaluate(block, state.time, state.u, state.v, block.values, block.rates);
    if (!block.turns()) continue;
    block.u = state.u;
    block.v = state.v;
  }
}

void ForceEnvelopes::begin(const Eigen::MatrixXd& floors) {
  const double time = stepper_.time();
  int row = 0;
  for (std::size_t k = 0; k < model_.structures.size(); ++k) {
    const Structure& s = model_.structures[k];
    Extremes& shear = results_.structures[k].envelope.storey_shear;
    for (std::size_t i = 0; i < s.storey_stiffness.size(); ++i) {
      const int at = row + static_cast<int>(i);
      const double drift = floors(at, 0) - (i > 0 ? floors(at - 1, 0) : 0);
      double force = s.storey_stiffness[i] * drift;
      if (!s.yielding.empty()) force += s.yielding[i].spring->evaluate({.penetration = drift}).force;
      shear.update(i, time, force);
    }
    row += s.floors.empty() ? 0 : static_cast<int>(s.floors.size() * s.floors.front().motion.size());
  }
  if (blocks_.empty()) return;
  start_from(stepper_.state(), floors);
  for (Block& block : blocks_) {
    Eigen::VectorXd values = block.values;
    add_fixed_end_forces(block, values, [&](int link) { return stepper_.link_forces()[link]; });
    update_each(block, [&](Extremes& extremes, std::size_t i, int quantity) { extremes.update(i, time, values[quantity]); });
  }
}

void ForceEnvelopes::step(const StepMotion& step) {
  int row = 0;
  for (std::size_t k = 0; k < model_.structures.size(); ++k) {
    const Structure& s = model_.structures[k];
    if (!s.storey_stiffness.empty()) step_springs(static_cast<int>(k), row, step);
    row += s.floors.empty() ? 0 : static_cast<int>(s.floors.size() * s.floors.front().motion.size());
  }
  if (blocks_.empty()) return;
  if (rigid_) {
    start_from(stepper_.begin(), step.begin);
    close(stepper_.end_minus(), step.end_minus, presses_on_members());
    return;
  }
  const bool pressed = presses_on_members();
  if (step.begin_time > knot_ && (pressed || !is_close(step))) close(stepper_.begin(), step.begin, false);
  if (pressed) close(stepper_.end_minus(), step.end_minus, true);
}

void ForceEnvelopes::end() {
  if (!blocks_.empty() && stepper_.time() > knot_) {
    const State& now = stepper_.state();
    close(now, stepper_.outputs().motion, false);
  }
}

void ForceEnvelopes::step_springs(int k, int row, const StepMotion& step) {
  const Structure& s = model_.structures[k];
  Extremes& shear = results_.structures[k].envelope.storey_shear;
  for (std::size_t i = 0; i < s.storey_stiffness.size(); ++i) {
    const int at = row + static_cast<int>(i);
    const auto drift = [&](const Eigen::MatrixXd& floors, int column) {
      return floors(at, column) - (i > 0 ? floors(at - 1, column) : 0);
    };
    const double k_i = s.storey_stiffness[i], d0 = drift(step.begin, 0), d1 = drift(step.end_minus, 0);
    const double v0 = drift(step.begin, 1), v1 = drift(step.end_minus, 1);
    if (s.yielding.empty()) {
      shear.update(i, step.begin_time, step.h, k_i * d0, k_i * v0, k_i * d1, k_i * v1);
      continue;
    }
    const LinkStep& spring = stepper_.link_steps()[first_spring_[k] + i];
    const auto update = [&](double part, double d) {
      shear.update(i, step.begin_time + part * step.h, k_i * d + spring_force(spring, step.begin_time + part * step.h, d));
    };
    const double turn = v0 * v1 < 0 ? v0 / (v0 - v1) : 0.5;
    const Cubic at_turn(turn, step.h), at_middle(0.5, step.h);
    update(turn, at_turn.begin * d0 + at_turn.end * d1 + at_turn.slope_begin * v0 + at_turn.slope_end * v1);
    if (turn != 0.5) update(0.5, at_middle.begin * d0 + at_middle.end * d1 + at_middle.slope_begin * v0 + at_middle.slope_end * v1);
    update(1, d1);
  }
}

bool ForceEnvelopes::presses_on_members() const {
  return std::any_of(fixed_ends_.begin(), fixed_ends_.end(), [&](const FixedEnds& ends) {
    const LinkStep& step = stepper_.link_steps()[ends.link];
    return step.force_begin != 0 || step.force_middle != 0 || step.force_end != 0;
  });
}

// Whether the cubic from the last knot to the end of this step still follows the motion.
bool ForceEnvelopes::is_close(const StepMotion& step) const {
  const double time = step.end_time() - knot_;
  if (time > longest_without_knot * stepper_.options().max_step) return false;
  int row = 0;
  for (const StructureHistory& history : results_.structures) {
    const Extremes& displacement = history.envelope.displacement;
    const int directions = static_cast<int>(history.directions.size());
    for (int j = 0; j < directions; ++j) {
      double largest = 0, change = 0;
      for (std::size_t i = j; i < displacement.size(); i += directions) {
        const int at = row + static_cast<int>(i);
        largest = std::max(largest, displacement.peak(i));
        change = std::max(change, std::abs(step.end_minus(at, 2) - knot_accelerations_[at]));
      }
      if (change * time * time / 64 > allowed_miss * largest) return false;
    }
    row += static_cast<int>(displacement.size());
  }
  return true;
}

void ForceEnvelopes::close(const State& state, const Eigen::MatrixXd& floors, bool pressed) {
  const double h = state.time - knot_;
  if (!(h > 0)) return;
  Eigen::VectorXd end, rates;
  for (Block& block : blocks_) {
    evaluate(block, state.time, state.u, state.v, end, rates);
    if (!pressed && !block.turns()) {
      update_each(block, [&](Extremes& extremes, std::size_t i, int q) {
        extremes.update(i, knot_, h, block.values[q], block.rates[q], end[q], rates[q]);
      });
    } else {
      Eigen::VectorXd begin = block.values, middle, ends = end, unused;
      if (block.turns())
        evaluate(block, knot_ + 0.5 * h, 0.5 * (block.u + state.u) + h / 8 * (block.v - state.v), state.v, middle, unused);
      else
        middle = 0.5 * (block.values + end) + h / 8 * (block.rates - rates);
      if (pressed) {
        const std::vector<LinkStep>& links = stepper_.link_steps();
        add_fixed_end_forces(block, begin, [&](int link) { return links[link].force_begin; });
        add_fixed_end_forces(block, middle, [&](int link) { return links[link].force_middle; });
        add_fixed_end_forces(block, ends, [&](int link) { return links[link].force_end; });
      }
      update_each(block, [&](Extremes& extremes, std::size_t i, int q) {
        extremes.update(i, knot_, begin[q]);
        extremes.update(i, knot_, h, begin[q], middle[q], ends[q]);
      });
    }
    block.values.swap(end);
    block.rates.swap(rates);
    if (!block.turns()) continue;
    block.u = state.u;
    block.v = state.v;
  }
  knot_ = state.time;
  knot_accelerations_ = floors.col(2);
}

void ForceEnvelopes::archive(Archive& archive) {
  archive(knot_);
  archive(knot_accelerations_);
  for (Block& block : blocks_) {
    archive(block.values);
    archive(block.rates);
    archive(block.u);
    archive(block.v);
  }
}

}  // namespace pounding
