#pragma once
/// One history of the kernel: flights, contacts, peaks. M modes and L links, 0 for a number that is known at run time only.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pounding/core/error.hpp>
#include <pounding/study/calibration.hpp>
#include <pounding/study/contact_step.hpp>
#include <pounding/study/flight.hpp>
#include <pounding/study/output_peaks.hpp>
#include <pounding/study/step_events.hpp>

namespace pounding::study {

template <class Law, int M, int L>
class History {
 public:
  History(const LinearModel& model, const EvenRecord& record, const Settings& settings)
      : s_(model), record_(record), settings_(settings), outputs_(model, s_), step_(s_), pieces_(pieces(model, record)),
        flight_(s_, record.step / pieces_), begin_(step_.moment()), end_(begin_) {
    links_.reserve(model.links.size());
    bool one_formula = true;
    for (const LinkModes& link : model.links)
      one_formula = one_formula && same_formula(std::get<Law>(link.law), std::get<Law>(model.links.front().law));
    for (const LinkModes& link : model.links) {
      const Law& law = std::get<Law>(link.law);
      links_.emplace_back(one_formula ? remembering(law) : law, link.gap);
    }
    x_ = next_ = {numbers<M>(s_.count), numbers<M>(s_.count)};
    for (std::size_t j = 0; j < model.displacement.size(); ++j) x_.q[j] = model.displacement[j];
    for (std::size_t j = 0; j < model.velocity.size(); ++j) x_.v[j] = model.velocity[j];
    moments_ = later_ = numbers<L, Closing>(s_.link_count);
  }

  Peaks run() {
    const double h = flight_.length();
    const auto samples = static_cast<long>(record_.accelerations.size());
    const double whole = settings_.duration > 0 ? settings_.duration : record_.step * static_cast<double>(samples - 1);
    // Rounding of a duration that is a multiple of the step is no interval.
    const auto intervals = static_cast<long>(std::ceil(whole / h * (1 - 1e-13))), last = (samples - 1) * pieces_;
    Ground ground{};
    start(before(0), h);
    double a1 = before(0);
    for (long n = 0; n < intervals; ++n) {
      time_ = h * static_cast<double>(n);
      const double length = n + 1 == intervals ? std::min(h, whole - time_) : h;
      // The record jumps to zero at its end.
      const double a0 = n < last ? a1 : 0;
      a1 = before(n + 1);
      ground = {a0, (a1 - a0) / h};
      if (length == h && !closed_ && flies(a0, a1, ground)) continue;
      go(ground, length);
    }
    Peaks peaks{.outputs = outputs_.peaks(), .links = {}, .steps = steps_};
    for (std::size_t l = 0; l < s_.links(); ++l) {
      links_[l].finish(s_.closes(l, x_.q) - links_[l].gap());
      peaks.links.push_back(links_[l].peaks());
    }
    return peaks;
  }

 private:
  // Motion of an open link at the beginning of an interval.
  struct Closing {
    double gap = 0, rate = 0;
  };
  // Polynomials of the flight want omega h <= 1.
  static int pieces(const LinearModel& model, const EvenRecord& record) {
    double fastest = 0;
    for (std::size_t j = 0; j < model.stiffness.size(); ++j)
      fastest = std::max({fastest, std::sqrt(model.stiffness[j]), model.damping[j]});
    return std::max(1, static_cast<int>(std::ceil(fastest * record.step)));
  }

  // Acceleration just before the beginning of an interval; after the record it is zero.
  double before(long n) const noexcept {
    const auto samples = static_cast<long>(record_.accelerations.size());
    if (pieces_ == 1) return n < samples ? record_.factor * record_.accelerations[static_cast<std::size_t>(n)] : 0;
    const long i = n / pieces_, part = n % pieces_;
    if (i >= samples || (i + 1 == samples && part > 0)) return 0;
    const double from = record_.accelerations[static_cast<std::size_t>(i)];
    if (part == 0) return record_.factor * from;
    const double to = record_.accelerations[static_cast<std::size_t>(i) + 1];
    return record_.factor * (from + (to - from) * static_cast<double>(part) / pieces_);
  }

  void start(double ag, double h) {
    look();
    outputs_.start(x_, {ag, (before(1) - ag) / h});
  }
  // Notes gaps and rates, after the motion has not come from a whole flight.
  void look() noexcept {
    for (std::size_t l = 0; l < s_.links(); ++l) {
      moments_[l] = {links_[l].gap() - s_.closes(l, x_.q), s_.closes(l, x_.v)};
      fastest_ = std::max(fastest_, std::abs(moments_[l].rate));
    }
  }

  // A whole interval without contact; false, with nothing changed, where a link may close.
  bool flies(double a0, double a1, const Ground& ground) noexcept {
    const double h = flight_.length();
    flight_.advance(x_, a0, a1, next_);
    for (std::size_t l = 0; l < s_.links(); ++l) {
      later_[l] = {links_[l].gap() - s_.closes(l, next_.q), s_.closes(l, next_.v)};
      if (!(later_[l].gap > 0) || may_dip(moments_[l].gap, moments_[l].rate, later_[l].gap, later_[l].rate, h)) return false;
    }
    for (std::size_t l = 0; l < s_.links(); ++l) fastest_ = std::max(fastest_, std::abs(later_[l].rate));
    outputs_.flown(x_, next_, ground, h);
    std::swap(x_, next_);
    std::swap(moments_, later_);
    return true;
  }

  // The interval, or what the history still has of it, with its contacts.
  void go(const Ground& ground, double length) {
    double t = 0;
    while (t < length) t = closed_ ? press(ground, t, length) : fly(ground, t, length);
    if (closed_) {
      clock_.move(length);
      return;
    }
    look();
    outputs_.start(x_, {ground(length), ground.slope});
  }

  // Without contact until the next touch or the end.
  double fly(const Ground& ground, double t, double length) {
    std::vector<Polynomial>& modes = polynomials_;
    modes.resize(s_.modes());
    const Ground here{ground(t), ground.slope};
    for (std::size_t j = 0; j < s_.modes(); ++j)
      modes[j] = motion(s_.k[j], s_.c[j], x_.q[j], x_.v[j], s_.p[j] * here.at, s_.p[j] * here.slope);
    double until = length - t;
    bool touches = false;
    std::size_t touching = 0;
    for (std::size_t l = 0; l < s_.links(); ++l) {
      Polynomial gap;
      gap.c[0] = links_[l].gap();
      for (std::size_t j = 0; j < s_.modes(); ++j) gap.add(-s_.closing[l][j], modes[j]);
      const double touch = first_closing(gap, until);
      if (touch < 0) continue;
      until = touch, touches = true, touching = l;
    }
    next_ = x_;
    for (std::size_t j = 0; j < s_.modes(); ++j) {
      next_.q[j] = modes[j].value(until);
      next_.v[j] = modes[j].slope().value(until);
    }
    outputs_.start(x_, here);
    outputs_.flown(x_, next_, here, until);
    x_ = next_;
    t = touches ? t + until : length;
    if (touches) {
      begin_.q = x_.q, begin_.v = x_.v, begin_.time = t;
      begin_.links[touching].rate = s_.closes(touching, x_.v);
      apply({LinkEvent::touch, touching, 0}, ground);
    }
    return t;
  }

  // Applies an event to begin_, which then is complete again.
  void apply(const Found& found, const Ground& ground) {
    LinkContact<Law>& link = links_[found.link];
    link.apply(found.event, begin_.links[found.link].d, begin_.links[found.link].rate);
    closed_ = false;
    for (const LinkContact<Law>& each : links_) closed_ = closed_ || each.closed();
    step_.complete(links_, ground, begin_);
    for (std::size_t l = 0; l < s_.links(); ++l)
      if (links_[l].pressed()) links_[l].record(begin_.links[l].force.force);
    outputs_.jumped(begin_);
    if (found.event == LinkEvent::touch)
      wind_up(found.link);
    else
      clock_ = Clock(), reading_ = begin_.time, ds_ = last_;
  }

  // An impact begins: its scales, and the clock by which the first steps go.
  void wind_up(std::size_t l) {
    double inverse_mass = 0;
    for (std::size_t j = 0; j < s_.modes(); ++j) inverse_mass += s_.closing[l][j] * s_.closing[l][j];
    root_of_mass_ = 1 / std::sqrt(inverse_mass);
    speed_ = std::max({std::abs(begin_.links[l].rate), 1e-3 * fastest_, laws::slowest_closing_speed});
    // Depth at which the spring alone does the work m v^2: a step or two of a fixed point are enough for a scale.
    double depth = 1e-3 * speed_;
    for (int i = 0; i < 8; ++i) {
      const double force = links_[l].slow_force(depth);
      const double ratio = force > 0 ? speed_ * speed_ / (inverse_mass * force * depth) : 4;
      depth *= std::clamp(std::sqrt(ratio), 0.01, 100.0);
      if (ratio > 0.5 && ratio < 2) break;
    }
    time_scale_ = depth / speed_;
    clock_ = Clock(begin_.time, links_[l].root());
    reading_ = clock_.reading(begin_.time);
    ds_ = clock_.reading(begin_.time + 0.3 * time_scale_) - reading_;
  }

  // Steps in contact until all links are open again or the interval is over.
  double press(const Ground& ground, double t, double length) {
    begin_.q = x_.q, begin_.v = x_.v, begin_.time = t;
    step_.complete(links_, ground, begin_);
    if (clock_.p() == 1) reading_ = t;
    while (closed_ && begin_.time < length) advance(ground, length);
    x_.q = begin_.q, x_.v = begin_.v;
    return begin_.time;
  }

  // One kept step.
  void advance(const Ground& ground, double length) {
    // Away from the touch time itself will do.
    if (clock_.p() > 1 && begin_.time - clock_.touch() > time_scale_) {
      ds_ *= clock_.speed(reading_);
      clock_ = Clock(), reading_ = begin_.time;
    }
    const double to_end = clock_.reading(length) - reading_;
    for (;;) {
      const bool ends = ds_ >= to_end * (1 - 1e-12);
      const double ds = ends ? to_end : ds_;
      const double end_time = ends ? length : clock_.time(reading_ + ds);
      if (!(end_time > begin_.time)) fail("steps in contact become too short");
      if (++tries_ > settings_.most_steps) fail("there are too many steps in contact");
      const double error = take(ground, ds, end_time);
      if (!(error <= 1)) {
        ds_ = ds * (error < 1e12 ? std::max(0.2, growth(error)) : 0.2);
        continue;
      }
      const double wanted = ds * std::min(5.0, growth(std::max(error, 1e-6)));
      const Found found = first_event(links_, begin_, end_);
      if (found.event == LinkEvent::none) {
        // A step that the interval has cut says little about the next.
        ds_ = ends ? std::max(ds_, wanted) : wanted;
        keep(ground, reading_ + ds);
        return;
      }
      last_ = std::max(wanted, ds) * clock_.speed(reading_ + ds);
      land(found, ground, end_time);
      return;
    }
  }

  // Growth of the next step by the error of this one, nearly error^-0.2: roots are rounded alike on every machine, powers are not.
  static double growth(double error) noexcept {
    const double eighth = std::sqrt(std::sqrt(std::sqrt(error)));
    return 0.9 / (eighth * std::sqrt(eighth));
  }

  double take(const Ground& ground, double ds, double end_time) noexcept {
    const double error = step_.take(links_, ground, clock_, begin_, reading_, ds, end_time, time_scale_, end_);
    return error / (settings_.tolerance * speed_ * root_of_mass_);
  }

  // The state at a part of the last step, with its accelerations.
  const Moment<M, L>& inside(const Ground& ground, double part) {
    const double h = end_.time - begin_.time;
    middle_ = begin_;
    for (std::size_t j = 0; j < s_.modes(); ++j) {
      const Jet jet = Quintic({begin_.q[j], begin_.v[j], begin_.a[j]}, {end_.q[j], end_.v[j], end_.a[j]}, h).at(part);
      middle_.q[j] = jet.x, middle_.v[j] = jet.v;
    }
    middle_.time = begin_.time + part * h;
    step_.complete(links_, ground, middle_);
    return middle_;
  }

  // The step is kept, and the next one begins at its end.
  void keep(const Ground& ground, double reading) {
    const double h = end_.time - begin_.time;
    // Before the laws' memories move: what lies inside the step belongs to those at its beginning.
    outputs_.pressed(begin_, end_, h, [&](double part) -> const Moment<M, L>& { return inside(ground, part); });
    for (std::size_t l = 0; l < s_.links(); ++l) {
      LinkContact<Law>& link = links_[l];
      if (!link.closed()) continue;
      const LinkMoment &b = begin_.links[l], &e = end_.links[l];
      if (link.pressed()) {
        step_.push(l, link);
        if (b.force_rate > 0 && e.force_rate < 0) record_top(link, b, e, h);
      }
      if (b.rate > 0 && e.rate < 0) link.record_depth(path(b, e, h).at(path(b, e, h).turn(false)).x);
      link.keep(e.d, e.rate, e.force.force);
      speed_ = std::max(speed_, std::abs(e.rate));
      fastest_ = std::max(fastest_, std::abs(e.rate));
    }
    std::swap(begin_, end_);
    reading_ = reading;
    ++steps_;
  }

  // Repeats the step so that it ends on an event, and applies it.
  void land(const Found& found, const Ground& ground, double end_time) {
    double t = begin_.time + found.part * (end_time - begin_.time), left = 0;
    const double shortest = 1e-14 * (std::abs(begin_.time) + time_scale_);
    for (int i = 0; i < 4 && t - begin_.time > shortest; ++i) {
      const double ds = clock_.reading(t) - reading_;
      take(ground, ds, t);
      const Graph way = way_to(links_[found.link], found.event, end_.links[found.link]);
      left = -way.value / way.slope;
      if (!(std::abs(left) < 0.5 * (t - begin_.time))) left = 0;
      if (std::abs(left) <= 1e-4 * (t - begin_.time)) break;
      if (i < 3) t = std::min(t + left, end_time), left = 0;
    }
    if (t - begin_.time > shortest) {
      // A ten-thousandth of the step is left: three terms of its series.
      for (std::size_t j = 0; j < s_.modes(); ++j) {
        end_.q[j] += left * (end_.v[j] + 0.5 * left * end_.a[j]);
        end_.v[j] += left * (end_.a[j] + 0.5 * left * end_.jerk[j]);
      }
      end_.time += left;
      step_.complete(links_, ground, end_);
      keep(ground, clock_.reading(end_.time));
    }
    apply(found, ground);
  }

  [[noreturn]] void fail(const char* what) const {
    throw SolverError(std::string(what) + ", at " + std::to_string(time_ + begin_.time) + " s");
  }

  const Structures<M, L> s_;
  const EvenRecord record_;
  const Settings settings_;
  OutputPeaks<M, L> outputs_;
  ContactStep<Law, M, L> step_;
  int pieces_;
  Flight<M, L> flight_;
  std::vector<LinkContact<Law>> links_;
  std::vector<Polynomial> polynomials_;
  Numbers<L, Closing> moments_, later_;
  ModalState<M> x_, next_;
  Moment<M, L> begin_, end_, middle_;
  bool closed_ = false;
  double time_ = 0;      // of the present interval
  double fastest_ = 0;   // rate of any link so far
  Clock clock_;
  double reading_ = 0, ds_ = 0, last_ = 0;
  double speed_ = 0, time_scale_ = 0, root_of_mass_ = 0;  // of the present impact
  long steps_ = 0, tries_ = 0;
};

}  // namespace pounding::study
