#include <pounding/run/link_samples.hpp>

#include <cmath>
#include <span>

#include <pounding/run/histories.hpp>

namespace pounding {
namespace {

// Samples are dense enough for a straight line between them to miss the force by no more than this part of the peak force.
constexpr double max_chord_error = 1e-4;
constexpr int max_depth = 5;  // halvings of half a step

// Work in the second half of a step: the integral of the parabola through the power at both ends and the middle [J].
double work_of_second_half(const LinkStep& step) {
  const double begin = step.force_begin * step.motion_begin.rate, middle = step.force_middle * step.motion_middle.rate,
               end = step.force_end * step.motion_end.rate;
  return (step.end - step.begin) / 24 * (5 * end + 8 * middle - begin);
}

// Work in the part of a step after s, from 0 to 1, by the same parabola [J].
double work_after(const LinkStep& step, double s) {
  const double begin = step.force_begin * step.motion_begin.rate, middle = step.force_middle * step.motion_middle.rate,
               end = step.force_end * step.motion_end.rate;
  // Power begin + slope x + bend x^2.
  const double bend = 2 * (begin - 2 * middle + end), slope = end - begin - bend;
  return (step.end - step.begin) * (begin * (1 - s) + slope / 2 * (1 - s * s) + bend / 3 * (1 - s * s * s));
}

LinkHistory heading(const Link& link, const Model& model) {
  LinkHistory history;
  history.name = link.name;
  history.gap = link.gap;
  history.law = link.law;
  history.left = {model.structures[link.left.structure].name, link.left.floor + 1, link.left.label};
  history.right = {model.structures[link.right.structure].name, link.right.floor + 1, link.right.label};
  // A frame has a place of its own; the other structures stand where their links are.
  const bool only_right_has_place = model.structures[link.left.structure].geometry.positions.empty() &&
                                    !model.structures[link.right.structure].geometry.positions.empty();
  const Eigen::Vector3d& position = (only_right_has_place ? link.right : link.left).point.position;
  for (int i = 0; i < 3; ++i) {
    history.position[i] = position[i];
    history.direction[i] = link.direction[i];
  }
  return history;
}

void append(const LinkSample& s, LinkHistory& history) {
  history.time.push_back(s.time);
  history.penetration.push_back(s.penetration);
  history.velocity.push_back(s.velocity);
  history.force.push_back(s.force);
  history.energy.push_back(s.energy);
  history.friction.insert(history.friction.end(), s.friction.begin(), s.friction.begin() + history.tangents);
}

void cut(LinkHistory& history, std::size_t length) {
  cut_columns(history, length);
  history.friction.resize(length * history.tangents);
}

}  // namespace

void ImpactSamples::begin_pressed(const LinkSample& sample) {
  last_ = sample;
  samples_.push_back(sample);
}

void ImpactSamples::add(const LinkSample& sample) {
  last_ = sample;
  if (samples_.empty()) samples_.push_back({sample.time, sample.penetration, sample.velocity, 0, sample.energy, {}});
  if (++skipped_ < stride_) return;
  skipped_ = 0;
  samples_.push_back(last_);
  if (samples_.size() < max_count) return;
  // The first two stay: they are the two sides of a jump at the touch.
  for (std::size_t i = 1; 2 * i - 1 < samples_.size(); ++i) samples_[i] = samples_[2 * i - 1];
  samples_.resize(samples_.size() / 2 + 1);
  stride_ *= 2;
}

void ImpactSamples::show(LinkHistory& history) const {
  for (const LinkSample& sample : samples_) append(sample, history);
  if (!samples_.empty() && samples_.back().time < last_.time) append(last_, history);
}

void ImpactSamples::finish(LinkHistory& history) {
  show(history);
  samples_.clear();
  stride_ = 1;
  skipped_ = 0;
}

void ImpactSamples::archive(Archive& archive) {
  archive(samples_);
  archive(last_);
  archive(stride_);
  archive(skipped_);
}

LinkSamples::LinkSamples(const Model& model, const Stepper& stepper, std::vector<LinkHistory>& histories)
    : model_(model), stepper_(stepper), histories_(histories) {
  if (stepper.system().contact_count() == 0) return;
  for (const Link& link : model.links) histories_.push_back(heading(link, model));
  impacts_.resize(model.links.size());
  first_tangent_.assign(model.links.size(), -1);
  for (const Friction& friction : stepper.system().frictions) {
    histories_[friction.contact].tangents = friction.count;
    first_tangent_[friction.contact] = friction.first;
  }
}

std::array<double, 2> LinkSamples::friction(std::size_t link, double LinkStep::*force) const {
  std::array<double, 2> forces{};
  for (int j = 0; j < histories_[link].tangents; ++j) forces[j] = stepper_.link_step(static_cast<int>(first_tangent_[link] + j)).*force;
  return forces;
}

// Between s and e, parts of a step from 0 to 1 with these forces at them: samples wherever a straight line would miss the force.
void LinkSamples::add_between(std::size_t link, const LinkStep& step, double s, double force_s, double e, double force_e, int depth) {
  const Contact& contact = *model_.links[link].contact;
  const double mid = 0.5 * (s + e);
  const LinkMotion motion = interpolate(step, mid);
  const double force = contact.acting_force(contact.evaluate(motion).force);
  if (std::abs(force - 0.5 * (force_s + force_e)) <= max_chord_error * contact.impacts().back().peak_force) return;
  if (depth > 1) add_between(link, step, s, force_s, mid, force, depth - 1);
  LinkSample sample{step.begin + mid * (step.end - step.begin), motion.penetration, motion.rate, force,
                    contact.work() - work_after(step, mid), {}};
  for (int j = 0; j < histories_[link].tangents; ++j)
    sample.friction[j] = force_inside(stepper_.link_step(static_cast<int>(first_tangent_[link] + j)), mid);
  impacts_[link].add(sample);
  if (depth > 1) add_between(link, step, mid, force, e, force_e, depth - 1);
}

void LinkSamples::step(bool output_due) {
  for (std::size_t i = 0; i < impacts_.size(); ++i) {
    const Contact& contact = *model_.links[i].contact;
    const LinkStep& step = stepper_.link_step(static_cast<int>(i));
    const std::span<const ImpactRow> rows = contact.impacts();
    const bool begun = !rows.empty();
    const bool presses = begun && std::isnan(rows.back().t_end);
    const bool ends_here = begun && !presses && rows.back().t_end >= step.end;
    ImpactSamples& impact = impacts_[i];
    const LinkMotion &middle = step.motion_middle, &end = step.motion_end;
    if (presses || ends_here) {
      if (impact.empty() && model_.links[i].preload && rows.size() == 1)
        impact.begin_pressed({step.begin, step.motion_begin.penetration, step.motion_begin.rate, step.force_begin,
                              contact.work() - work_after(step, 0), friction(i, &LinkStep::force_begin)});
      if (step.force_middle != 0) {
        // A step is as long as its error allows. The law can be asked again unless its memory has moved in this step.
        const bool known = contact.acting_force(contact.evaluate(middle).force) == step.force_middle;
        if (known) add_between(i, step, 0, step.force_begin, 0.5, step.force_middle, max_depth);
        impact.add({0.5 * (step.begin + step.end), middle.penetration, middle.rate, step.force_middle,
                    contact.work() - work_of_second_half(step), friction(i, &LinkStep::force_middle)});
        if (known) add_between(i, step, 0.5, step.force_middle, 1, step.force_end, max_depth);
      }
      // A located end lies behind the true one by the round-off of the motion, and there the formula of the law would pull.
      const double force = contact.acting_force(presses ? stepper_.link_forces()[static_cast<int>(i)] : step.force_end);
      impact.add({step.end, end.penetration, end.rate, force, contact.work(), friction(i, &LinkStep::force_end)});
    }
    if (presses) continue;
    impact.finish(histories_[i]);
    if (ends_here || output_due) append({step.end, end.penetration, end.rate, 0, contact.work(), {}}, histories_[i]);
  }
}

void LinkSamples::end() {
  for (std::size_t i = 0; i < impacts_.size(); ++i) impacts_[i].finish(histories_[i]);
}

void LinkSamples::show_unfinished() {
  lengths_.clear();
  for (std::size_t i = 0; i < impacts_.size(); ++i) {
    lengths_.push_back(histories_[i].time.size());
    impacts_[i].show(histories_[i]);
  }
}

void LinkSamples::hide_unfinished() {
  for (std::size_t i = 0; i < impacts_.size(); ++i) cut(histories_[i], lengths_[i]);
}

void LinkSamples::archive(Archive& archive) {
  archive(impacts_);
  for (LinkHistory& history : histories_) {
    archive_length(archive, history);
    history.friction.resize(history.time.size() * history.tangents);
  }
}

}  // namespace pounding
