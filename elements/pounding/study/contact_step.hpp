#pragma once
/// One step in contact: Dormand & Prince's pair 5(4) on all modes, by the clock of the contact.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include <pounding/core/quintic.hpp>
#include <pounding/study/clock.hpp>
#include <pounding/study/link_contact.hpp>
#include <pounding/study/modal_state.hpp>

namespace pounding::study {

/// Motion of one link and its force.
struct LinkMoment {
  double d = 0, rate = 0, acceleration = 0;  ///< penetration [m], [m/s], [m/s^2]
  laws::Response force;
  double force_rate = 0;  ///< dF/dt [N/s]
};

/// A state in contact with all that follows from it.
template <int M, int L>
struct Moment : ModalState<M> {
  double time = 0;  ///< in the interval [s]
  double ground = 0, slope = 0;
  Numbers<M> a, jerk;
  Numbers<L, LinkMoment> links;
};

template <class Law, int M, int L>
class ContactStep {
 public:
  using Links = std::vector<LinkContact<Law>>;

  explicit ContactStep(const Structures<M, L>& structures) : s_(structures) {
    for (Stage& stage : stages_) stage = {s_.k, s_.k, numbers<L>(s_.link_count), numbers<L>(s_.link_count)};
  }

  Moment<M, L> moment() const {
    Moment<M, L> m;
    m.q = m.v = m.a = m.jerk = s_.k;
    m.links = numbers<L, LinkMoment>(s_.link_count);
    return m;
  }

  /// Fills in what follows from q, v and the time.
  void complete(const Links& links, const Ground& ground, Moment<M, L>& m) const noexcept {
    m.ground = ground(m.time), m.slope = ground.slope;
    for (std::size_t j = 0; j < s_.modes(); ++j) {
      m.a[j] = -s_.c[j] * m.v[j] - s_.k[j] * m.q[j] - s_.p[j] * m.ground;
      m.jerk[j] = -s_.k[j] * m.v[j] - s_.p[j] * m.slope;
    }
    for (std::size_t l = 0; l < s_.links(); ++l) {
      LinkMoment& link = m.links[l];
      link.d = s_.closes(l, m.q) - links[l].gap();
      link.rate = s_.closes(l, m.v);
      link.force = links[l].force(link.d, link.rate);
      for (std::size_t j = 0; j < s_.modes(); ++j) m.a[j] -= s_.closing[l][j] * link.force.force;
    }
    for (std::size_t l = 0; l < s_.links(); ++l) {
      LinkMoment& link = m.links[l];
      link.acceleration = s_.closes(l, m.a);
      link.force_rate = link.force.by_penetration * link.rate + link.force.by_rate * link.acceleration;
      for (std::size_t j = 0; j < s_.modes(); ++j) m.jerk[j] -= s_.closing[l][j] * link.force_rate;
    }
    for (std::size_t j = 0; j < s_.modes(); ++j) m.jerk[j] -= s_.c[j] * m.a[j];
  }

  /// A step from `begin` by ds on the clock, ending at the time given; returns the largest error of the modes in the velocity that the error of
  /// their energy stands for, with `time_scale` [s] between displacements and velocities [kg^0.5 m/s].
  double take(const Links& links, const Ground& ground, const Clock& clock, const Moment<M, L>& begin, double s, double ds, double end_time,
              double time_scale, Moment<M, L>& end) noexcept {
    static constexpr double e[] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
    double speed[7];
    for (int i = 0; i < 6; ++i) speed[i] = ds * clock.speed(s + c[i] * ds);
    speed[6] = speed[5];  // both at the end
    Stage& first = stages_[0];
    first.v = begin.v, first.a = begin.a;
    for (std::size_t l = 0; l < s_.links(); ++l) first.force[l] = begin.links[l].force.force, first.rate[l] = begin.links[l].rate;
    const auto stage = [&]<int I>(std::integral_constant<int, I>) {
      move<I>(begin, speed, stages_[I].v);
      evaluate(links, ground(clock.time(s + c[I] * ds)), stages_[I]);
    };
    [&]<int... I>(std::integer_sequence<int, I...>) { (stage(std::integral_constant<int, I + 1>{}), ...); }(std::make_integer_sequence<int, 5>{});
    move<6>(begin, speed, end.v);
    end.q = q_;
    end.time = end_time;
    complete(links, ground, end);
    double error = 0;
    for (std::size_t j = 0; j < s_.modes(); ++j) {
      double of_q = e[6] * speed[6] * end.v[j], of_v = e[6] * speed[6] * end.a[j];
      for (int k = 0; k < 6; ++k) {
        of_q += e[k] * speed[k] * stages_[k].v[j];
        of_v += e[k] * speed[k] * stages_[k].a[j];
      }
      error += of_v * of_v + of_q * of_q / (time_scale * time_scale);
    }
    return std::sqrt(error);
  }

  /// Impulse [N s] and work [J] of a link in the last step.
  void push(std::size_t link, LinkContact<Law>& contact) const noexcept {
    double impulse = 0, work = 0;
    for (int k = 0; k < 6; ++k) {
      const double part = weights_[k] * stages_[k].force[link];
      impulse += part;
      work += part * stages_[k].rate[link];
    }
    contact.push(impulse, work);
  }

 private:
  struct Stage {
    Numbers<M> v, a;
    Numbers<L> force, rate;
  };

  static constexpr double c[] = {0, 0.2, 0.3, 0.8, 8.0 / 9, 1};
  static constexpr double a[6][6] = {{0.2},
                                     {3.0 / 40, 9.0 / 40},
                                     {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                     {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                     {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                     {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};

  // q_ and v, moved from the beginning of the step by the I stages before.
  template <int I>
  void move(const Moment<M, L>& begin, const double* speed, Numbers<M>& v) noexcept {
#pragma GCC unroll 6
    for (int k = 0; k < I; ++k) weights_[k] = a[I - 1][k] * speed[k];
    for (std::size_t j = 0; j < s_.modes(); ++j) {
      double dq = 0, dv = 0;
#pragma GCC unroll 6
      for (int k = 0; k < I; ++k) dq += weights_[k] * stages_[k].v[j], dv += weights_[k] * stages_[k].a[j];
      q_[j] = begin.q[j] + dq;
      v[j] = begin.v[j] + dv;
    }
  }

  void evaluate(const Links& links, double ag, Stage& x) const noexcept {
    for (std::size_t j = 0; j < s_.modes(); ++j) x.a[j] = -s_.c[j] * x.v[j] - s_.k[j] * q_[j] - s_.p[j] * ag;
    for (std::size_t l = 0; l < s_.links(); ++l) {
      if (!links[l].pressed()) {
        x.force[l] = 0;
        continue;
      }
      x.rate[l] = s_.closes(l, x.v);
      x.force[l] = links[l].force(s_.closes(l, q_) - links[l].gap(), x.rate[l]).force;
      for (std::size_t j = 0; j < s_.modes(); ++j) x.a[j] -= s_.closing[l][j] * x.force[l];
    }
  }

  const Structures<M, L>& s_;
  Numbers<M> q_ = s_.k;
  Stage stages_[6];
  double weights_[6] = {};
};

}  // namespace pounding::study
