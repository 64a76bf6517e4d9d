#pragma once
/// One step in contact: Dormand & Prince's pair 5(4) for all modes, in the integration variable of the contact.

#include <cstddef>
#include <type_traits>
#include <utility>

#include <pounding/base/quintic.hpp>
#include <pounding/study/clock.hpp>
#include <pounding/study/contact_moment.hpp>

namespace pounding::study {

template <class Law, int M, int L>
class ContactStep : public ContactMotion<Law, M, L> {
  using Base = ContactMotion<Law, M, L>;
  using Base::s_;

 public:
  using typename Base::Links;

  explicit ContactStep(const Structures<M, L>& structures)
      : Base(structures), presses_(numbers<L, int>(s_.link_count)) {
    for (Stage& stage : stages_) stage = {s_.k, s_.k, numbers<L>(s_.link_count), numbers<L>(s_.link_count)};
    if (s_.links() == 1) by_ground_ = s_.closes(0, s_.p), by_force_ = s_.closes(0, s_.closing[0]);
  }

  /// Continues from this complete state.
  void begin(const Links&, const Ground&, const Moment<M, L>&, double) const noexcept {}

  /// A step from `begin` by ds in the integration variable, ending at the given time. Returns the square of the
  /// velocity that corresponds to the error of the modal energy [kg m^2/s^2]; `of_displacement` [1/s^2] is the inverse
  /// square of a time between displacements and velocities.
  double take(const Links& links, const Ground& ground, const Clock& clock, const Moment<M, L>& begin, double s,
              double ds, double end_time, double of_displacement, Moment<M, L>& end) noexcept {
    if constexpr (L != 1)
      if (s_.links() > 1) return take_with<false>(links, ground, clock, begin, s, ds, end_time, of_displacement, end);
    return take_with<true>(links, ground, clock, begin, s, ds, end_time, of_displacement, end);
  }

  /// Motion of a link in the last step.
  Quintic path(std::size_t link, const Moment<M, L>& begin, const Moment<M, L>& end) const noexcept {
    return quintic_path(begin.links[link], end.links[link], end.time - begin.time);
  }
  /// Displacements and velocities at a fraction of the last step.
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
  // Derivatives in the integration variable, multiplied by the step length, and the links.
  struct Stage {
    Modes<M> q, v;
    Numbers<L> force, rate;
    double closing = 0, closing_faster = 0;  // of a single link: penetration and rate, like the modes
  };

  using Part = typename Modes<M>::Part;
  // Registers for few modes; otherwise existing storage.
  using Local = std::conditional_t<(M > 0), Modes<M>, Modes<M>&>;

  static constexpr double c[] = {0, 0.2, 0.3, 0.8, 8.0 / 9, 1};
  static constexpr double a[6][6] = {{0.2},
                                     {3.0 / 40, 9.0 / 40},
                                     {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                     {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                     {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                     {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  static constexpr double e[] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

  // After a corner of the ground acceleration, the stages exclude the motion of free bodies due to the change of slope
  // alone; the remainder is smooth there. For unit load: its velocity, and the time since the corner.
  struct Bend {
    double rate = 0, beyond = 0;
    // Displacement for a velocity.
    double way(double velocity) const noexcept { return velocity * beyond * (1.0 / 3); }
  };
  static Bend bend_of(const Ground& ground, double time) noexcept {
    const double beyond = ground.beyond(time);
    return {0.5 * ground.bend * beyond * beyond, beyond};
  }

  template <bool one_link>
  [[gnu::flatten]] double take_with(const Links& links, const Ground& ground, const Clock& clock,
                                    const Moment<M, L>& begin, double s, double ds, double end_time,
                                    double of_displacement, Moment<M, L>& end) noexcept {
    double times[6];
    read(clock, s, ds, times);
    const bool bent = end_time > ground.corner;
    Local q = end.q, v = end.v, acceleration = end.a;
    keep(stages_[0], speeds_[0], begin.v, begin.a);
    for (std::size_t l = 0; l < s_.links(); ++l) {
      const LinkMoment& link = begin.links[l];
      stages_[0].force[l] = link.force.force, stages_[0].rate[l] = link.rate;
      presses_[l] = links[l].pressed();
      if constexpr (one_link)
        stages_[0].closing = speeds_[0] * link.rate, stages_[0].closing_faster = speeds_[0] * link.acceleration;
    }
    const auto stage = [&]<int I>(std::integral_constant<int, I>) {
      Bend bend;
      move<I>(begin, q, v);
      if (bent) [[unlikely]]
        apply(bend = bend_of(ground, times[I]), q, v);
      evaluate<I, one_link>(links, begin, ground.line(times[I]), bend, q, v, acceleration);
      keep(stages_[I], speeds_[I], v, acceleration);
      if (bent) [[unlikely]]
        unbend(speeds_[I] * bend.rate, stages_[I].q);
    };
    [&]<int... I>(std::integer_sequence<int, I...>) {
      (stage(std::integral_constant<int, I + 1>{}), ...);
    }(std::make_integer_sequence<int, 5>{});
    move<6>(begin, q, v);
    if (bent) apply(bend_of(ground, end_time), q, v);
    if constexpr (M > 0) end.q = q, end.v = v;
    end.time = end_time;
    Base::complete(links, ground, end);
    Modes<M> last_v = end.v, last_a = end.a;
    if (bent) unbend(bend_of(ground, end_time).rate, last_v), unbend(ground.bend * ground.beyond(end_time), last_a);
    return error(last_v, last_a, of_displacement);
  }

  void apply(const Bend& bend, Modes<M>& q, Modes<M>& v) const noexcept {
    const double way = bend.way(bend.rate);
    for (std::size_t i = 0; i < s_.k.parts(); ++i)
      q.part(i) -= way * s_.p.part(i), v.part(i) -= bend.rate * s_.p.part(i);
  }
  void unbend(double part, Modes<M>& x) const noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i) x.part(i) += part * s_.p.part(i);
  }

  // Times of the stages, and dt/ds multiplied by the step length.
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
  // q and v, advanced from the beginning of the step by the first I stages.
  template <int I>
  void move(const Moment<M, L>& begin, Modes<M>& q, Modes<M>& v) const noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i) {
      auto at_q = begin.q.part(i), at_v = begin.v.part(i);
#pragma GCC unroll 6
      for (int k = 0; k < I; ++k)
        if (a[I - 1][k] != 0)
          at_q += same<Part>(a[I - 1][k]) * stages_[k].q.part(i),
              at_v += same<Part>(a[I - 1][k]) * stages_[k].v.part(i);
      q.part(i) = at_q, v.part(i) = at_v;
    }
  }

  // Penetration and rate of a single link, advanced like those of the modes, so that only its last force waits for the
  // previous stage.
  template <int I>
  void move_link(const LinkMoment& begin, const Bend& bend, Stage& stage, double& d, double& rate) const noexcept {
    d = begin.d, rate = begin.rate;
#pragma GCC unroll 6
    for (int k = 0; k < I; ++k)
      if (a[I - 1][k] != 0) d += a[I - 1][k] * stages_[k].closing, rate += a[I - 1][k] * stages_[k].closing_faster;
    stage.closing = speeds_[I] * rate;
    if (bend.beyond > 0) [[unlikely]] {
      const double bent = bend.rate * by_ground_;
      d -= bend.way(bent), rate -= bent;
    }
  }

  // Forces of the closed links and the accelerations, for the state advanced by the first I stages.
  template <int I, bool one_link>
  [[gnu::always_inline]] void evaluate(const Links& links, const Moment<M, L>& begin, double ag, const Bend& bend,
                                       const Modes<M>& q, const Modes<M>& v, Modes<M>& acceleration) noexcept {
    Stage& stage = stages_[I];
    Base::pull(q, v, ag, acceleration);
    if constexpr (one_link) stage.closing_faster = s_.closes(0, acceleration);
    for (std::size_t l = 0; l < s_.links(); ++l) {
      if (!presses_[l]) [[unlikely]] {
        stage.force[l] = 0;
        continue;
      }
      double d, rate;
      if constexpr (one_link)
        move_link<I>(begin.links[0], bend, stage, d, rate);
      else
        d = s_.closes(l, q) - links[l].gap(), rate = s_.closes(l, v);
      const double force = links[l].uncut(d, rate).force;
      Base::push(l, force, acceleration);
      if constexpr (one_link) stage.closing_faster = speeds_[I] * (stage.closing_faster - by_force_ * force);
      stage.force[l] = force, stage.rate[l] = rate;
    }
  }

  double error(const Modes<M>& v, const Modes<M>& acceleration, double of_displacement) const noexcept {
    double squares_q = 0, squares_v = 0;
    for (std::size_t i = 0; i < s_.k.parts(); ++i) {
      auto of_q = e[6] * speeds_[5] * v.part(i), of_v = e[6] * speeds_[5] * acceleration.part(i);
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k)
        if (e[k] != 0) of_q += same<Part>(e[k]) * stages_[k].q.part(i), of_v += same<Part>(e[k]) * stages_[k].v.part(i);
      squares_q += sum(of_q * of_q), squares_v += sum(of_v * of_v);
    }
    return squares_v + of_displacement * squares_q;
  }

  Numbers<L, int> presses_;              // per link: true if closed in the current step
  double by_ground_ = 0, by_force_ = 0;  // B^T p and B^T B of a single link
  Stage stages_[6];
  double speeds_[6] = {};
};

}  // namespace pounding::study
