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
#include <pounding/study/contact_moment.hpp>

namespace pounding::study {

template <class Law, int M, int L>
class ContactStep : public ContactMotion<Law, M, L> {
  using Base = ContactMotion<Law, M, L>;
  using Base::s_;

 public:
  using typename Base::Links;

  explicit ContactStep(const Structures<M, L>& structures) : Base(structures) {
    for (Stage& stage : stages_) stage = {s_.k, s_.k, numbers<L>(s_.link_count), numbers<L>(s_.link_count)};
  }

  /// Steps go on from this complete state.
  void begin(const Links&, const Ground&, const Moment<M, L>&, double) const noexcept {}

  /// A step from `begin` by ds on the clock, ending at the time given; returns the square of the velocity that the error of the modes' energy stands
  /// for, with `time_scale` [s] between displacements and velocities [kg m^2/s^2].
  double take(const Links& links, const Ground& ground, const Clock& clock, const Moment<M, L>& begin, double s, double ds, double end_time,
              double time_scale, Moment<M, L>& end) noexcept {
    double times[6];
    read(clock, s, ds, times);
    const bool bent = end_time > ground.corner;
    keep(stages_[0], speeds_[0], begin.v, begin.a);
    for (std::size_t l = 0; l < s_.links(); ++l)
      stages_[0].force[l] = begin.links[l].force.force, stages_[0].rate[l] = begin.links[l].rate;
    const auto stage = [&]<int I>(std::integral_constant<int, I>) {
      move<I>(begin, end.q, end.v);
      if (bent) bend(ground.bend, ground.beyond(times[I]), end);
      evaluate(links, ground.line(times[I]), stages_[I], end);
      keep(stages_[I], speeds_[I], end.v, end.a);
      if (bent) unbend(speeds_[I] * bent_rate(ground.bend, ground.beyond(times[I])), stages_[I].q);
    };
    [&]<int... I>(std::integer_sequence<int, I...>) { (stage(std::integral_constant<int, I + 1>{}), ...); }(std::make_integer_sequence<int, 5>{});
    move<6>(begin, end.q, end.v);
    if (bent) bend(ground.bend, ground.beyond(end_time), end);
    end.time = end_time;
    Base::complete(links, ground, end);
    Modes<M> v = end.v, a = end.a;
    if (bent) unbend(bent_rate(ground.bend, ground.beyond(end_time)), v), unbend(ground.bend * ground.beyond(end_time), a);
    return error(v, a, 1 / (time_scale * time_scale));
  }

  /// The motion of a link in the last step.
  Quintic path(std::size_t link, const Moment<M, L>& begin, const Moment<M, L>& end) const noexcept {
    return quintic_path(begin.links[link], end.links[link], end.time - begin.time);
  }
  /// Displacements and velocities at a part of the last step.
  void inside(double part, const Moment<M, L>& b, const Moment<M, L>& e, ModalState<M>& x) const noexcept {
    for (std::size_t j = 0; j < s_.modes(); ++j) {
      const Jet jet = Quintic({b.q[j], b.v[j], b.a[j]}, {e.q[j], e.v[j], e.a[j]}, e.time - b.time).at(part);
      x.q[j] = jet.x, x.v[j] = jet.v;
    }
  }

  /// Impulse [N s] and work [J] of a link in the last step.
  void push(std::size_t link, LinkContact<Law>& contact) const noexcept {
    double impulse = 0, work = 0;
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
      const double part = a[5][k] * speeds_[k] * stages_[k].force[link];
      impulse += part;
      work += part * stages_[k].rate[link];
    }
    contact.push(impulse, work);
  }

 private:
  // Derivatives by the clock, times the length of the step, and the links.
  struct Stage {
    Modes<M> q, v;
    Numbers<L> force, rate;
  };

  static constexpr double c[] = {0, 0.2, 0.3, 0.8, 8.0 / 9, 1};
  static constexpr double a[6][6] = {{0.2},
                                     {3.0 / 40, 9.0 / 40},
                                     {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                     {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                     {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                     {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  static constexpr double e[] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

  // Behind a corner of the ground's acceleration the stages go without the motion that its bend alone gives bodies that nothing holds: what is left
  // is smooth there.
  static double bent_rate(double bend, double beyond) noexcept { return 0.5 * bend * beyond * beyond; }
  void bend(double bend, double beyond, Moment<M, L>& x) const noexcept {
    const double rate = bent_rate(bend, beyond), way = rate * beyond * (1.0 / 3);
    for (std::size_t i = 0; i < s_.k.parts(); ++i) x.q.part(i) -= way * s_.p.part(i), x.v.part(i) -= rate * s_.p.part(i);
  }

  void unbend(double part, Modes<M>& x) const noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i) x.part(i) += part * s_.p.part(i);
  }

  // Times of the stages, and their speeds times the length of the step.
  void read(const Clock& clock, double s, double ds, double (&times)[6]) noexcept {
    for (int i = 0; i < 6; ++i)
      if (clock.p() == 1) {
        times[i] = s + c[i] * ds, speeds_[i] = ds;
      } else {
        const Clock::Tick tick = clock.at(s + c[i] * ds);
        times[i] = tick.time, speeds_[i] = ds * tick.speed;
      }
  }
  void keep(Stage& stage, double speed, const Modes<M>& v, const Modes<M>& acceleration) const noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i) {
      stage.q.part(i) = speed * v.part(i);
      stage.v.part(i) = speed * acceleration.part(i);
    }
  }
  // q and v, moved from the beginning of the step by the I stages before.
  template <int I>
  void move(const Moment<M, L>& begin, Modes<M>& q, Modes<M>& v) const noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i) {
      auto at_q = begin.q.part(i), at_v = begin.v.part(i);
#pragma GCC unroll 6
      for (int k = 0; k < I; ++k)
        if (a[I - 1][k] != 0) at_q += a[I - 1][k] * stages_[k].q.part(i), at_v += a[I - 1][k] * stages_[k].v.part(i);
      q.part(i) = at_q, v.part(i) = at_v;
    }
  }

  // Forces of the links that press and the accelerations, of a state on its way.
  [[gnu::always_inline]] void evaluate(const Links& links, double ag, Stage& stage, Moment<M, L>& x) const noexcept {
    Base::pull(x.q, x.v, ag, x.a);
    for (std::size_t l = 0; l < s_.links(); ++l) {
      if (!links[l].pressed()) {
        stage.force[l] = 0;
        continue;
      }
      stage.rate[l] = s_.closes(l, x.v);
      stage.force[l] = links[l].uncut(s_.closes(l, x.q) - links[l].gap(), stage.rate[l]).force;
      Base::push(l, stage.force[l], x.a);
    }
  }

  double error(const Modes<M>& v, const Modes<M>& acceleration, double of_displacement) const noexcept {
    double squares_q = 0, squares_v = 0;
    for (std::size_t i = 0; i < s_.k.parts(); ++i) {
      auto of_q = e[6] * speeds_[5] * v.part(i), of_v = e[6] * speeds_[5] * acceleration.part(i);
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k)
        if (e[k] != 0) of_q += e[k] * stages_[k].q.part(i), of_v += e[k] * stages_[k].v.part(i);
      squares_q += sum(of_q * of_q), squares_v += sum(of_v * of_v);
    }
    return squares_v + of_displacement * squares_q;
  }

  Stage stages_[6];
  double speeds_[6] = {};
};

}  // namespace pounding::study
