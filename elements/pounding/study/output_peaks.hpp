#pragma once
/// Peaks of the outputs of a history: at the ends of intervals and steps, and at turns between them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <pounding/core/quintic.hpp>
#include <pounding/study/cubic_top.hpp>
#include <pounding/study/modal_state.hpp>
#include <pounding/study/taylor.hpp>

namespace pounding::study {

template <int M, int L>
class OutputPeaks {
 public:
  OutputPeaks(const LinearModel& model, const Structures<M, L>& structures) : s_(structures) {
    for (const Output& output : model.outputs) rows_.push_back(Row(output, structures));
  }

  /// The motion goes on without contact from here.
  void start(const ModalState<M>& x, const Ground& ground) noexcept {
    for (Row& row : rows_) {
      row.y = row.value(x, ground.at);
      row.w = row.rate(x, ground);
      row.see(row.y);
    }
  }

  /// An interval of length h without contact, from the state of the last call to `end`.
  void flown(const ModalState<M>& begin, const ModalState<M>& end, const Ground& ground, double h) noexcept {
    const Ground later{ground(h), ground.slope};
    for (Row& row : rows_) {
      double y, w;
      if (row.is_one_mode)
        y = row.factor * end.q[row.first], w = row.factor * end.v[row.first];
      else
        y = row.value(end, later.at), w = row.rate(end, later);
      if (row.may_turn(y, w, h)) locate(row, begin, ground, h);
      row.see(y);
      row.y = y, row.w = w;
    }
  }

  /// A step in contact. Accelerations and their time derivatives at both ends are those of the equations with the forces of the links; `inside(part)` is
  /// the state with its accelerations at a part of the step.
  template <class End, class Inside>
  void pressed(const End& begin, const End& end, double h, const Inside& inside) noexcept {
    for (Row& row : rows_) {
      if (row.kind == Output::Kind::acceleration) {
        const double y0 = row.absolute(begin), y1 = row.absolute(end);
        row.see(y1);
        if (std::max(std::abs(y0), std::abs(y1)) < 0.5 * row.peak) continue;
        const double w0 = h * row.jerk(begin), w1 = h * row.jerk(end);
        if (!(w0 * w1 < 0)) continue;
        row.see(row.absolute(inside(top_of_cubic(y0, w0, y1, w1))));
        continue;
      }
      const double y = row.sum(row.r, end.q), w = row.sum(row.r, end.v);
      row.y = row.sum(row.r, begin.q), row.w = row.sum(row.r, begin.v);
      if (row.may_turn(y, w, h)) {
        const Quintic x({row.y, row.w, row.sum(row.r, begin.a)}, {y, w, row.sum(row.r, end.a)}, h);
        row.see(x.at(x.turn(w > 0)).x);
      }
      row.see(y);
    }
  }
  /// Accelerations of a state in contact, as an event has left it.
  template <class End>
  void jumped(const End& state) noexcept {
    for (Row& row : rows_)
      if (row.kind == Output::Kind::acceleration) row.see(row.absolute(state));
  }

  std::vector<double> peaks() const {
    std::vector<double> all;
    for (const Row& row : rows_) all.push_back(row.peak);
    return all;
  }

 private:
  struct Row {
    Row(const Output& output, const Structures<M, L>& s)
        : kind(output.kind), first(0), last(s.modes()), r(numbers<M>(s.count)), by_q(r), by_v(r), rate_by_q(r), rate_by_v(r) {
      for (std::size_t j = 0; j < s.modes(); ++j) r[j] = output.factors[j];
      while (first < last && r[first] == 0) ++first;
      while (last > first && r[last - 1] == 0) --last;
      if (kind != Output::Kind::acceleration) {
        by_q = rate_by_v = r;
        is_one_mode = last == first + 1;
        if (is_one_mode) factor = r[first];
        return;
      }
      ground = output.ground;
      by_ground = rate_by_slope = ground;
      for (std::size_t j = first; j < last; ++j) {
        by_q[j] = -r[j] * s.k[j], by_v[j] = -r[j] * s.c[j];
        rate_by_q[j] = r[j] * s.c[j] * s.k[j], rate_by_v[j] = r[j] * (s.c[j] * s.c[j] - s.k[j]);
        rate_by_ground += r[j] * s.c[j] * s.p[j];
        by_ground -= r[j] * s.p[j], rate_by_slope -= r[j] * s.p[j];
      }
    }

    double sum(const Numbers<M>& factors, const Numbers<M>& x) const noexcept {
      double all = 0;
      for (std::size_t j = first; j < last; ++j) all += factors[j] * x[j];
      return all;
    }
    double value(const ModalState<M>& x, double ag) const noexcept {
      return kind == Output::Kind::acceleration ? sum(by_q, x.q) + sum(by_v, x.v) + by_ground * ag : sum(r, x.q);
    }
    double rate(const ModalState<M>& x, const Ground& g) const noexcept {
      if (kind != Output::Kind::acceleration) return sum(r, x.v);
      return sum(rate_by_q, x.q) + sum(rate_by_v, x.v) + rate_by_ground * g.at + rate_by_slope * g.slope;
    }
    template <class End>
    double absolute(const End& end) const noexcept {
      return sum(r, end.a) + ground * end.ground;
    }
    template <class End>
    double jerk(const End& end) const noexcept {
      return sum(r, end.jerk) + ground * end.slope;
    }
    void see(double x) noexcept { peak = std::max(peak, kind == Output::Kind::closing ? x : std::abs(x)); }
    /// Whether a turn between the last state and this one, a time h apart, may lie beyond the peak: the tangents at both ends reach that far.
    bool may_turn(double y1, double w1, double h) const noexcept {
      if (!(w * w1 < 0)) return false;
      const double reach = std::max(std::abs(y) + 0.5 * h * std::abs(w), std::abs(y1) + 0.5 * h * std::abs(w1));
      return reach > peak;
    }

    Output::Kind kind;
    std::size_t first, last;  // modes that count
    bool is_one_mode = false;  // a displacement of an oscillator
    double factor = 0;         // of that mode
    Numbers<M> r, by_q, by_v, rate_by_q, rate_by_v;
    double ground = 0, by_ground = 0, rate_by_ground = 0, rate_by_slope = 0;
    double y = 0, w = 0, peak = 0;
  };

  void locate(Row& row, const ModalState<M>& begin, const Ground& g, double h) noexcept {
    Polynomial y;
    for (std::size_t j = row.first; j < row.last; ++j) {
      const Polynomial q = motion(s_.k[j], s_.c[j], begin.q[j], begin.v[j], s_.p[j] * g.at, s_.p[j] * g.slope);
      y.add(row.by_q[j], q);
      if (row.kind == Output::Kind::acceleration) y.add(row.by_v[j], q.slope());
    }
    y.c[0] += row.by_ground * g.at, y.c[1] += row.by_ground * g.slope;
    const Polynomial w = y.slope();
    row.see(y.value(root_of(w, w.slope(), 0, h, row.w < 0)));
  }

  const Structures<M, L>& s_;
  std::vector<Row> rows_;
};

}  // namespace pounding::study
