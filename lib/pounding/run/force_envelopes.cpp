#include <pounding/run/force_envelopes.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include <pounding/run/histories.hpp>

namespace pounding {
namespace {

// Steps go on without a knot while the cubic misses the displacements by less than this part of the largest ones, both as square
// roots of their strain energy. An acceleration that strays from a straight line by da within a time t moves it by da t^2/64. Three
// times as much leaves axial forces of beams that are hit more than 1e-3 off.
constexpr double allowed_miss = 1e-5;

// Time over which the forces of members that turn are differentiated.
constexpr double difference = 1e-7;  // [s]

}  // namespace

ForceEnvelopes::ForceEnvelopes(const Model& model, const GroundPlan& plan, const Stepper& stepper, Results& results)
    : model_(model), plan_(plan), stepper_(stepper), results_(results), first_unknown_(offsets(model)),
      largest_(stepper.system().groups.size()), strayed_(largest_) {
  motions_.setZero(Eigen::NoChange, stepper.system().size());
  const System& system = stepper.system();
  const bool with_links = system.contact_count() > 0;
  std::size_t spring = system.contact_count();
  for (int k = 0; k < static_cast<int>(model.structures.size()); ++k) {
    const Structure& s = model.structures[k];
    every_step_ = every_step_ || s.is_free || s.rigid_motions > 0;
    turns_ = turns_ || s.forces.turned;
    first_spring_.push_back(spring);
    spring += s.yielding.size();
    StructureEnvelope& envelope = results_.structures[k].envelope;
    if (s.has_storeys()) envelope.storey_shear = Extremes(s.floors.size() * results_.structures[k].storey_directions());
    if (s.dimension == 1) continue;
    const std::size_t ends = s.forces.members.size() * s.forces.components.size();
    envelope.member_force = Extremes(ends);
    envelope.reaction = Extremes(s.forces.supports.size() * s.forces.directions.size());
    const int components = static_cast<int>(s.forces.components.size()), shears = static_cast<int>(envelope.storey_shear.size());
    std::set<int> pressed;  // members
    for (int i = 0; with_links && i < static_cast<int>(model.links.size()); ++i) {
      const Link& link = model.links[i];
      every_step_ = every_step_ || link.contact->is_rigid();
      for (const LinkEnd* end : {&link.left, &link.right})
        if (end->structure == k && end->point.member >= 0) pressed.insert(end->point.member);
    }
    const auto apart = [&](int quantity) {
      return s.forces.turned || (quantity >= shears && pressed.contains((quantity - shears) / components));
    };
    add_block(k, internal_forces(model, k, plan, apart));
    const std::vector<LinearQuantities::Place>& places = blocks_.back().quantities.places();
    for (int i = 0; !pressed.empty() && i < static_cast<int>(model.links.size()); ++i) {
      const Link& link = model.links[i];
      for (const auto& [end, sign] : {std::pair(&link.left, -1.0), std::pair(&link.right, 1.0)}) {
        if (end->structure != k || end->point.member < 0) continue;
        const Eigen::Matrix<double, 12, 1> fixed = end->point.fixed_ends * (sign * link.direction);
        FixedEnds made{i, static_cast<int>(blocks_.size()) - 1, places[shears + end->point.member * components].at,
                       Eigen::VectorXd(components)};
        for (int j = 0; j < components; ++j) made.by_force[j] = fixed[s.forces.places[j]];
        fixed_ends_.push_back(std::move(made));
      }
    }
  }
  if (!with_links && !model.links.empty()) {
    add_block(-1, approaches(model, plan));
    results_.approach = blocks_.back().extremes;
  }
}

void ForceEnvelopes::add_block(int structure, LinearQuantities quantities) {
  const std::size_t count = static_cast<std::size_t>(quantities.size());
  blocks_.push_back({structure, std::move(quantities), {}, {}, Extremes(count)});
}

template <class Force>
void ForceEnvelopes::add_fixed_end_forces(const Block& block, Eigen::VectorXd& values, Force&& force) const {
  for (const FixedEnds& ends : fixed_ends_)
    if (&blocks_[ends.block] == &block) values.segment(ends.first, ends.by_force.size()) += force(ends.link) * ends.by_force;
}

void ForceEnvelopes::evaluate(const Block& block, const State& state, Eigen::VectorXd& values, Eigen::VectorXd& rates) {
  motion_.resize(Eigen::NoChange, state.u.size());
  motion_.row(0) = state.u;
  motion_.row(1) = state.v;
  block.quantities.evaluate<1>(motion_, std::span(&state.time, 1), plan_.motions, evaluated_once_);
  values = evaluated_once_.row(0);
  rates = evaluated_once_.row(1);
  if (block.structure < 0 || !model_.structures[block.structure].forces.turned) return;
  const Structure& s = model_.structures[block.structure];
  Eigen::VectorXd q = state.u.segment(first_unknown_[block.structure], s.size());
  if (s.at_rest.size() > 0) q += s.at_rest;
  const auto turned = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd forces(values.size());
    forces << s.storey_shears(at), s.forces.turned(at);
    return forces;
  };
  const Eigen::VectorXd forces = turned(q);
  values += forces;
  rates += (turned(q + difference * state.v.segment(first_unknown_[block.structure], s.size())) - forces) / difference;
}

// By group: sqrt(x^T K x), of all processes.
std::vector<double> ForceEnvelopes::strain_norms(const Eigen::VectorXd& x) const {
  const StructureSolver& solver = stepper_.base();
  Eigen::VectorXd kx(x.size());
  solver.stiffness_times(x, kx);
  std::vector<double> norms(largest_.size(), 0.0);
  for (const StructureSolver::Segment& part : solver.segments())
    norms[part.group] += x.segment(part.first, part.count).dot(kx.segment(part.first, part.count));
  solver.combine(norms);
  for (double& norm : norms) norm = std::sqrt(std::max(0.0, norm));
  return norms;
}

void ForceEnvelopes::move_knot(const Instant& instant) {
  knot_ = instant.time;
  knot_acceleration_ = instant.motion.col(Instant::a);
  const std::vector<double> norms = strain_norms(instant.motion.col(Instant::u));
  for (std::size_t g = 0; g < norms.size(); ++g) largest_[g] = std::max(largest_[g], norms[g]);
  std::fill(strayed_.begin(), strayed_.end(), 0.0);
}

void ForceEnvelopes::start_from(const State& state, const Instant& instant) {
  for (Block& block : blocks_) evaluate(block, state, block.values, block.rates);
  followed_ = state.time;
  move_knot(instant);
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
  start_from(stepper_.state(), stepper_.instant_end_minus());
  for (Block& block : blocks_) {
    Eigen::VectorXd values = block.values;
    add_fixed_end_forces(block, values, [&](int link) { return stepper_.link_forces()[link]; });
    for (std::size_t i = 0; i < block.extremes.size(); ++i) block.extremes.update(i, time, values[static_cast<int>(i)]);
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
  const bool pressed = presses_on_members();
  if (every_step_) {
    start_from(stepper_.begin(), stepper_.instant_begin());
    close(stepper_.end_minus(), stepper_.instant_end_minus(), pressed);
    return;
  }
  if (turns_ && !pressed && step.h > 0) {
    State middle = stepper_.end_minus();
    middle.time = step.begin_time + 0.5 * step.h;
    stepper_.interpolate(middle.time, middle.u, middle.v);
    close(middle, stepper_.instant_begin(), false);
    close(stepper_.end_minus(), stepper_.instant_end_minus(), false);
    return;
  }
  if (step.begin_time > knot_ && (pressed || jumped_ || !stays_close())) close(stepper_.begin(), stepper_.instant_begin(), false);
  if (pressed) close(stepper_.end_minus(), stepper_.instant_end_minus(), true);
  jumped_ = step.jumps;
}

void ForceEnvelopes::end() {
  if (!blocks_.empty()) close(stepper_.end_minus(), stepper_.instant_end_minus(), false);
  show();
}

void ForceEnvelopes::show() {
  follow();
  for (const Block& block : blocks_) {
    auto place = block.quantities.places().begin();
    const auto copy = [&](Extremes& to) {
      for (std::size_t i = 0; i < to.size(); ++i, ++place) to.copy(i, block.extremes, static_cast<std::size_t>(place->at), place->opposite);
    };
    if (block.structure < 0) {
      copy(results_.approach);
      continue;
    }
    StructureEnvelope& envelope = results_.structures[block.structure].envelope;
    for (Extremes* extremes : {&envelope.storey_shear, &envelope.member_force, &envelope.reaction}) copy(*extremes);
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
      const double time = step.begin_time + part * step.h;
      shear.update(i, time, k_i * d + spring_force(*s.yielding[i].spring, spring, time, d));
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

// Whether the cubic from the last knot to the end of this step still follows the motion. The accelerations at the ends of the steps
// would lie on one line if it were exact.
bool ForceEnvelopes::stays_close() {
  const Instant &begin = stepper_.instant_begin(), &end = stepper_.instant_end_minus();
  const double time = end.time - knot_, part = time / (begin.time - knot_);
  const std::vector<double> strays = strain_norms(end.motion.col(Instant::a) - part * begin.motion.col(Instant::a) -
                                                  (1 - part) * knot_acceleration_);
  bool close = true;
  for (std::size_t g = 0; g < strays.size(); ++g) {
    strayed_[g] += strays[g];
    close = close && strayed_[g] * time * time / 64 <= allowed_miss * largest_[g];
  }
  return close;
}

void ForceEnvelopes::close(const State& state, const Instant& instant, bool pressed) {
  if (!(state.time > knot_)) return;
  if (pressed || every_step_ || turns_) {
    follow();
    follow(state, pressed);
  } else {
    const int at = 2 * static_cast<int>(times_.size());
    motions_.row(at) = state.u;
    motions_.row(at + 1) = state.v;
    times_.push_back(state.time);
    if (times_.size() == LinearQuantities::batch) follow();
  }
  move_knot(instant);
}

// To one knot, where contacts may press on members.
void ForceEnvelopes::follow(const State& state, bool pressed) {
  const double h = state.time - followed_;
  for (Block& block : blocks_) {
    evaluate(block, state, end_, rates_);
    if (!pressed) {
      for (int q = 0; q < block.quantities.size(); ++q) {
        const double pair[] = {end_[q], rates_[q]};
        block.extremes.update(static_cast<std::size_t>(q), followed_, std::span(&state.time, 1), block.values[q], block.rates[q], pair);
      }
    } else {
      Eigen::VectorXd begin = block.values, middle = 0.5 * (block.values + end_) + h / 8 * (block.rates - rates_), ends = end_;
      const std::vector<LinkStep>& links = stepper_.link_steps();
      add_fixed_end_forces(block, begin, [&](int link) { return links[link].force_begin; });
      add_fixed_end_forces(block, middle, [&](int link) { return links[link].force_middle; });
      add_fixed_end_forces(block, ends, [&](int link) { return links[link].force_end; });
      for (std::size_t i = 0; i < block.extremes.size(); ++i) {
        const int q = static_cast<int>(i);
        block.extremes.update(i, followed_, begin[q]);
        block.extremes.update(i, followed_, h, begin[q], middle[q], ends[q]);
      }
      block.values.swap(end_);
      block.rates.swap(rates_);
    }
  }
  followed_ = state.time;
}

// To the knots whose motions wait.
void ForceEnvelopes::follow() {
  if (times_.empty()) return;
  for (Block& block : blocks_) {
    block.quantities.evaluate<LinearQuantities::batch>(motions_, times_, plan_.motions, evaluated_);
    for (int q = 0; q < block.quantities.size(); ++q)
      block.extremes.update(static_cast<std::size_t>(q), followed_, times_, block.values[q], block.rates[q], evaluated_.col(q).data());
  }
  followed_ = times_.back();
  times_.clear();
}

void ForceEnvelopes::archive(Archive& archive) {
  follow();
  archive(followed_);
  archive(knot_);
  archive(knot_acceleration_);
  archive(largest_);
  archive(strayed_);
  archive(jumped_);
  for (Block& block : blocks_) {
    archive(block.values);
    archive(block.rates);
    archive(block.extremes);
  }
}

}  // namespace pounding
