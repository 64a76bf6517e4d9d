#pragma once
/// Peaks of the outputs of a history: at reversals, which are located, and at the ends of motions.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <pounding/study/output_row.hpp>

namespace pounding::study {

/// A displacement has its maximum at a sign change of its velocity; without a sign change nothing else is evaluated.
template <int M, int L>
class OutputPeaks {
 public:
  OutputPeaks(const LinearModel& model, const Structures<M, L>& structures)
      : s_(structures), beyond_(structures.count), at_peak_(structures.count) {
    for (const Output& output : model.outputs) {
      (output.kind == Output::Kind::acceleration ? accelerations_ : displacements_).emplace_back(output, structures);
      of_oscillators_ =
          of_oscillators_ && (output.kind == Output::Kind::acceleration || displacements_.back().is_one_mode());
      order_.push_back(output.kind == Output::Kind::acceleration);
    }
    for (std::size_t j = structures.modes(); j < beyond_.parts() * Modes<M>::width; ++j) beyond_[j] = 1;
    for (const Row& row : displacements_) {
      double square = 0;
      for (std::size_t j = row.first(); j < row.last(); ++j)
        if (const double r = row.factor(j); r != 0) square += r * r / structures.k[j];
      energies_.push_back(square > 0 ? 1 / square : std::numeric_limits<double>::infinity());
    }
    if (of_oscillators_) return;
    rates_.resize((displacements_.size() + 3) / 4);
    later_.resize(rates_.size());
    for (std::size_t i = 0; i < rates_.size(); ++i) {
      Block block{.first = structures.modes(),
                  .last = 0,
                  .start = columns_.size(),
                  .empty = {},
                  .lowest = 0,
                  .known = -1,
                  .turns = false};
      const std::size_t rows = std::min<std::size_t>(4, displacements_.size() - 4 * i);
      for (std::size_t k = 0; k < rows; ++k) {
        block.first = std::min(block.first, displacements_[4 * i + k].first());
        block.last = std::max(block.last, displacements_[4 * i + k].last());
      }
      for (std::size_t k = rows; k < 4; ++k) block.empty.set(k, 1);
      for (std::size_t j = block.first; j < block.last; ++j) {
        columns_.emplace_back();
        for (std::size_t k = 0; k < rows; ++k) columns_.back().set(k, displacements_[4 * i + k].factor(j));
      }
      blocks_.push_back(block);
    }
  }

  /// True if only displacements of single modes are recorded: evaluation is needed only if a modal velocity changes
  /// sign.
  bool are_of_modes() const noexcept { return of_oscillators_ && accelerations_.empty(); }

  /// Displacements of the modes at which a recorded displacement is at its peak, if are_of_modes().
  const Modes<M>& peaks_of_modes() const noexcept { return at_peak_; }

  /// Starts the history.
  void start(const ModalState<M>& x, const Ground& ground) noexcept {
    for (Row& row : displacements_) row.see(row.displacement(x.q));
    find_lowest();
    energy_ = doubled_energy(x);
    resume(x, ground);
  }
  /// Continues without contact from here.
  void resume(const ModalState<M>& x, const Ground& ground) noexcept {
    for (Row& row : accelerations_) row.begin(x, ground);
  }
  /// Ends the history.
  void finish(const ModalState<M>& x) noexcept {
    for (Row& row : displacements_) row.see(row.displacement(x.q));
  }

  /// True if no peak is possible between the last state and `end`, at most an interval later; called once per state.
  [[gnu::always_inline]] bool goes_on(const ModalState<M>& begin, const ModalState<M>& end) noexcept {
    if (of_oscillators_) {
      calm_ = !modes_turn(begin.v, end.v) || stays_low(std::max(doubled_energy(begin), doubled_energy(end)), lowest_);
    } else {
      const double before = std::exchange(energy_, doubled_energy(end)), energy = std::max(before, energy_);
      ++states_;
      calm_ = stays_low(energy, lowest_) || !rates_turn(begin.v, end.v, energy);
    }
    return calm_ && accelerations_.empty();
  }
  /// An interval of length h without contact in which a peak is possible.
  [[gnu::noinline]] void flown(const ModalState<M>& begin, const ModalState<M>& end, const Ground& ground,
                               double h) noexcept {
    for_turning(begin, end, h, [&](Row& row, double later) { row.locate(s_, begin, ground, h, later); });
    for (Row& row : accelerations_) row.fly(s_, begin, end, ground, h);
  }

  /// A step in contact in which a peak is possible. `jerk(state)` is the derivative of the accelerations of a state,
  /// `inside(part)` the state with its accelerations at a fraction of the step.
  template <class State, class Jerk, class Inside>
  [[gnu::noinline]] void pressed(const State& begin, const State& end, double h, const Jerk& jerk,
                                 const Inside& inside) noexcept {
    for_turning(begin, end, h, [&](Row& row, double) { row.turn(begin, end, h); });
    for (Row& row : accelerations_) row.press(begin, end, h, jerk, inside);
  }
  /// Accelerations of a state in contact after an event.
  template <class State>
  void jumped(const State& state) noexcept {
    for (Row& row : accelerations_) row.see(row.absolute(state));
  }

  std::vector<double> peaks() const {
    std::vector<double> all;
    auto displacement = displacements_.begin(), acceleration = accelerations_.begin();
    for (const bool of_acceleration : order_)
      all.push_back((of_acceleration ? acceleration++ : displacement++)->peak());
    return all;
  }

 private:
  using Row = OutputRow<M, L>;

  // True if no displacement with this minimum doubled energy at its peak can exceed its peak between two states of at
  // most this `energy`: y = r^T q with r^T q + h/2 |r^T v| below the peak at both, see OutputRow::reaches(). Cauchy and
  // Schwarz: (|r^T q| + h/2 |r^T v|)^2 <= sum r^2/k sum k (|q| + h/2 |v|)^2 <= sum r^2/k (1 + (omega h)^2/4) sum (k q^2
  // + v^2), with omega h <= 1.
  static bool stays_low(double energy, double lowest) noexcept { return 1.25 * energy < lowest; }
  double doubled_energy(const ModalState<M>& x) const noexcept {
    auto all = s_.k.part(0) * x.q.part(0) * x.q.part(0) + x.v.part(0) * x.v.part(0);
    for (std::size_t i = 1; i < s_.k.parts(); ++i)
      all += s_.k.part(i) * x.q.part(i) * x.q.part(i) + x.v.part(i) * x.v.part(i);
    return sum(all);
  }
  // Minimum doubled energy at which a displacement may be at its peak.
  void find_lowest() noexcept {
    lowest_ = std::numeric_limits<double>::infinity();
    for (Block& block : blocks_) block.lowest = lowest_;
    for (std::size_t i = 0; i < displacements_.size(); ++i) {
      if (!std::isfinite(energies_[i])) continue;
      const double peak = displacements_[i].peak(), energy = peak * peak * energies_[i];
      lowest_ = std::min(lowest_, energy);
      if (!blocks_.empty()) blocks_[i / 4].lowest = std::min(blocks_[i / 4].lowest, energy);
    }
    if (!are_of_modes()) return;
    for (std::size_t j = 0; j < at_peak_.parts() * Modes<M>::width; ++j)
      at_peak_[j] = std::numeric_limits<double>::infinity();
    // Round-off here differs from that of the rows.
    for (const Row& row : displacements_)
      at_peak_[row.first()] =
          std::min(at_peak_[row.first()], (1 - 1e-12) * row.peak() / std::abs(row.factor(row.first())));
  }

  // True if the velocity of a mode changes sign.
  [[gnu::always_inline]] bool modes_turn(const Modes<M>& v, const Modes<M>& later) const noexcept {
    double minimum = smallest(v.part(0) * later.part(0) + beyond_.part(0));
    for (std::size_t i = 1; i < v.parts(); ++i)
      minimum = std::min(minimum, smallest(v.part(i) * later.part(i) + beyond_.part(i)));
    return !(minimum > 0);
  }
  // True if the rate of a displacement that may be at its peak changes sign.
  [[gnu::noinline]] bool rates_turn(const Modes<M>& v, const Modes<M>& later, double energy) noexcept {
    bool any = false;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      Block& block = blocks_[i];
      block.turns = false;
      if (stays_low(energy, block.lowest)) continue;
      rates_[i] = block.known == states_ - 1 ? later_[i] : rates(block, v);
      later_[i] = rates(block, later);
      block.known = states_;
      block.turns = !(smallest(rates_[i] * later_[i] + block.empty) > 0);
      any |= block.turns;
    }
    return any;
  }
  // Calls see(row, rate at the second state) if a displacement has a reversal beyond its peak. A reversal at the second
  // state itself is included.
  template <class State, class See>
  void for_turning(const State& begin, const State& end, double h, const See& see) noexcept {
    if (calm_) return;
    bool higher = false;
    for (std::size_t i = 0; i < displacements_.size(); ++i) {
      if (!of_oscillators_ && i % 4 == 0 && !blocks_[i / 4].turns) {
        i += 3;
        continue;
      }
      Row& row = displacements_[i];
      const double before = of_oscillators_ ? row.displacement(begin.v) : rates_[i / 4].at(i % 4);
      const double after = of_oscillators_ ? row.displacement(end.v) : later_[i / 4].at(i % 4);
      if (before * after > 0) continue;
      const double y = row.displacement(begin.q), y_after = row.displacement(end.q), peak = row.peak();
      if (row.reaches(y, before, y_after, after, h)) see(row, after);
      row.see(y_after);
      higher = higher || row.peak() > peak;
    }
    if (higher) find_lowest();
  }

  // Four displacements, their modes, and 1 in unused entries.
  struct Block {
    std::size_t first, last, start;
    Pack<4> empty;
    double lowest;  // minimum doubled energy at which one of them may be at its peak
    long known;     // last state at which their rates are known
    bool turns;     // true if a rate changes sign before it
  };
  Pack<4> rates(const Block& block, const Modes<M>& v) const noexcept {
    Pack<4> all;
    const Pack<4>* column = columns_.data() + block.start;
    for (std::size_t j = block.first; j < block.last; ++j) all += v[j] * *column++;
    return all;
  }

  const Structures<M, L>& s_;
  std::vector<Row> displacements_, accelerations_;
  std::vector<bool> order_;     // per output: true for an acceleration
  bool of_oscillators_ = true;  // each displacement is that of a single mode
  Modes<M> beyond_;             // 1 in unused entries
  Modes<M> at_peak_;
  std::vector<Block> blocks_;
  std::vector<Pack<4>> columns_, rates_, later_;  // rates of the displacements by modes, and in two states
  std::vector<double> energies_;                  // minimum doubled energy at a displacement of one
  double lowest_ = 0, energy_ = 0;                // energy_: of the last state
  long states_ = 0;                               // number of states evaluated
  bool calm_ = false;                             // no displacement has a peak between the last two states
};

}  // namespace pounding::study
