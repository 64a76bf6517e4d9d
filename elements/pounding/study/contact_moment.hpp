#pragma once
/// States in contact with all derived quantities.

#include <cstddef>
#include <vector>

#include <pounding/base/quintic.hpp>
#include <pounding/study/link_contact.hpp>
#include <pounding/study/modal_state.hpp>

namespace pounding::study {

/// Motion and force of one link.
struct LinkMoment {
  double d = 0, rate = 0, acceleration = 0;  ///< penetration [m], [m/s], [m/s^2]
  laws::Response force;
  double force_rate = 0;  ///< dF/dt [N/s]
};

/// Motion of a link over a step of length h [s], from both of its ends.
inline Quintic quintic_path(const LinkMoment& begin, const LinkMoment& end, double h) noexcept {
  return Quintic({begin.d, begin.rate, begin.acceleration}, {end.d, end.rate, end.acceleration}, h);
}

/// A state in contact with all derived quantities.
template <int M, int L>
struct Moment : ModalState<M> {
  double time = 0;  ///< in the interval [s]
  double ground = 0, slope = 0;
  Modes<M> a;
  Numbers<L, LinkMoment> links;
};

/// Equations of motion in contact.
template <class Law, int M, int L>
class ContactMotion {
 public:
  using Links = std::vector<LinkContact<Law>>;

  explicit ContactMotion(const Structures<M, L>& structures) : s_(structures) {}

  Moment<M, L> moment() const {
    Moment<M, L> m;
    m.q = m.v = m.a = Modes<M>(s_.count);
    m.links = numbers<L, LinkMoment>(s_.link_count);
    return m;
  }

  /// Computes the derived quantities from q, v and the time.
  void complete(const Links& links, const Ground& ground, Moment<M, L>& m) const noexcept {
    m.ground = ground(m.time), m.slope = ground.slope_at(m.time);
    pull(m.q, m.v, m.ground, m.a);
    for (std::size_t l = 0; l < s_.links(); ++l) {
      LinkMoment& link = m.links[l];
      link.d = s_.closes(l, m.q) - links[l].gap();
      link.rate = s_.closes(l, m.v);
      link.force = links[l].force(link.d, link.rate);
      if (links[l].pressed()) push(l, link.force.force, m.a);
    }
    for (std::size_t l = 0; l < s_.links(); ++l) {
      LinkMoment& link = m.links[l];
      link.acceleration = s_.closes(l, m.a);
      link.force_rate = link.force.by_penetration * link.rate + link.force.by_rate * link.acceleration;
    }
  }

  /// da/dt of a complete state.
  void jerk(const Moment<M, L>& m, Modes<M>& all) const noexcept {
    pull(m.v, m.a, m.slope, all);
    for (std::size_t l = 0; l < s_.links(); ++l) push(l, m.links[l].force_rate, all);
  }

 protected:
  // Accelerations due to the structures and the ground.
  void pull(const Modes<M>& q, const Modes<M>& v, double ag, Modes<M>& acceleration) const noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i)
      acceleration.part(i) = -(s_.c.part(i) * v.part(i) + s_.k.part(i) * q.part(i) + ag * s_.p.part(i));
  }
  void push(std::size_t link, double force, Modes<M>& acceleration) const noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i) acceleration.part(i) -= force * s_.closing[link].part(i);
  }

  const Structures<M, L>& s_;
};

}  // namespace pounding::study
