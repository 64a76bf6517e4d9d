#pragma once
/// Common part of hysteretic laws whose paths consist of straight pieces.

#include <cmath>
#include <optional>

#include <pounding/hysteresis/law.hpp>

namespace pounding::hysteresis {

/// Base of a law Self with straight pieces. A piece is a line through (start, force) with a slope; it belongs to a
/// side, which is the sign of its force, and ends at `end` in the direction of the side.
///
/// State has the members deformation [m], work [J] (done on the spring), start [m], force [N] and slope [N/m] of the
/// line; the last three are unused while the spring is elastic. Self provides
///
///     bool is_elastic(const State&) const noexcept;  // f = k d until now
///     double end_of_piece(const State&, int way) const noexcept;  // deformation, infinite if there is none
///     void turn(State&, int way) const noexcept;  // start of a path in the direction `way`
///     void arrive(State&, int way) const noexcept;  // starts the piece behind end_of_piece()
///     double unloading_stiffness(const State&) const noexcept;  // after a reversal here; 0 if it loses its force
///     double stiffness() const noexcept;
template <class Self, class State>
struct PiecewiseLinear {
  Answer respond(const State& kept, double d) const noexcept {
    const State end = moved(kept, d);
    return {force_at(end, d), slope_of(end)};
  }
  Answer excess(const State& kept, double d) const noexcept {
    const State end = moved(kept, d);
    const double k = self().stiffness();
    if (self().is_elastic(end)) return {0, 0};
    return {force_at(end, d) - k * d, slope_of(end) - k};
  }
  State advance(const State& kept, double d) const noexcept { return moved(kept, d); }
  /// Energy recovered by unloading to zero force.
  double stored(const State& kept) const noexcept {
    const double f = force_at(kept, kept.deformation);
    if (f == 0) return 0;
    const double k = self().is_elastic(kept) ? self().stiffness() : self().unloading_stiffness(kept);
    return k > 0 ? 0.5 * f * f / k : 0;
  }
  double work(const State& kept, double d) const noexcept {
    double sum = 0;
    walk(kept, d, [&](const State& from, double to) {
      sum += work_of(from, to);
      return true;
    });
    return sum;
  }
  std::optional<double> corner(const State& kept, double d) const noexcept {
    std::optional<double> found;
    State last = kept;
    bool is_first = true;
    walk(kept, d, [&](const State& piece, double) {
      const double x = piece.deformation, scale = 1e-9 * self().stiffness();
      const bool jumps = !is_first && is_strictly_between(x, kept.deformation, d) &&
                         (std::abs(slope_of(piece) - slope_of(last)) > scale ||
                          std::abs(force_at(piece, x) - force_at(last, x)) > scale * self().yield_deformation());
      if (jumps) found = x;
      last = piece;
      is_first = false;
      return !jumps;
    });
    return found;
  }

 protected:
  double force_at(const State& s, double d) const noexcept {
    return self().is_elastic(s) ? self().stiffness() * d : s.force + s.slope * (d - s.start);
  }
  double slope_of(const State& s) const noexcept { return self().is_elastic(s) ? self().stiffness() : s.slope; }
  /// Work on a piece up to a deformation.
  double work_of(const State& from, double to) const noexcept {
    return 0.5 * (force_at(from, from.deformation) + force_at(from, to)) * (to - from.deformation);
  }

 private:
  const Self& self() const noexcept { return static_cast<const Self&>(*this); }

  /// Calls visit(state at the start, end) for every straight piece of the path, until it returns false. Returns the
  /// state at the start of the last piece.
  template <class Visit>
  State walk(const State& kept, double d, Visit&& visit) const noexcept {
    State s = kept;
    if (d == kept.deformation) return s;
    const int way = d < kept.deformation ? -1 : 1;
    self().turn(s, way);
    // A path has at most a dozen pieces; the bound protects against round-off at their ends.
    for (int piece = 0; piece < 50; ++piece) {
      const double end = self().end_of_piece(s, way);
      const bool is_last = !(way * (d - end) > 0);
      const double to = is_last ? d : end;
      const bool is_longer = way * (to - s.deformation) > 0;
      if (is_longer && !visit(static_cast<const State&>(s), to)) return s;
      if (is_last) return s;
      if (is_longer) {
        s.work += work_of(s, to);
        s.deformation = to;
      }
      self().arrive(s, way);
    }
    return s;
  }
  State moved(const State& kept, double d) const noexcept {
    State s = walk(kept, d, [](const State&, double) { return true; });
    s.work += work_of(s, d);
    s.deformation = d;
    return s;
  }
};

}  // namespace pounding::hysteresis
