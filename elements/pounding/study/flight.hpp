#pragma once
/// Motion without contact: exact for piecewise linear ground acceleration.

#include <array>

#include <pounding/study/modal_state.hpp>
#include <pounding/study/taylor.hpp>

namespace pounding::study {

/// x' = A x + B (a0, a1) for x = (q, v) of every mode, from the start to the end of an interval.
template <int M, int L>
class Flight {
 public:
  /// `h` with omega h <= 1 and 2 zeta omega h <= 1 [s].
  Flight(const Structures<M, L>& s, double h)
      : h_(h), qq_(s.k), qv_(s.k), vq_(s.k), vv_(s.k), q0_(s.k), q1_(s.k), v0_(s.k), v1_(s.k) {
    for (std::size_t j = 0; j < s.modes(); ++j) {
      end(motion(s.order, s.k[j], s.c[j], 1, 0, 0, 0), qq_[j], vq_[j]);
      end(motion(s.order, s.k[j], s.c[j], 0, 1, 0, 0), qv_[j], vv_[j]);
      end(motion(s.order, s.k[j], s.c[j], 0, 0, s.p[j], -s.p[j] / h), q0_[j], v0_[j]);
      end(motion(s.order, s.k[j], s.c[j], 0, 0, 0, s.p[j] / h), q1_[j], v1_[j]);
    }
  }

  double length() const noexcept { return h_; }

  void advance(const ModalState<M>& from, double a0, double a1, ModalState<M>& to) const noexcept {
    for (std::size_t i = 0; i < qq_.parts(); ++i) {
      const Part end = this->end(i, from.q.part(i), from.v.part(i), a0, a1);
      to.q.part(i) = end.q, to.v.part(i) = end.v;
    }
  }
  /// A subset of the modes.
  struct Part {
    typename Modes<M>::Part q, v;
  };
  Part end(std::size_t i, const typename Modes<M>::Part& q, const typename Modes<M>::Part& v, double a0,
           double a1) const noexcept {
    return {qq_.part(i) * q + qv_.part(i) * v + (q0_.part(i) * a0 + q1_.part(i) * a1),
            vq_.part(i) * q + vv_.part(i) * v + (v0_.part(i) * a0 + v1_.part(i) * a1)};
  }

 private:
  void end(const Polynomial& p, double& q, double& v) const noexcept {
    const Jet jet = p.at(h_);
    q = jet.x, v = jet.v;
  }

  double h_;
  Modes<M> qq_, qv_, vq_, vv_, q0_, q1_, v0_, v1_;
};

/// Polynomials of all modes from one state.
template <int M, int L>
class PartOfFlight {
 public:
  explicit PartOfFlight(const Structures<M, L>& s) : s_(s) { terms_.fill(s.k); }

  void begin(const ModalState<M>& x, const Ground& ground) noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i)
      motion_terms(s_.order, s_.k.part(i), s_.c.part(i), x.q.part(i), x.v.part(i), ground.at * s_.p.part(i),
                   ground.slope * s_.p.part(i),
                   [&](std::size_t term, const auto& pack) { terms_[term].part(i) = pack; });
  }
  /// Remaining gap of a link.
  Polynomial gap(std::size_t link, double whole) const noexcept {
    Polynomial left{.order = s_.order, .c = {}};
    for (std::size_t term = 0; term <= static_cast<std::size_t>(s_.order); ++term)
      left.c[term] = -s_.closes(link, terms_[term]);
    left.c[0] += whole;
    return left;
  }
  /// State after a time t.
  void end(double t, ModalState<M>& x) const noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i) {
      const auto last = static_cast<std::size_t>(s_.order);
      auto q = terms_[last].part(i), v = static_cast<double>(last) * q;
      for (std::size_t term = last - 1; term > 0; --term) {
        q = t * q + terms_[term].part(i);
        v = t * v + static_cast<double>(term) * terms_[term].part(i);
      }
      x.q.part(i) = t * q + terms_[0].part(i);
      x.v.part(i) = v;
    }
  }

 private:
  const Structures<M, L>& s_;
  std::array<Modes<M>, taylor_order + 1> terms_;
};

/// True if a gap that is open at both ends of an interval may have closed within it: the tangents at both ends
/// intersect below zero. Gaps g0, g1 > 0 [m], closing rates r0, r1 [m/s].
inline bool may_dip(double g0, double r0, double g1, double r1, double h) noexcept {
  return r0 > 0 && r1 < 0 && g0 * (r0 - r1) <= r0 * (g0 - g1 - r1 * h);
}

}  // namespace pounding::study
