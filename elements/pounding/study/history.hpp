#pragma once
/// One history of the kernel: flights between contacts. M modes and L links, 0 for a number known only at run time.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include <pounding/study/calibration.hpp>
#include <pounding/study/contact_run.hpp>
#include <pounding/study/flight.hpp>
#include <pounding/study/ground_samples.hpp>

namespace pounding::study {

template <class Law, int M, int L>
class History {
 public:
  History(const LinearModel& model, const EvenRecord& record, const Settings& settings)
      : ground_(model, record),
        s_(model, taylor_order_for(ground_.reach())),
        record_(record),
        settings_(settings),
        outputs_(model, s_),
        contact_(s_, links_, outputs_, settings),
        flight_(s_, ground_.step()),
        part_(s_) {
    links_.reserve(model.links.size());
    bool one_formula = true;
    for (const LinkModes& link : model.links)
      one_formula = one_formula && same_formula(std::get<Law>(link.law), std::get<Law>(model.links.front().law));
    for (const LinkModes& link : model.links) {
      const Law& law = std::get<Law>(link.law);
      links_.emplace_back(one_formula ? remembering(law) : law, link.gap);
    }
    x_ = next_ = {Modes<M>(s_.count), Modes<M>(s_.count)};
    for (std::size_t j = 0; j < model.displacement.size(); ++j) x_.q[j] = model.displacement[j];
    for (std::size_t j = 0; j < model.velocity.size(); ++j) x_.v[j] = model.velocity[j];
    now_ = later_ = numbers<L, Closing>(s_.link_count);
  }

  Peaks run() {
    const double h = flight_.length();
    const double whole = settings_.duration > 0 ? settings_.duration
                                                : record_.step * static_cast<double>(record_.accelerations.size() - 1);
    // Round-off of a duration that is a multiple of the step does not add an interval.
    const auto intervals = static_cast<long>(std::ceil(whole / h * (1 - 1e-13)));
    const double rest = std::min(h, whole - h * static_cast<double>(intervals - 1));
    const long full = rest == h ? intervals : intervals - 1;
    outputs_.start(x_, ground_.in(0));
    double t = 0;
    for (long n = 0; n < intervals; ++n) {
      if (t == 0 && !contact_.closed() && n < full) n = glide(n, full);
      if (n < intervals) t = go(n, t, n < full ? h : rest, n + 1 < full);
    }
    outputs_.finish(x_);
    Peaks peaks{.outputs = outputs_.peaks(), .links = {}, .steps = contact_.steps()};
    for (std::size_t l = 0; l < s_.links(); ++l) {
      links_[l].finish(s_.closes(l, x_.q) - links_[l].gap());
      peaks.links.push_back(links_[l].peaks());
    }
    return peaks;
  }

 private:
  // An open link at one instant.
  struct Closing {
    double gap = 0, rate = 0;
    // True if the link may close before an instant a time h later.
    bool may_close_before(const Closing& later, double h) const noexcept {
      return !(later.gap > 0) || (gap > 0 ? may_dip(gap, rate, later.gap, later.rate, h) : !(rate < 0));
    }
  };
  Closing closing(std::size_t l, const ModalState<M>& x) const noexcept {
    return {links_[l].gap() - s_.closes(l, x.q), s_.closes(l, x.v)};
  }

  // Whole intervals without contact, from index n to the first one in which a link may close, or to `end`.
  [[gnu::noinline]] long glide(long n, long end) noexcept {
    if constexpr (M == 2 && L == 1)
      if (outputs_.are_of_modes()) return glide_pair(n, end);
    const double h = flight_.length(), per_h = 1 / h;
    ModalState<M>*x = &x_, *next = &next_;
    for (std::size_t l = 0; l < s_.links(); ++l) now_[l] = closing(l, *x);
    double fastest = 0, a0 = ground_.after(n);
    for (const Closing& link : now_) fastest = std::max(fastest, std::abs(link.rate));
    for (; n < end; ++n) {
      const double a1 = ground_.before(n + 1);
      flight_.advance(*x, a0, a1, *next);
      bool may_close = false;
      for (std::size_t l = 0; l < s_.links(); ++l) {
        later_[l] = closing(l, *next);
        may_close = may_close || now_[l].may_close_before(later_[l], h);
      }
      if (may_close) break;
      for (std::size_t l = 0; l < s_.links(); ++l) fastest = std::max(fastest, std::abs(later_[l].rate));
      if (!outputs_.goes_on(*x, *next)) outputs_.flown(*x, *next, {a0, (a1 - a0) * per_h}, h);
      std::swap(x, next);
      std::swap(now_, later_);
      a0 = ground_.after(n + 1, a1);
    }
    if (x != &x_) std::swap(x_, next_);
    contact_.saw(fastest);
    return n;
  }
  // Like glide(), with all numbers in registers, if the outputs are only displacements of modes. One test per state has
  // the same result for almost all of them: whether a link could close or a peak be passed within an interval at the
  // current rates.
  long glide_pair(long n, long end) noexcept {
    const double h = flight_.length(), per_h = 1 / h, gap = links_[0].gap();
    const auto closing_by = s_.closing[0].part(0);
    auto q = x_.q.part(0), v = x_.v.part(0), at_peak = outputs_.peaks_of_modes().part(0);
    Closing now = closing(0, x_);
    double fastest = std::abs(now.rate), a0 = ground_.after(n);
    bool was_calm = false;
    for (; n < end; ++n) {
      const double a1 = ground_.before(n + 1);
      const auto next = flight_.end(0, q, v, a0, a1);
      const Closing later{gap - sum(closing_by * next.q), sum(closing_by * next.v)};
      const double rate = std::abs(later.rate);
      const bool calm =
          (smallest(at_peak - magnitude(next.q) - (0.5 * h) * magnitude(next.v)) >= 0) & (later.gap > h * rate);
      if (!(calm & was_calm)) {
        if (now.may_close_before(later, h)) break;
        x_.q.part(0) = q, x_.v.part(0) = v, next_.q.part(0) = next.q, next_.v.part(0) = next.v;
        if (!outputs_.goes_on(x_, next_))
          outputs_.flown(x_, next_, {a0, (a1 - a0) * per_h}, h), at_peak = outputs_.peaks_of_modes().part(0);
      }
      fastest = std::max(fastest, rate);
      q = next.q, v = next.v;
      now = later, was_calm = calm;
      a0 = ground_.after(n + 1, a1);
    }
    x_.q.part(0) = q, x_.v.part(0) = v;
    contact_.saw(fastest);
    return n;
  }

  // From a time t of an interval to its end at `length`, including contacts. A step in contact may end in the next
  // interval if `goes_on` is true. Returns the time reached.
  double go(long n, double t, double length, bool goes_on) {
    const Ground ground = goes_on ? ground_.in_both(n) : ground_.in(n);
    contact_.begin_interval(flight_.length() * static_cast<double>(n));
    while (t < length) t = contact_.closed() ? contact_.press(ground, x_, t, length) : fly(ground, t, length);
    if (t == length && !contact_.closed()) outputs_.resume(x_, {ground(length), ground.slope});
    return t - length;
  }

  // Without contact until the next touch or the end.
  double fly(const Ground& ground, double t, double length) {
    const Ground here{ground(t), ground.slope};
    double until = length - t;
    part_.begin(x_, here);
    part_.end(until, next_);
    bool touches = false;
    std::size_t touching = 0;
    for (std::size_t l = 0; l < s_.links(); ++l) {
      if (!closing(l, x_).may_close_before(closing(l, next_), length - t)) continue;
      const double touch = first_closing(part_.gap(l, links_[l].gap()), until);
      if (touch < 0) continue;
      until = touch, touches = true, touching = l;
    }
    if (touches) part_.end(until, next_);
    outputs_.resume(x_, here);
    if (!outputs_.goes_on(x_, next_)) outputs_.flown(x_, next_, here, until);
    std::swap(x_, next_);
    for (std::size_t l = 0; l < s_.links(); ++l) contact_.saw(s_.closes(l, x_.v));
    if (!touches) return length;
    contact_.touch(touching, x_, t + until, ground);
    return t + until;
  }

  const GroundSamples ground_;
  const Structures<M, L> s_;
  const EvenRecord record_;
  const Settings settings_;
  std::vector<LinkContact<Law>> links_;
  OutputPeaks<M, L> outputs_;
  ContactRun<Law, M, L> contact_;
  const Flight<M, L> flight_;
  PartOfFlight<M, L> part_;
  ModalState<M> x_, next_;
  Numbers<L, Closing> now_, later_;
};

}  // namespace pounding::study
