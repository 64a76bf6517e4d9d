#include <pounding/recording/spring_histories.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <pounding/recording/headings.hpp>
#include <pounding/recording/histories.hpp>
#include <pounding/structures/storey_heights.hpp>

namespace pounding {
namespace {

// True if the range extends beyond the extremes.
bool exceeds(const Extremes& extremes, std::size_t i, double low, double high) {
  return low < extremes.min[i] || high > extremes.max[i];
}

// First fraction of a step (0 to 1) at which the deformation exceeds a limit, on the cubic through its ends; 2 if there
// is none.
double first_beyond(const LinkStep& step, const YieldLimits& limits) {
  const CubicPenetration between(step.motion_begin, step.motion_end, step.end - step.begin);
  const bool turns = step.motion_begin.rate * step.motion_end.rate < 0;
  double beyond = limits.exceeded_by(step.motion_end.penetration) ? 1 : 2;
  if (turns)
    if (const double s = std::clamp(between.turn(), 0.0, 1.0); limits.exceeded_by(between.at(s))) beyond = s;
  if (beyond > 1) return beyond;
  double low = 0, high = beyond;
  while (high - low > 1e-12) (limits.exceeded_by(between.at(0.5 * (low + high))) ? high : low) = 0.5 * (low + high);
  return high;
}

void find_first_yield(SpringHistory& history, std::size_t i, const LinkStep& step) {
  if (const double s = first_beyond(step, history.limits[i]); s <= 1)
    history.first_yield[i] = step.begin + s * (step.end - step.begin);
}

// Peaks of a force that curves sharply inside a step.
void update_by_pieces(const LinkSet& links, int link, const LinkStep& step, double stiffness, std::size_t part,
                      Extremes& forces) {
  constexpr int pieces = 16;
  const double h = (step.end - step.begin) / pieces;
  const auto force = [&](double s) {
    const double d = interpolate(step, s).penetration;
    return stiffness * d + links.inside(link, step, s, d).force;
  };
  double last = force(0);
  for (int j = 0; j < pieces; ++j) {
    const double next = force((j + 1.0) / pieces);
    forces.update(part, step.begin + j * h, h, last, force((j + 0.5) / pieces), next);
    last = next;
  }
}

// Records that a part moves monotonically to a deformation; `on_top` is its force in addition to K u. A damper without
// a spring has no stiffness. The plastic part of a cable is its yielded elongation, without the slack.
void reach(SpringHistory& history, const YieldingPart& part, std::size_t i, double assembled, double deformation,
           double on_top) {
  if (const double k = history.stiffness[i]; k > 0) {
    const double inelastic = ((k - assembled) * deformation - on_top) / k;
    const bool is_cable = part.law.starts_with("restrainer");
    const double plastic = is_cable ? inelastic - part.parameter("slack") : std::abs(inelastic);
    history.plastic[i] = std::max(history.plastic[i], plastic);
  }
  history.cycles.follow(i, deformation, history.limits[i]);
}

}  // namespace

SpringHistories::SpringHistories(const Model& model, const FloorResponse& response, const StepView& stepper,
                                 std::vector<StructureHistory>& histories)
    : model_(model), response_(response), stepper_(stepper), histories_(histories) {
  std::size_t link = stepper.system().contact_count();
  for (std::size_t k = 0; k < model.structures.size(); ++k) {
    const Structure& s = model.structures[k];
    histories_[k].springs = spring_heading(s);
    first_.push_back(link);
    link += s.yielding.size();
    for (const YieldingPart& part : s.yielding) assembled_.push_back(part.stiffness());
    if (s.members_that_yield() == 0 || s.storey_stiffness.empty()) continue;
    StoreyDamping damping{static_cast<int>(k), response.row(static_cast<int>(k), 0, 0), s.whole_damping(), {}};
    for (int i = s.size() - 2; i >= 0; --i) damping.by_velocity.row(i) += damping.by_velocity.row(i + 1);
    for (const YieldingPart& part : s.yielding)
      if (!part.is_device()) damping.yield_force.push_back(part.stiffness() * part.yield_deformation());
    dampings_.push_back(std::move(damping));
  }
}

template <class Visit>
void SpringHistories::visit_parts(Visit&& visit) {
  for (std::size_t k = 0; k < first_.size(); ++k)
    for (std::size_t i = 0; i < model_.structures[k].yielding.size(); ++i) visit(static_cast<int>(k), i);
}

void SpringHistories::begin() {
  for (std::size_t k = 0; k < first_.size(); ++k) {
    SpringHistory& history = histories_[k].springs;
    const auto values =
        static_cast<std::size_t>(model_.analysis.duration / model_.analysis.output_step + 2) * history.size();
    for (std::vector<double>* all : {&history.deformation, &history.force, &history.hysteretic}) all->reserve(values);
  }
  visit_parts([&](int k, std::size_t i) {
    SpringHistory& history = histories_[k].springs;
    const int link = static_cast<int>(first_[k] + i);
    const double d = stepper_.link_motion(link).penetration, time = stepper_.time();
    history.last[i] = d;
    history.deformations.update(i, time, d);
    history.forces.update(i, time, assembled(k, i) * d + stepper_.link_forces()[link]);
    const YieldingPart& part = model_.structures[k].yielding[i];
    const double strained = resultant(*part.element, part.direction, [&](int j) {
                              return stepper_.link_motion(link - part.direction + j);
                            }).penetration;
    if (!part.has_spring()) history.resultants.update(i, time, strained);
    if (history.limits[i].exceeded_by(strained)) history.first_yield[i] = time;
    reach(history, part, i, assembled(k, i), d, stepper_.link_forces()[link]);
  });
}

void SpringHistories::step() {
  if (assembled_.empty()) return;
  if (stepper_.springs_stayed())
    stay();
  else
    visit_parts([&](int k, std::size_t i) { step_part(k, i); });
  stayed_ = stepper_.springs_stayed();
  for (const StoreyDamping& damping : dampings_) step_damping(damping);
}

SpringHistories::Quiet SpringHistories::quiet(int k, std::size_t i) const {
  const SpringHistory& history = histories_[k].springs;
  Quiet range{history.deformations.min[i], history.deformations.max[i]};
  const auto narrow = [&](double low, double high) { range = {std::max(range.low, low), std::min(range.high, high)}; };
  const double stiffness = assembled(k, i), on_top = stepper_.link_forces()[static_cast<int>(first_[k] + i)];
  if (stiffness > 0) narrow((history.forces.min[i] - on_top) / stiffness, (history.forces.max[i] - on_top) / stiffness);
  const YieldLimits& limits = history.limits[i];
  const double both = limits.positive + limits.negative, count = history.cycles.swings[i],
               turn = history.cycles.turn[i];
  if (count == 0 || std::isnan(history.first_yield[i])) narrow(-limits.negative, limits.positive);
  if (count > 0) narrow(turn - both, turn);
  if (count < 0) narrow(turn, turn + both);
  const double rounding = 1e-12 * (std::abs(range.low) + std::abs(range.high));
  return {range.low + rounding, range.high - rounding};
}

// A step in which no spring changed its force.
void SpringHistories::stay() {
  // Devices between structures follow the parts.
  const Eigen::MatrixXd& paths = stepper_.spring_paths();
  const double *const begin = paths.data(), *const end = begin + paths.rows(), *const minimum = end + paths.rows(),
                      *const maximum = minimum + paths.rows();
  quiet_.resize(assembled_.size(), {1, -1});
  std::size_t at = 0;
  for (std::size_t k = 0; k < first_.size(); ++k) {
    double* const last = histories_[k].springs.last.data();
    for (std::size_t i = 0, count = model_.structures[k].yielding.size(); i < count; ++i, ++at) {
      // The parabola of the force deviates from the cubic of the deformation by less than a quarter of the change.
      const double away = 0.25 * std::abs(end[at] - begin[at]);
      last[i] = end[at];
      if (stayed_ && minimum[at] - away > quiet_[at].low && maximum[at] + away < quiet_[at].high) continue;
      step_part(static_cast<int>(k), i);
      quiet_[at] = quiet(static_cast<int>(k), i);
    }
  }
}

void SpringHistories::step_part(int k, std::size_t i) {
  SpringHistory& history = histories_[k].springs;
  const LinkSet& links = stepper_.links();
  const int link = static_cast<int>(first_[k] + i);
  const LinkStep& step = stepper_.link_step(link);
  const double h = step.end - step.begin, stiffness = assembled(k, i);
  const LinkMotion &begin = step.motion_begin, &end = step.motion_end;
  // A cubic deviates from its ends by at most a third of the step times the rates, a parabola by at most a quarter of
  // the change. This skips steps without new extremes.
  const double at_begin = h / 3 * std::abs(begin.rate), at_end = h / 3 * std::abs(end.rate);
  const double low = std::min(begin.penetration - at_begin, end.penetration - at_end);
  const double high = std::max(begin.penetration + at_begin, end.penetration + at_end);
  if (exceeds(history.deformations, i, low, high))
    history.deformations.update(i, step.begin, h, begin.penetration, begin.rate, end.penetration, end.rate);
  const double f0 = stiffness * begin.penetration + step.force_begin, f1 = stiffness * end.penetration + step.force_end;
  const double fm = stiffness * step.motion_middle.penetration + step.force_middle, away = 0.25 * std::abs(f1 - f0);
  const YieldingPart& part = model_.structures[k].yielding[i];
  if (part.has_spring() && part.spring().bends_sharply(step))
    update_by_pieces(links, link, step, stiffness, i, history.forces);
  else if (exceeds(history.forces, i, std::min(fm, f1) - away, std::max(fm, f1) + away))
    history.forces.update(i, step.begin, h, f0, fm, f1);
  if (begin.rate * end.rate < 0) {
    const CubicPenetration between(begin, end, h);
    if (const double s = between.turn(); s > 0 && s < 1)
      reach(history, part, i, stiffness, between.at(s), links.inside(link, step, s, between.at(s)).force);
  }
  reach(history, part, i, stiffness, end.penetration, step.force_end);
  history.last[i] = end.penetration;
  history.lost[i] = links.lost(link);
  if (!part.has_spring())
    step_resultant(history, part, i, link - part.direction);
  else if (const YieldLimits& limits = history.limits[i];
           std::isnan(history.first_yield[i]) && (limits.exceeded_by(low) || limits.exceeded_by(high)))
    find_first_yield(history, i, step);
}

// The resultant is between its values and rates at the ends of the step. `first` is the first link of the element.
void SpringHistories::step_resultant(SpringHistory& history, const YieldingPart& part, std::size_t i, int first) {
  LinkStep step = stepper_.link_step(first);
  step.motion_begin =
      resultant(*part.element, part.direction, [&](int j) { return stepper_.link_step(first + j).motion_begin; });
  step.motion_end =
      resultant(*part.element, part.direction, [&](int j) { return stepper_.link_step(first + j).motion_end; });
  const LinkMotion &begin = step.motion_begin, &end = step.motion_end;
  history.resultants.update(i, step.begin, step.end - step.begin, begin.penetration, begin.rate, end.penetration,
                            end.rate);
  if (std::isnan(history.first_yield[i])) find_first_yield(history, i, step);
}

// Velocities are almost linear in a step; where they reverse, the cubic through both ends gives the extreme.
void SpringHistories::step_damping(const StoreyDamping& damping) {
  const int floors = static_cast<int>(damping.by_velocity.cols()),
            storeys = static_cast<int>(damping.yield_force.size());
  const OutputQuantities &begin = stepper_.outputs_begin(), &end = stepper_.outputs_end_minus();
  const auto shears = [&](const OutputQuantities& at, int column) -> Eigen::VectorXd {
    return damping.by_velocity * at.motion.col(column).segment(damping.first_row, floors);
  };
  const Eigen::VectorXd f0 = shears(begin, 1), r0 = shears(begin, 2), f1 = shears(end, 1), r1 = shears(end, 2);
  Extremes extremes(storeys);
  std::vector<double>& largest = histories_[damping.structure].springs.damping_shear;
  for (int i = 0; i < storeys; ++i) {
    extremes.update(i, begin.time, end.time - begin.time, f0[i], r0[i], f1[i], r1[i]);
    largest[i] = std::max(largest[i], extremes.peak(i) / damping.yield_force[i]);
  }
}

void SpringHistories::sample(double time, bool inside) {
  const bool stayed = stepper_.springs_stayed();
  if (inside && stayed) {
    const double begin = stepper_.instant_begin().time, end = stepper_.instant_end_minus().time;
    stepper_.deformations((time - begin) / (end - begin), deformations_);
  }
  visit_parts([&](int k, std::size_t i) {
    SpringHistory& history = histories_[k].springs;
    const int link = static_cast<int>(first_[k] + i);
    double on_top = stepper_.link_forces()[link], lost = stayed ? history.lost[i] : stepper_.links().lost(link), d = 0;
    if (!inside) {
      d = stepper_.link_motion(link).penetration;
    } else if (stayed) {
      d = deformations_[static_cast<Eigen::Index>(place(k, i))];
    } else {
      const LinkStep& step = stepper_.link_step(link);
      const double s = (time - step.begin) / (step.end - step.begin);
      d = interpolate(step, s).penetration;
      const Spring::Instant instant = stepper_.links().inside(link, step, s, d);
      on_top = instant.force;
      lost = instant.lost;
    }
    history.deformation.push_back(d);
    history.force.push_back(assembled(k, i) * d + on_top);
    history.hysteretic.push_back(lost);
  });
}

void SpringHistories::summarize(int k, StructureSummary& summary) const {
  summary.springs = summaries(histories_[k].springs);
  if (summary.springs.empty()) return;
  const Structure& s = model_.structures[k];
  Eigen::MatrixXd motion = stepper_.outputs().motion;
  response_.complete(motion, stepper_.time(),
                     Eigen::VectorXd::Zero(static_cast<Eigen::Index>(stepper_.ground().size())));
  const bool in_plan = response_.directions(k) > 1;
  std::array<double, 2> below{};
  for (int i = 0; i < static_cast<int>(s.floors.size()); ++i) {
    const int row = response_.row(k, i, 0);
    const std::array<double, 2> at{motion(row, 0), in_plan ? motion(row + 1, 0) : 0};
    summary.residual_displacement.push_back(in_plan ? std::hypot(at[0], at[1]) : at[0]);
    if (s.has_storeys())
      summary.residual_drift.push_back(in_plan ? std::hypot(at[0] - below[0], at[1] - below[1]) : at[0] - below[0]);
    below = at;
  }
  const std::vector<double> heights = storey_heights(s);
  for (std::size_t i = 0; i < heights.size(); ++i)
    summary.residual_drift_ratio.push_back(std::abs(summary.residual_drift[i]) / heights[i]);
}

void SpringHistories::archive(Archive& archive) {
  for (StructureHistory& structure : histories_) archive(structure.springs);
}

}  // namespace pounding
