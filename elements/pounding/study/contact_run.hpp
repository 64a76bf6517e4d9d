#pragma once
/// Integration in contact, from a touch until all links are open again.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pounding/core/error.hpp>
#include <pounding/study/contact_step.hpp>
#include <pounding/study/output_peaks.hpp>
#include <pounding/study/series_step.hpp>
#include <pounding/study/step_events.hpp>

namespace pounding::study {

template <class Law, int M, int L>
class ContactRun {
 public:
  using Links = std::vector<LinkContact<Law>>;

  ContactRun(const Structures<M, L>& structures, Links& links, OutputPeaks<M, L>& outputs, const Settings& settings)
      : s_(structures),
        links_(links),
        outputs_(outputs),
        settings_(settings),
        step_(structures),
        jerk_(structures.count) {
    for (Moment<M, L>& moment : moments_) moment = step_.moment();
  }
  // Not copyable: contains pointers to its own moments.
  ContactRun(const ContactRun&) = delete;
  ContactRun& operator=(const ContactRun&) = delete;

  bool closed() const noexcept { return closed_; }
  /// Number of accepted steps.
  long steps() const noexcept { return steps_; }
  /// Records a rate of a link [m/s].
  void saw(double rate) noexcept { fastest_ = std::max(fastest_, std::abs(rate)); }
  /// Starts an interval at this time of the history [s].
  void begin_interval(double time) noexcept { time_ = time; }

  /// A link touches at this time of the interval.
  void touch(std::size_t link, const ModalState<M>& x, double t, const Ground& ground) {
    Moment<M, L>& m = *begin_;
    m.q = x.q, m.v = x.v, m.time = t;
    m.links[link].rate = s_.closes(link, m.v);
    apply({LinkEvent::touch, link, 0}, ground);
  }

  /// Integrates from x until all links are open again or the interval ends. A step may end in the next interval of the
  /// same length if the ground motion continues there. Returns the time in the interval; x is then the state at that
  /// time.
  double press(const Ground& ground, ModalState<M>& x, double t, double length) {
    Moment<M, L>& m = *begin_;
    m.q = x.q, m.v = x.v, m.time = t;
    step_.complete(links_, ground, m);
    if (clock_.p() == 1) reading_ = t;
    while (closed_ && begin_->time < length) advance(ground, length);
    x.q = begin_->q, x.v = begin_->v;
    if (closed_) clock_.move(length);
    return begin_->time;
  }

 private:
  // Applies an event to begin_, and recomputes its derived quantities.
  void apply(const Found& found, const Ground& ground) {
    LinkContact<Law>& link = links_[found.link];
    link.apply(found.event, begin_->links[found.link].d, begin_->links[found.link].rate);
    closed_ = false;
    for (const LinkContact<Law>& each : links_) closed_ = closed_ || each.closed();
    step_.complete(links_, ground, *begin_);
    for (std::size_t l = 0; l < s_.links(); ++l)
      if (links_[l].pressed()) links_[l].record(begin_->links[l].force.force);
    outputs_.jumped(*begin_);
    if (found.event == LinkEvent::touch)
      wind_up(found.link);
    else
      clock_ = Clock(), reading_ = begin_->time, ds_ = last_;
  }

  // Start of an impact: its scales, and the integration variable of the first steps.
  void wind_up(std::size_t l) {
    const double inverse_mass = dot(s_.closing[l], s_.closing[l]);
    const double speed = std::max({std::abs(begin_->links[l].rate), 1e-3 * fastest_, laws::slowest_closing_speed});
    // Depth at which the spring alone does the work m v^2; one or two fixed-point iterations suffice for a scale.
    double depth = 1e-3 * speed;
    for (int i = 0; i < 8; ++i) {
      const double force = links_[l].slow_force(depth);
      const double ratio = force > 0 ? speed * speed / (inverse_mass * force * depth) : 4;
      depth *= std::clamp(std::sqrt(ratio), 0.01, 100.0);
      if (ratio > 0.5 && ratio < 2) break;
    }
    speed_ = speed, root_of_mass_ = 1 / std::sqrt(inverse_mass);
    allow();
    time_scale_ = depth / speed, per_square_of_time_ = 1 / (time_scale_ * time_scale_);
    clock_ = Clock(begin_->time, links_[l].root());
    reading_ = clock_.reading(begin_->time);
    // Initial step that almost always passes the error test.
    ds_ = clock_.reading(begin_->time + (clock_.p() == 1   ? 0.3
                                         : clock_.p() == 2 ? 0.1
                                                           : 0.003) *
                                            time_scale_) -
          reading_;
  }

  // Performs one accepted step.
  void advance(const Ground& ground, double length) {
    // Away from the touch, time itself is used.
    if (clock_.p() > 1 && begin_->time - clock_.touch() > time_scale_) {
      ds_ *= clock_.at(reading_).speed;
      clock_ = Clock(), reading_ = begin_->time;
    }
    // No step is longer than an interval.
    const double last = laws::is_linear<Law> || ground.corner > length ? length : begin_->time + length,
                 to_end = clock_.reading(last) - reading_;
    step_.begin(links_, ground, *begin_, settings_.tolerance);
    if constexpr (laws::is_linear<Law>) ds_ = step_.longest();
    for (;;) {
      const bool ends = ds_ >= to_end * (1 - 1e-12);
      const double ds = ends ? to_end : ds_;
      const double end_time = ends ? last : clock_.at(reading_ + ds).time;
      if (!(end_time > begin_->time)) fail("steps in contact become too short");
      if (++tries_ > settings_.max_steps) fail("too many steps in contact");
      const double square = take(ground, ds, end_time);
      if (!(square <= 1)) {
        ds_ = ds * (square < 1e24 ? std::max(0.2, growth(square)) : 0.2);
        continue;
      }
      // The force becomes steeper towards its release: rapidly growing steps would be rejected there.
      const double maximum = clock_.p() == 1 && square > 1e-6 ? 1.2 : 5.0;
      const double wanted = ds * std::min(maximum, growth(std::max(square, 1e-12))) * clock_.shortening(reading_, ds);
      const Found found = first_event(links_, step_, *begin_, *end_);
      if (found.event == LinkEvent::none) {
        // The length of a step cut by the interval does not limit the next one.
        ds_ = ends ? std::max(ds_, wanted) : wanted;
        keep(ground, reading_ + ds);
        return;
      }
      last_ = std::max(wanted, ds) * clock_.at(reading_ + ds).speed;
      land(found, ground, end_time);
      return;
    }
  }

  // Growth factor of the next step from the square of this error: 0.9 error^-0.2, within 7 %. It uses the logarithm in
  // the exponent of the floating-point number: integer arithmetic is identical on all machines, powers are not.
  static double growth(double square) noexcept {
    constexpr std::int64_t one = std::bit_cast<std::int64_t>(1.0);
    return 0.9 * std::bit_cast<double>(one - (std::bit_cast<std::int64_t>(square) - one) / 10);
  }

  // Square of the step error relative to its maximum.
  double take(const Ground& ground, double ds, double end_time) noexcept {
    return per_allowed_ *
           step_.take(links_, ground, clock_, *begin_, reading_, ds, end_time, per_square_of_time_, *end_);
  }
  // The maximum closing speed of this impact has increased: so does the admissible error of a step.
  void allow() noexcept {
    const double allowed = settings_.tolerance * speed_ * root_of_mass_;
    per_allowed_ = 1 / (allowed * allowed);
  }

  // State at a fraction of the last step, with its accelerations.
  const Moment<M, L>& inside(const Ground& ground, double part) noexcept {
    step_.inside(part, *begin_, *end_, *middle_);
    middle_->time = begin_->time + part * (end_->time - begin_->time);
    step_.complete(links_, ground, *middle_);
    return *middle_;
  }

  // Accepts the step; the next one begins at its end.
  void keep(const Ground& ground, double reading) {
    const double h = end_->time - begin_->time;
    // Before the laws update their history: points within the step belong to the history at its beginning.
    const auto jerk = [&](const Moment<M, L>& m) -> const Modes<M>& { return step_.jerk(m, jerk_), jerk_; };
    if (!outputs_.goes_on(*begin_, *end_))
      outputs_.pressed(*begin_, *end_, h, jerk,
                       [&](double part) -> const Moment<M, L>& { return inside(ground, part); });
    for (std::size_t l = 0; l < s_.links(); ++l) {
      LinkContact<Law>& link = links_[l];
      if (!link.closed()) continue;
      const LinkMoment &b = begin_->links[l], &e = end_->links[l];
      const auto path = [&] { return step_.path(l, *begin_, *end_); };
      if (link.pressed()) {
        step_.push(l, link);
        if (b.force_rate > 0 && e.force_rate < 0) record_top(link, b, e, h, path);
      }
      if (b.rate > 0 && e.rate < 0) {
        const auto way = path();
        link.record_depth(way.at(turn_on(way, b.rate, e.rate)).x);
      }
      try {
        link.keep(e.d, e.rate, e.force.force);
      } catch (const laws::BeyondDesign& error) {
        fail(error.what());
      }
      if (std::abs(e.rate) > speed_) speed_ = std::abs(e.rate), allow();
      saw(e.rate);
    }
    std::swap(begin_, end_);
    reading_ = reading;
    ++steps_;
  }

  // Repeats the step so that it ends on an event, and applies it.
  void land(const Found& found, const Ground& ground, double end_time) {
    double t = begin_->time + found.part * (end_time - begin_->time), left = 0;
    const double shortest = 1e-14 * (std::abs(begin_->time) + time_scale_);
    for (int i = 0; i < 4 && t - begin_->time > shortest; ++i) {
      const double ds = clock_.reading(t) - reading_;
      take(ground, ds, t);
      const Graph way = way_to(links_[found.link], found.event, end_->links[found.link]);
      left = -way.value / way.slope;
      if (!(std::abs(left) < 0.5 * (t - begin_->time))) left = 0;
      if (std::abs(left) <= 1e-4 * (t - begin_->time)) break;
      if (i < 3) t = std::min(t + left, end_time), left = 0;
    }
    if (t - begin_->time > shortest) {
      // Over the remaining ten-thousandth of the step, three terms of its series suffice.
      step_.jerk(*end_, jerk_);
      for (std::size_t i = 0; i < jerk_.parts(); ++i) {
        end_->q.part(i) += left * (end_->v.part(i) + 0.5 * left * end_->a.part(i));
        end_->v.part(i) += left * (end_->a.part(i) + 0.5 * left * jerk_.part(i));
      }
      end_->time += left;
      step_.complete(links_, ground, *end_);
      keep(ground, clock_.reading(end_->time));
    }
    apply(found, ground);
  }

  [[noreturn]] void fail(const char* what) const {
    throw SolverError(std::string(what) + ", at " + std::to_string(time_ + begin_->time) + " s");
  }

  const Structures<M, L>& s_;
  Links& links_;
  OutputPeaks<M, L>& outputs_;
  const Settings settings_;
  std::conditional_t<laws::is_linear<Law>, SeriesStep<Law, M, L>, ContactStep<Law, M, L>> step_;
  Moment<M, L> moments_[3];
  Moment<M, L>*begin_ = &moments_[0], *end_ = &moments_[1], *middle_ = &moments_[2];
  Modes<M> jerk_;
  bool closed_ = false;
  double time_ = 0;     // of the current interval
  double fastest_ = 0;  // maximum rate of any link
  Clock clock_;
  double reading_ = 0, ds_ = 0, last_ = 0;
  double speed_ = 0, time_scale_ = 0, root_of_mass_ = 0;  // of the current impact
  double per_allowed_ = 0, per_square_of_time_ = 0;       // inverse squares of the admissible error and of the time
  long steps_ = 0, tries_ = 0;
};

}  // namespace pounding::study
