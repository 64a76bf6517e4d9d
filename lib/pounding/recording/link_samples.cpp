#include <pounding/recording/link_samples.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include <pounding/recording/headings.hpp>
#include <pounding/recording/histories.hpp>

namespace pounding {
namespace {

// Samples are dense enough that linear interpolation misses the force by at most this fraction of the peak force, and
// the peak itself is a sample. Plots show no difference, and samples ten times closer would triple the size of a file
// with many impacts.
constexpr double max_chord_error = 1e-3;
constexpr int max_depth = 5;  // bisections of half a step

// Power of a link in a step: the parabola through its values at both ends and the midpoint.
class LinkPower {
 public:
  explicit LinkPower(const LinkStep& step) noexcept
      : h_(step.end - step.begin),
        begin_(step.force_begin * step.motion_begin.rate),
        middle_(step.force_middle * step.motion_middle.rate),
        end_(step.force_end * step.motion_end.rate),
        bend_(2 * (begin_ - 2 * middle_ + end_)),
        slope_(end_ - begin_ - bend_) {}

  /// Work between s (0 to 1) and the end of the step [J].
  double work_after(double s) const noexcept {
    return h_ * (begin_ * (1 - s) + slope_ / 2 * (1 - s * s) + bend_ / 3 * (1 - s * s * s));
  }
  /// Work in the second half of the step [J].
  double work_of_second_half() const noexcept { return h_ / 24 * (5 * end_ + 8 * middle_ - begin_); }

 private:
  double h_, begin_, middle_, end_, bend_, slope_;
};

// True if straight lines from the ends of a step to its midpoint may miss the force. Their error is a quarter of that
// of a single line, except at an inflection. There the force is steep, and its third derivative cannot cause that if
// the force changes by less than a fifth.
bool bends(const LinkStep& step, double peak_force) {
  return std::abs(step.force_middle - 0.5 * (step.force_begin + step.force_end)) > 2 * max_chord_error * peak_force ||
         std::abs(step.force_end - step.force_begin) > 0.2 * peak_force;
}

void append(std::span<const LinkSample> samples, LinkHistory& history) {
  const auto add = [samples](std::vector<double>& column, double LinkSample::* value) {
    std::ranges::transform(samples, std::back_inserter(column), value);
  };
  add(history.time, &LinkSample::time);
  add(history.penetration, &LinkSample::penetration);
  add(history.velocity, &LinkSample::velocity);
  add(history.force, &LinkSample::force);
  add(history.energy, &LinkSample::energy);
  if (history.tangents == 0) return;
  for (const LinkSample& s : samples)
    history.friction.insert(history.friction.end(), s.friction.begin(), s.friction.begin() + history.tangents);
}

void append(const LinkSample& sample, LinkHistory& history) { append(std::span(&sample, 1), history); }

}  // namespace

// A step of a link in contact, from which interior samples are taken.
struct LinkSamples::Inside {
  std::size_t link;
  const LinkStep& step;
  const LinkSet& links;
  double allowed;  // allowed error of linear interpolation [N]
  Quintic path = pounding::path(step);
  LinkPower power{step};
  double work_at_end = links.of_contact(static_cast<int>(link)).log.work();

  // The force of the law, without tension unless it may pull [N].
  double force(const LinkMotion& motion) const {
    const int number = static_cast<int>(link);
    return links.contact(number).acting_force(links.law(number, motion).force);
  }

  double work(double s) const { return work_at_end - power.work_after(s); }
};

void ImpactSamples::begin_pressed(const LinkSample& sample) { samples_.push_back(sample); }

void ImpactSamples::add(const LinkSample& sample) {
  if (samples_.empty()) samples_.push_back({sample.time, sample.penetration, sample.velocity, 0, sample.energy, {}});
  if (++skipped_ < stride_) {
    last_ = sample;
    return;
  }
  skipped_ = 0;
  samples_.push_back(sample);
  if (samples_.size() < max_count) return;
  // The first two samples are kept: they are the two sides of a jump at the touch.
  for (std::size_t i = 1; 2 * i - 1 < samples_.size(); ++i) samples_[i] = samples_[2 * i - 1];
  samples_.resize(samples_.size() / 2 + 1);
  stride_ *= 2;
}

void ImpactSamples::show(LinkHistory& history) const {
  append(samples_, history);
  if (!samples_.empty() && samples_.back().time < last_.time) append(last_, history);
}

void ImpactSamples::finish(LinkHistory& history) {
  if (empty()) return;
  show(history);
  samples_.clear();
  stride_ = 1;
  skipped_ = 0;
}

void ImpactSamples::archive(Archive& archive) { archive(samples_, last_, stride_, skipped_); }

LinkSamples::LinkSamples(const Model& model, const StepView& stepper, std::vector<LinkHistory>& histories)
    : model_(model), stepper_(stepper), histories_(histories) {
  if (stepper.system().contact_count() == 0) return;
  for (const Link& link : model.links) histories_.push_back(heading(link, model));
  impacts_.resize(model.links.size());
  openings_ = Extremes(model.links.size());
  gaps_.resize(model.links.size());
  first_tangent_.assign(model.links.size(), -1);
  for (const Friction& friction : stepper.system().frictions) {
    histories_[friction.contact].tangents = friction.count;
    first_tangent_[friction.contact] = friction.first;
  }
}

std::array<double, 2> LinkSamples::friction(std::size_t link, double LinkStep::* force) const {
  std::array<double, 2> forces{};
  for (int j = 0; j < histories_[link].tangents; ++j)
    forces[j] = stepper_.link_step(static_cast<int>(first_tangent_[link] + j)).*force;
  return forces;
}

void LinkSamples::add_inside(const Inside& in, double s, const Jet& at, double force) {
  LinkSample sample{in.step.begin + s * (in.step.end - in.step.begin), at.x, at.v, force, in.work(s), {}};
  for (int j = 0; j < histories_[in.link].tangents; ++j)
    sample.friction[j] = force_inside(stepper_.link_step(static_cast<int>(first_tangent_[in.link] + j)), s);
  impacts_[in.link].add(sample);
}

// Samples between s and e, fractions of a step with these forces, wherever linear interpolation would miss the force.
void LinkSamples::add_between(const Inside& in, double s, double force_s, double e, double force_e, int depth) {
  const double mid = 0.5 * (s + e);
  const Jet at = in.path.at(mid);
  // The path deviates from the motion by the error tolerance of the step; where the force is almost zero, the formula
  // of the law could become tensile.
  const double force = in.force({at.x, at.v});
  const double missed = std::abs(force - 0.5 * (force_s + force_e));
  if (missed <= in.allowed) return;
  // The error of both halves is a quarter of this, or 0.35 of it if the force starts like penetration^1.5.
  const bool deeper = depth > 1 && missed > 2 * in.allowed;
  if (deeper) add_between(in, s, force_s, mid, force, depth - 1);
  add_inside(in, mid, at, force);
  if (deeper) add_between(in, mid, force, e, force_e, depth - 1);
}

// Samples of a step in contact, excluding its ends.
void LinkSamples::add_inside(std::size_t link, const LinkStep& step, const ImpactRow& row) {
  const Inside inside{link, step, stepper_.links(), max_chord_error * row.peak_force};
  const LinkMotion& middle = step.motion_middle;
  // The law can be evaluated again unless its memory changed in this step.
  const bool looks = bends(step, row.peak_force) && inside.force(middle) == step.force_middle;
  const bool peaks = row.t_peak > step.begin && row.t_peak < step.end;
  const LinkSample at_middle{0.5 * (step.begin + step.end),
                             middle.penetration,
                             middle.rate,
                             step.force_middle,
                             inside.work_at_end - inside.power.work_of_second_half(),
                             friction(link, &LinkStep::force_middle)};
  if (!looks && !peaks) return impacts_[link].add(at_middle);
  const double at_peak = (row.t_peak - step.begin) / (step.end - step.begin);
  const auto add_half = [&](double s, double force_s, double e, double force_e) {
    if (peaks && at_peak > s && at_peak < e) {
      if (looks) add_between(inside, s, force_s, at_peak, row.peak_force, max_depth);
      add_inside(inside, at_peak, inside.path.at(at_peak), row.peak_force);
      s = at_peak;
      force_s = row.peak_force;
    }
    if (looks) add_between(inside, s, force_s, e, force_e, max_depth);
  };
  add_half(0, step.force_begin, 0.5, step.force_middle);
  impacts_[link].add(at_middle);
  add_half(0.5, step.force_middle, 1, step.force_end);
}

void LinkSamples::begin() {
  for (std::size_t i = 0; i < gaps_.size(); ++i) gaps_[i] = stepper_.memory().contacts[i].state.gap;
}

// The opening is the negative approach of the two ends: approach = penetration + gap.
void LinkSamples::record_opening(std::size_t link, const LinkStep& step) {
  const LinkMotion &begin = step.motion_begin, &end = step.motion_end;
  openings_.update(link, step.begin, step.end - step.begin, -begin.penetration - gaps_[link], -begin.rate,
                   -end.penetration - gaps_[link], -end.rate);
  gaps_[link] = stepper_.memory().contacts[link].state.gap;
}

void LinkSamples::step(bool output_due) {
  for (std::size_t i = 0; i < impacts_.size(); ++i) {
    const Contact& contact = *model_.links[i].contact;
    const ContactMemory& memory = stepper_.memory().contacts[i];
    const double work = memory.log.work();
    const LinkStep& step = stepper_.link_step(static_cast<int>(i));
    record_opening(i, step);
    const std::span<const ImpactRow> rows = memory.impacts();
    const bool begun = !rows.empty();
    const bool presses = begun && std::isnan(rows.back().t_end);
    const bool ends_here = begun && !presses && rows.back().t_end >= step.end;
    ImpactSamples& impact = impacts_[i];
    const LinkMotion& end = step.motion_end;
    if (presses || ends_here) {
      if (impact.empty() && model_.links[i].preload && rows.size() == 1)
        impact.begin_pressed({step.begin, step.motion_begin.penetration, step.motion_begin.rate, step.force_begin,
                              work - LinkPower(step).work_after(0), friction(i, &LinkStep::force_begin)});
      if (step.force_middle != 0) add_inside(i, step, rows.back());
      // A located end may be later than the exact one by round-off of the motion, where the formula of the law would be
      // tensile.
      const double force = contact.acting_force(presses ? stepper_.link_forces()[static_cast<int>(i)] : step.force_end);
      impact.add({step.end, end.penetration, end.rate, force, work, friction(i, &LinkStep::force_end)});
    }
    if (presses) continue;
    impact.finish(histories_[i]);
    if (ends_here || output_due) append({step.end, end.penetration, end.rate, 0, work, {}}, histories_[i]);
  }
}

void LinkSamples::end() {
  show_openings();
  for (std::size_t i = 0; i < impacts_.size(); ++i) impacts_[i].finish(histories_[i]);
}

void LinkSamples::show_openings() {
  for (std::size_t i = 0; i < impacts_.size(); ++i) {
    histories_[i].largest_opening = std::max(0.0, openings_.max[i]);
    histories_[i].t_opening = openings_.t_max[i];
  }
}

void LinkSamples::show_unfinished() {
  show_openings();
  lengths_.clear();
  for (std::size_t i = 0; i < impacts_.size(); ++i) {
    lengths_.push_back(histories_[i].time.size());
    impacts_[i].show(histories_[i]);
  }
}

void LinkSamples::hide_unfinished() {
  for (std::size_t i = 0; i < impacts_.size(); ++i)
    tables::cut_histories(tables::of_link, histories_[i], "", lengths_[i]);
}

void LinkSamples::archive(Archive& archive) {
  archive(impacts_, openings_, gaps_);
  for (LinkHistory& history : histories_) archive_length(archive, tables::of_link, history, "", history.time);
}

}  // namespace pounding
