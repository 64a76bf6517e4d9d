#pragma once
/// Motion without contact over one interval of the record: exact for straight ground acceleration.

#include <pounding/study/modal_state.hpp>
#include <pounding/study/taylor.hpp>

namespace pounding::study {

/// x' = A x + B (a0, a1) for x = (q, v) of every mode, from the start to the end of an interval.
template <int M, int L>
class Flight {
 public:
  /// `h` with omega h <= 1 and 2 zeta omega h <= 1 [s].
  Flight(const Structures<M, L>& s, double h) : of_(s), h_(h), qq_(s.k), qv_(s.k), vq_(s.k), vv_(s.k), q0_(s.k), q1_(s.k), v0_(s.k), v1_(s.k) {
    for (std::size_t j = 0; j < s.modes(); ++j) {
      end(motion(s.k[j], s.c[j], 1, 0, 0, 0), qq_[j], vq_[j]);
      end(motion(s.k[j], s.c[j], 0, 1, 0, 0), qv_[j], vv_[j]);
      end(motion(s.k[j], s.c[j], 0, 0, s.p[j], -s.p[j] / h), q0_[j], v0_[j]);
      end(motion(s.k[j], s.c[j], 0, 0, 0, s.p[j] / h), q1_[j], v1_[j]);
    }
  }

  double length() const noexcept { return h_; }

  void advance(const ModalState<M>& from, double a0, double a1, ModalState<M>& to) const noexcept {
    for (std::size_t j = 0; j < of_.modes(); ++j) {
      to.q[j] = qq_[j] * from.q[j] + qv_[j] * from.v[j] + (q0_[j] * a0 + q1_[j] * a1);
      to.v[j] = vq_[j] * from.q[j] + vv_[j] * from.v[j] + (v0_[j] * a0 + v1_[j] * a1);
    }
  }

 private:
  void end(const Polynomial& p, double& q, double& v) const noexcept {
    q = p.value(h_);
    v = p.slope().value(h_);
  }

  const Structures<M, L>& of_;
  double h_;
  Numbers<M> qq_, qv_, vq_, vv_, q0_, q1_, v0_, v1_;
};

/// Whether a gap that is open at both ends of an interval may have closed inside: the tangents at both ends meet behind it. Gaps g0, g1 > 0 [m], closing
/// rates r0, r1 [m/s].
inline bool may_dip(double g0, double r0, double g1, double r1, double h) noexcept {
  return r0 > 0 && r1 < 0 && g0 * (r0 - r1) <= r0 * (g0 - g1 - r1 * h);
}

}  // namespace pounding::study
