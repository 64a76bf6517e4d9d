#include <pounding/recording/force_envelopes.hpp>

#include <algorithm>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include <pounding/recording/beyond_extremes.hpp>

namespace pounding {
namespace {

// Time increment for numerical differentiation of forces in members with large rotations.
constexpr double difference = 1e-7;  // [s]
// Fraction of a step over which spring forces are differentiated.
constexpr double spring_difference = 1e-6;

constexpr int batch = LinearQuantities::batch;

bool yields(const Structure& s) { return s.dimension > 1 && !s.yielding.empty(); }

}  // namespace

ForceEnvelopes::ForceEnvelopes(const Model& model, const GroundPlan& plan, const StepView& stepper, Results& results)
    : model_(model),
      plan_(plan),
      stepper_(stepper),
      results_(results),
      first_unknown_(offsets(model)),
      knots_(stepper) {
  linear_ = stepper.is_linear();
  motions_.setZero(Eigen::NoChange, stepper.system().size());
  if (linear_) coordinates_.setZero(stepper.base().size(), 2 * batch);
  const bool with_links = stepper.system().contact_count() > 0;
  for (const Link& link : model.links) every_step_ = every_step_ || (with_links && link.contact->is_rigid());
  int springs = 0;
  for (int k = 0; k < static_cast<int>(model.structures.size()); ++k) {
    const Structure& s = model.structures[k];
    first_spring_.push_back(springs);
    springs += static_cast<int>(s.yielding.size());
    yields_ = yields_ || yields(s);
    every_step_ = every_step_ || s.is_free || s.rigid_motions > 0;
    is_nonlinear_ = is_nonlinear_ || s.forces.nonlinear;
    if (s.dimension > 1) add_frame(k);
  }
  every_step_ = every_step_ || (is_nonlinear_ && yields_);
  if (!with_links && !model.links.empty()) {
    add_block(-1, false, approaches(model, plan));
    results_.approach = blocks_.back().extremes;
  }
}

void ForceEnvelopes::add_frame(int k) {
  const Structure& s = model_.structures[k];
  StructureEnvelope& envelope = results_.structures[k].envelope;
  if (s.has_storeys()) envelope.storey_shear = Extremes(s.floors.size() * results_.structures[k].storey_directions());
  envelope.member_force = Extremes(s.forces.members.size() * s.forces.components.size());
  envelope.reaction = Extremes(s.forces.supports.size() * s.forces.directions.size());
  const int components = static_cast<int>(s.forces.components.size()),
            shears = static_cast<int>(envelope.storey_shear.size());
  // By links that act on members between their ends: contribution of a unit force to the quantities.
  std::map<int, Eigen::VectorXd> added;
  for (int i = 0; stepper_.system().contact_count() > 0 && i < static_cast<int>(model_.links.size()); ++i) {
    const Link& link = model_.links[i];
    for (const auto& [end, sign] : {std::pair(&link.left, -1.0), std::pair(&link.right, 1.0)}) {
      if (end->structure != k || end->point.member < 0) continue;
      Eigen::VectorXd& by_force =
          added.try_emplace(i, Eigen::VectorXd::Zero(shears + s.forces.rows.rows())).first->second;
      const Eigen::Matrix<double, 12, 1> fixed = end->point.fixed_ends * (sign * link.direction);
      for (int j = 0; j < components; ++j)
        by_force[shears + end->point.member * components + j] += fixed[s.forces.places[j]];
      by_force.tail(end->point.reactions.rows()) += end->point.reactions * (sign * link.direction);
    }
  }
  const bool is_nonlinear = static_cast<bool>(s.forces.nonlinear);
  const auto loaded = [&](int quantity) {
    return is_nonlinear ||
           std::any_of(added.begin(), added.end(), [&](const auto& each) { return each.second[quantity] != 0; });
  };
  if (!is_nonlinear) add_block(k, false, internal_forces(model_, k, plan_, std::not_fn(loaded), true));
  if (!is_nonlinear && added.empty()) return;
  add_block(k, true, internal_forces(model_, k, plan_, loaded, false));
  const std::vector<LinearQuantities::Place>& places = blocks_.back().quantities.places();
  for (const auto& [link, by_force] : added) {
    FixedEnds made{link, static_cast<int>(blocks_.size()) - 1,
                   Eigen::SparseVector<double>(blocks_.back().quantities.size())};
    for (int row = 0; row < by_force.size(); ++row)
      if (by_force[row] != 0) made.by_force.coeffRef(places[row].at) = by_force[row];
    fixed_ends_.push_back(std::move(made));
  }
}

void ForceEnvelopes::add_block(int structure, bool loaded, LinearQuantities quantities) {
  const std::size_t count = static_cast<std::size_t>(quantities.size());
  blocks_.push_back({structure, loaded, std::move(quantities), {}, {}, Extremes(count)});
}

template <class Force>
void ForceEnvelopes::add_fixed_end_forces(const Block& block, Eigen::VectorXd& values, Force&& force) const {
  for (const FixedEnds& ends : fixed_ends_)
    if (&blocks_[ends.block] == &block) values += force(ends.link) * ends.by_force;
}

// Spring forces at one end of the last accepted step, and their one-sided rates.
void ForceEnvelopes::take_springs(double time, double other_end) {
  if (!yields_) return;
  spring_rates_.setZero(stepper_.system().spring_count());
  if (!acts_) {
    springs_ = spring_rates_;
    return;
  }
  stepper_.interpolate_springs(time, springs_);
  const double way = spring_difference * (other_end - time);
  if (way == 0) return;
  stepper_.interpolate_springs(time + way, spring_rates_);
  spring_rates_ = (spring_rates_ - springs_) / way;
}

// Adds the contributions of the yielding parts of the frame to the forces of a block, or to their rates.
void ForceEnvelopes::add_yielding(const Block& block, const Eigen::VectorXd& of_springs,
                                  Eigen::VectorXd& values) const {
  const auto parts = static_cast<Eigen::Index>(model_.structures[block.structure].yielding.size());
  block.quantities.add_yielding(of_springs.segment(first_spring_[block.structure], parts), values);
}

// For the motion in u_ and v_.
void ForceEnvelopes::evaluate(const Block& block, double time, Eigen::VectorXd& values, Eigen::VectorXd& rates) {
  motion_.resize(Eigen::NoChange, u_.size());
  motion_.row(0) = u_;
  motion_.row(1) = v_;
  block.quantities.evaluate<1>(motion_, std::span(&time, 1), plan_.motions, evaluated_once_);
  values.resize(block.quantities.size());
  rates.resize(block.quantities.size());
  values = evaluated_once_.row(0);
  rates = evaluated_once_.row(1);
  if (block.structure >= 0 && yields(model_.structures[block.structure])) {
    add_yielding(block, springs_, values);
    add_yielding(block, spring_rates_, rates);
  }
  if (block.structure < 0 || !model_.structures[block.structure].forces.nonlinear) return;
  const Structure& s = model_.structures[block.structure];
  Eigen::VectorXd q = u_.segment(first_unknown_[block.structure], s.size());
  if (s.at_rest.size() > 0) q += s.at_rest;
  const int first = first_unknown_[block.structure];
  const auto forces_at = [&](const Eigen::VectorXd& at, double when) {
    const Eigen::VectorXd in_members = stepper_.member_forces(first, when);
    Eigen::VectorXd forces(values.size());
    forces << s.storey_shears(at, in_members), s.forces.nonlinear(at, in_members);
    return forces;
  };
  const Eigen::VectorXd forces = forces_at(q, time);
  values += forces;
  rates += (forces_at(q + difference * v_.segment(first, s.size()), time + difference) - forces) / difference;
}

// From the motion in u_ and v_.
void ForceEnvelopes::start_from(const Instant& instant) {
  for (Block& block : blocks_) evaluate(block, instant.time, block.values, block.rates);
  followed_ = instant.time;
  knots_.set(instant);
}

void ForceEnvelopes::begin() {
  if (blocks_.empty()) return;
  u_ = stepper_.state().u;
  v_ = stepper_.state().v;
  take_springs(stepper_.time(), stepper_.time());
  start_from(stepper_.instant_end_minus());
  for (Block& block : blocks_) {
    Eigen::VectorXd values = block.values;
    add_fixed_end_forces(block, values, [&](int link) { return stepper_.link_forces()[link]; });
    for (std::size_t i = 0; i < block.extremes.size(); ++i)
      block.extremes.update(i, stepper_.time(), values[static_cast<int>(i)]);
  }
}

void ForceEnvelopes::step(const StepMotion& step) {
  if (blocks_.empty()) return;
  const Instant &begin = stepper_.instant_begin(), &end = stepper_.instant_end_minus();
  const bool pressed = presses_on_members();
  acts_ = yields_ && parts_act();
  if (every_step_) {
    take_begin(step);
    start_from(begin);
  } else if (is_nonlinear_) {
    if (!pressed && step.h > 0) {
      const double middle = step.begin_time + 0.5 * step.h;
      stepper_.interpolate(middle, u_, v_);
      close(begin, middle, false);
    }
  } else {
    const bool changes = std::any_of(blocks_.begin(), blocks_.end(),
                                     [&](const Block& block) { return block.apart != is_apart(block, pressed); });
    if (begin.time > knots_.last() && (changes || jumped_ || !knots_.reach_over_step())) {
      if (!linear_) stepper_.begin(u_, v_);
      wait(begin);
    }
    if (changes) follow();
    for (Block& block : blocks_) block.apart = is_apart(block, pressed);
    jumped_ = step.jumps;
    if (std::none_of(blocks_.begin(), blocks_.end(), std::mem_fn(&Block::apart))) return;
    if (acts_) take_begin(step);
    for (Block& block : blocks_)
      if (acts_ && block.apart) evaluate(block, begin.time, block.values, block.rates);
  }
  if (every_step_) stepper_.end_minus();  // updates the whole state with which the next step begins
  stepper_.end_minus(u_, v_);
  take_springs(end.time, begin.time);
  if (every_step_ || is_nonlinear_) return close(end, end.time, pressed);
  for (Block& block : blocks_)
    if (block.apart) follow(block, begin.time, end.time, pressed);
}

// Motion at the start of a step, and spring forces. Rates jump if a step ends at a corner; those of this step are used.
void ForceEnvelopes::take_begin(const StepMotion& step) {
  const double begin = stepper_.instant_begin().time;
  stepper_.begin(u_, v_);
  if (acts_ && step.h > 0) stepper_.interpolate(begin, u_, v_);
  take_springs(begin, stepper_.instant_end_minus().time);
}

void ForceEnvelopes::end() {
  const Instant& last = stepper_.instant_end_minus();
  if (!blocks_.empty() && last.time > knots_.last()) {
    if (!linear_) stepper_.end_minus(u_, v_);
    wait(last);
  }
  show();
}

void ForceEnvelopes::show() {
  follow();
  for (const Block& block : blocks_) {
    auto place = block.quantities.places().begin();
    const auto copy = [&](Extremes& to) {
      for (std::size_t i = 0; i < to.size(); ++i, ++place)
        if (place->at >= 0) to.copy(i, block.extremes, static_cast<std::size_t>(place->at), place->opposite ? -1 : 1);
    };
    if (block.structure < 0) {
      copy(results_.approach);
      continue;
    }
    StructureEnvelope& envelope = results_.structures[block.structure].envelope;
    for (Extremes* extremes : {&envelope.storey_shear, &envelope.member_force, &envelope.reaction}) copy(*extremes);
  }
}

bool ForceEnvelopes::is_apart(const Block& block, bool pressed) const {
  return (pressed && block.loaded) || (acts_ && block.structure >= 0 && yields(model_.structures[block.structure]));
}

bool ForceEnvelopes::presses_on_members() const {
  return std::any_of(fixed_ends_.begin(), fixed_ends_.end(), [&](const FixedEnds& ends) {
    const LinkStep& step = stepper_.link_step(ends.link);
    return step.force_begin != 0 || step.force_middle != 0 || step.force_end != 0;
  });
}

// True if parts of frames contribute to the forces in the last accepted step; parts contribute only after they yield.
bool ForceEnvelopes::parts_act() const {
  const int contacts = stepper_.system().contact_count();
  for (std::size_t k = 0; k < first_spring_.size(); ++k) {
    if (!yields(model_.structures[k])) continue;
    const int first = contacts + static_cast<int>(first_spring_[k]),
              count = static_cast<int>(model_.structures[k].yielding.size());
    if (stepper_.springs_stayed()) {
      if (!stepper_.instant_end_minus().force.segment(first, count).isZero(0)) return true;
      continue;
    }
    const auto from = stepper_.link_steps().begin() + first;
    const auto acts = [](const LinkStep& step) {
      return step.force_begin != 0 || step.force_middle != 0 || step.force_end != 0;
    };
    if (std::any_of(from, from + count, acts)) return true;
  }
  return false;
}

// For the motion in u_ and v_ at `time`; `instant` is the nearest one of the step.
void ForceEnvelopes::close(const Instant& instant, double time, bool pressed) {
  if (!(time > knots_.last())) return;
  for (Block& block : blocks_) follow(block, followed_, time, pressed);
  followed_ = time;
  knots_.set(instant);
}

// For the motion in u_ and v_, unless it follows from the instant.
void ForceEnvelopes::wait(const Instant& instant) {
  const int at = static_cast<int>(times_.size());
  if (linear_) {
    coordinates_.col(at) = instant.motion.col(Instant::u);
    coordinates_.col(batch + at) = instant.motion.col(Instant::v);
  } else {
    motions_.row(at) = u_;
    motions_.row(batch + at) = v_;
  }
  times_.push_back(instant.time);
  if (times_.size() == LinearQuantities::batch) follow();
  knots_.set(instant);
}

// Up to the motion in u_ and v_, while contacts may act on members.
void ForceEnvelopes::follow(Block& block, double begin_time, double end_time, bool pressed) {
  const double h = end_time - begin_time;
  evaluate(block, end_time, end_, rates_);
  if (!pressed || !block.loaded) {
    for (int q = 0; q < block.quantities.size(); ++q)
      block.extremes.update(static_cast<std::size_t>(q), begin_time, h, block.values[q], block.rates[q], end_[q],
                            rates_[q]);
  } else {
    Eigen::VectorXd begin = block.values, middle = 0.5 * (block.values + end_) + h / 8 * (block.rates - rates_),
                    ends = end_;
    add_fixed_end_forces(block, begin, [&](int link) { return stepper_.link_step(link).force_begin; });
    add_fixed_end_forces(block, middle, [&](int link) { return stepper_.link_step(link).force_middle; });
    add_fixed_end_forces(block, ends, [&](int link) { return stepper_.link_step(link).force_end; });
    for (std::size_t i = 0; i < block.extremes.size(); ++i) {
      const int q = static_cast<int>(i);
      block.extremes.update(i, begin_time, begin[q]);
      block.extremes.update(i, begin_time, h, begin[q], middle[q], ends[q]);
    }
  }
  block.values.swap(end_);
  block.rates.swap(rates_);
}

// Up to the pending knots. Blocks evaluated in every step are already further.
void ForceEnvelopes::follow() {
  if (times_.empty()) return;
  const int count = static_cast<int>(times_.size());
  // Between two knots a cubic deviates from the values by at most a third of the interval times the rates.
  Eigen::Array<double, batch, 1> third = Eigen::Array<double, batch, 1>::Zero();
  const double third_begin = (times_.front() - followed_) / 3;
  third[0] = third_begin;
  for (int i = 1; i < count; ++i) {
    third[i] = (times_[i] - times_[i - 1]) / 3;
    third[i - 1] = std::max(third[i - 1], third[i]);
  }
  // Rows without a knot repeat the last one.
  const auto repeat_last = [&](auto&& motion) {
    for (int i = count; i < batch; ++i) {
      motion(i) = motion(count - 1);
      motion(batch + i) = motion(batch + count - 1);
    }
  };
  if (linear_) {
    repeat_last([&](int i) { return coordinates_.col(i); });
    motions_ = stepper_.base().physical(coordinates_).transpose();
  } else {
    repeat_last([&](int i) { return motions_.row(i); });
  }
  times_.resize(batch, times_.back());
  const std::span<const double> times(times_.data(), count);
  for (Block& block : blocks_) {
    if (block.apart) continue;
    block.quantities.evaluate<batch>(motions_, times_, plan_.motions, evaluated_);
    find_beyond({evaluated_, block.values, block.rates, third, third_begin}, block.extremes, beyond_);
    for (const int q : beyond_) {
      const double* const values = evaluated_.col(q).data();
      block.extremes.update(static_cast<std::size_t>(q), followed_, times, block.values[q], block.rates[q], values,
                            values + batch);
    }
    block.values = evaluated_.row(batch - 1);
    block.rates = evaluated_.row(2 * batch - 1);
  }
  followed_ = times_.back();
  times_.clear();
}

void ForceEnvelopes::archive(Archive& archive) {
  follow();
  knots_.archive(archive);
  archive(followed_, jumped_);
  for (Block& block : blocks_) {
    archive(block.values, block.rates, block.extremes, block.apart);
  }
}

}  // namespace pounding
