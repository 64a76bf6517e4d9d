#pragma once
/// One output of a history and its peak.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <pounding/base/quintic.hpp>
#include <pounding/study/cubic_top.hpp>
#include <pounding/study/modal_state.hpp>
#include <pounding/study/taylor.hpp>

namespace pounding::study {

template <int M, int L>
class OutputRow {
 public:
  OutputRow(const Output& output, const Structures<M, L>& s)
      : kind_(output.kind),
        first_(0),
        last_(s.modes()),
        r_(s.count),
        by_q_(s.count),
        by_v_(s.count),
        rate_by_q_(s.count),
        rate_by_v_(s.count) {
    for (std::size_t j = 0; j < s.modes(); ++j) r_[j] = output.factors[j];
    while (first_ < last_ && r_[first_] == 0) ++first_;
    while (last_ > first_ && r_[last_ - 1] == 0) --last_;
    if (kind_ != Output::Kind::acceleration) {
      by_q_ = rate_by_v_ = r_;
      return;
    }
    ground_ = output.ground;
    by_ground_ = rate_by_slope_ = ground_;
    for (std::size_t j = first_; j < last_; ++j) {
      by_q_[j] = -r_[j] * s.k[j], by_v_[j] = -r_[j] * s.c[j];
      rate_by_q_[j] = r_[j] * s.c[j] * s.k[j], rate_by_v_[j] = r_[j] * (s.c[j] * s.c[j] - s.k[j]);
      rate_by_ground_ += r_[j] * s.c[j] * s.p[j];
      by_ground_ -= r_[j] * s.p[j], rate_by_slope_ -= r_[j] * s.p[j];
    }
  }

  bool is_one_mode() const noexcept { return last_ == first_ + 1; }
  /// Index of the first mode with a contribution.
  std::size_t first() const noexcept { return first_; }
  std::size_t last() const noexcept { return last_; }
  double factor(std::size_t mode) const noexcept { return r_[mode]; }
  double peak() const noexcept { return peak_; }
  void see(double x) noexcept { peak_ = std::max(peak_, kind_ == Output::Kind::closing ? x : std::abs(x)); }

  /// True if values with these rates, h apart, may have a reversal between them beyond the peak: the tangents at both
  /// ends reach that far.
  bool reaches(double y0, double w0, double y1, double w1, double h) const noexcept {
    if (!(w0 * w1 < 0)) return false;
    return std::max(std::abs(y0) + 0.5 * h * std::abs(w0), std::abs(y1) + 0.5 * h * std::abs(w1)) > peak_;
  }
  /// Displacement from modal displacements, or its rate.
  double displacement(const Modes<M>& x) const noexcept { return dot(r_, x); }
  /// Records the reversal of a displacement between two states in contact.
  template <class State>
  void turn(const State& begin, const State& end, double h) noexcept {
    const double rate = displacement(begin.v), later = displacement(end.v);
    const Quintic x({displacement(begin.q), rate, displacement(begin.a)},
                    {displacement(end.q), later, displacement(end.a)}, h);
    see(x.at(turn_on(x, rate, later)).x);
  }
  /// Records the reversal between a state and another one, reached without contact after a time h, with the rate
  /// `later`.
  void locate(const Structures<M, L>& s, const ModalState<M>& begin, const Ground& g, double h, double later) noexcept {
    Polynomial y{.order = s.order, .c = {}};
    for (std::size_t j = first_; j < last_; ++j) {
      const Polynomial q = motion(s.order, s.k[j], s.c[j], begin.q[j], begin.v[j], s.p[j] * g.at, s.p[j] * g.slope);
      y.add(by_q_[j], q);
      if (kind_ == Output::Kind::acceleration) y.add(by_v_[j], q.slope());
    }
    y.c[0] += by_ground_ * g.at, y.c[1] += by_ground_ * g.slope;
    // A peak is stationary: half the digits of its location suffice.
    see(y.at(turn_of(y, y.c[1], h, later, 1e-4)).x);
  }

  /// Starts an acceleration without contact.
  void begin(const ModalState<M>& x, const Ground& ground) noexcept {
    y_ = value(x, ground.at);
    w_ = rate(x, ground.at);
    see(y_);
  }
  /// An acceleration over an interval without contact.
  void fly(const Structures<M, L>& s, const ModalState<M>& begin, const ModalState<M>& end, const Ground& ground,
           double h) noexcept {
    const double y = value(end, ground(h)), w = rate(end, ground(h));
    // The slope of the ground acceleration jumps at samples, and so does the rate.
    const double slope = rate_by_slope_ * ground.slope;
    if (reaches(y_, w_ + slope, y, w + slope, h)) locate(s, begin, ground, h, w + slope);
    see(y);
    y_ = y, w_ = w;
  }
  /// An acceleration over a step in contact.
  template <class State, class Jerk, class Inside>
  void press(const State& begin, const State& end, double h, const Jerk& jerk, const Inside& inside) noexcept {
    const double y0 = absolute(begin), y1 = absolute(end);
    see(y1);
    if (std::max(std::abs(y0), std::abs(y1)) < 0.5 * peak_) return;
    const double w0 = h * (dot(r_, jerk(begin)) + ground_ * begin.slope),
                 w1 = h * (dot(r_, jerk(end)) + ground_ * end.slope);
    if (w0 * w1 < 0) see(absolute(inside(top_of_cubic(y0, w0, y1, w1))));
  }
  /// An absolute acceleration in contact.
  template <class State>
  double absolute(const State& x) const noexcept {
    return dot(r_, x.a) + ground_ * x.ground;
  }

 private:
  double value(const ModalState<M>& x, double ag) const noexcept {
    return dot(by_q_, x.q) + dot(by_v_, x.v) + by_ground_ * ag;
  }
  // Without the contribution of the ground's slope.
  double rate(const ModalState<M>& x, double ag) const noexcept {
    return dot(rate_by_q_, x.q) + dot(rate_by_v_, x.v) + rate_by_ground_ * ag;
  }
  Output::Kind kind_;
  std::size_t first_, last_;  // range of modes with a contribution
  Modes<M> r_, by_q_, by_v_, rate_by_q_, rate_by_v_;
  double ground_ = 0, by_ground_ = 0, rate_by_ground_ = 0, rate_by_slope_ = 0;
  double y_ = 0, w_ = 0;  // of an acceleration
  double peak_ = 0;
};

}  // namespace pounding::study
