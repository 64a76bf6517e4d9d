#pragma once
/// One step in contact for a law whose force is linear in penetration and rate: Taylor series of the motion.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <pounding/base/gauss.hpp>
#include <pounding/study/clock.hpp>
#include <pounding/study/contact_moment.hpp>
#include <pounding/study/taylor.hpp>

namespace pounding::study {

/// Motion of a link over a step, like Quintic.
class SeriesPath {
 public:
  SeriesPath(const Polynomial& d, double h) noexcept : d_(d), h_(h) {}
  Jet at(double s) const noexcept { return d_.at(s * h_); }

 private:
  const Polynomial& d_;
  double h_;
};

template <class Law, int M, int L>
class SeriesStep : public ContactMotion<Law, M, L> {
  using Base = ContactMotion<Law, M, L>;
  using Base::s_;

 public:
  using typename Base::Links;

  explicit SeriesStep(const Structures<M, L>& structures)
      : Base(structures), links_(numbers<L, Link>(structures.link_count)) {
    terms_.fill(s_.k);
    for (std::size_t l = 0; l < s_.links(); ++l) squares_.push_back(dot(s_.closing[l], s_.closing[l]));
    for (std::size_t j = 0; j < s_.modes(); ++j)
      stiffest_ = std::max(stiffest_, s_.k[j]), strongest_ = std::max(strongest_, s_.c[j]);
  }

  /// Continues from this complete state, with a tolerance as in Settings.
  void begin(const Links& links, const Ground& ground, const Moment<M, L>& m, double tolerance) noexcept {
    double stiffness = stiffest_, damping = strongest_;
    terms_[0] = m.q, terms_[1] = m.v;
    for (std::size_t l = 0; l < s_.links(); ++l) {
      Link& link = links_[l];
      const LinkMoment& now = m.links[l];
      link.slopes = links[l].pressed() ? links[l].slopes() : laws::Response{};
      link.slopes.force = now.force.force - link.slopes.by_penetration * now.d - link.slopes.by_rate * now.rate;
      link.d.order = order;
      link.d.c[0] = m.links[l].d, link.d.c[1] = m.links[l].rate;
      stiffness += squares_[l] * link.slopes.by_penetration, damping += squares_[l] * link.slopes.by_rate;
    }
    longest_ = reach(tolerance) / std::max(std::sqrt(stiffness), damping);
#pragma GCC unroll 16
    for (std::size_t i = 0; i + 2 < terms_.size(); ++i) {
      const auto next = static_cast<double>(i + 1);
      for (std::size_t part = 0; part < s_.k.parts(); ++part) {
        auto pull = next * (s_.c.part(part) * terms_[i + 1].part(part)) + s_.k.part(part) * terms_[i].part(part);
        if (i < 2) pull += (i == 0 ? ground(m.time) : ground.slope) * s_.p.part(part);
        terms_[i + 2].part(part) = pull;
      }
      for (std::size_t l = 0; l < s_.links(); ++l) {
        const Link& link = links_[l];
        double force = link.slopes.by_penetration * link.d.c[i] + link.slopes.by_rate * (next * link.d.c[i + 1]);
        if (i == 0) force += link.slopes.force;
        for (std::size_t part = 0; part < s_.k.parts(); ++part)
          terms_[i + 2].part(part) += force * s_.closing[l].part(part);
      }
      for (std::size_t part = 0; part < s_.k.parts(); ++part)
        terms_[i + 2].part(part) = -taylor_shares[i] * terms_[i + 2].part(part);
      for (std::size_t l = 0; l < s_.links(); ++l) links_[l].d.c[i + 2] = s_.closes(l, terms_[i + 2]);
    }
  }
  /// Maximum step from there [s].
  double longest() const noexcept { return longest_; }

  /// Like other laws, with the slopes of the current phase: at a reversal, round-off may give the rate either sign.
  void complete(const Links& links, const Ground& ground, Moment<M, L>& m) const noexcept {
    Base::complete(links, ground, m);
    for (std::size_t l = 0; l < s_.links(); ++l) {
      if (!links[l].pressed()) continue;
      LinkMoment& link = m.links[l];
      link.force.by_rate = links[l].slopes().by_rate;
      link.force_rate = link.force.by_penetration * link.rate + link.force.by_rate * link.acceleration;
    }
  }

  /// A step to this time; returns 0, the square of its error.
  double take(const Links& links, const Ground& ground, const Clock&, const Moment<M, L>& begin, double, double,
              double end_time, double, Moment<M, L>& end) noexcept {
    length_ = end_time - begin.time;
    motion(length_, end);
    end.time = end_time;
    complete(links, ground, end);
    return 0;
  }

  /// Motion of a link in the last step.
  SeriesPath path(std::size_t link, const Moment<M, L>&, const Moment<M, L>&) const noexcept {
    return {links_[link].d, length_};
  }
  /// Displacements and velocities at a fraction of the last step.
  void inside(double part, const Moment<M, L>&, const Moment<M, L>&, ModalState<M>& x) const noexcept {
    motion(part * length_, x);
  }

  /// Impulse [N s] and work [J] of a link in the last step.
  void push(std::size_t l, LinkContact<Law>& contact) const noexcept {
    const Link& link = links_[l];
    const auto [force, k, c] = link.slopes;
    const double h = length_, d0 = link.d.c[0];
    double d1 = link.d.c[order], all = d1 * (1.0 / (order + 1));
#pragma GCC unroll 16
    for (int i = order - 1; i >= 0; --i)
      d1 = d1 * h + link.d.c[static_cast<std::size_t>(i)],
      all = all * h + (1.0 / (i + 1)) * link.d.c[static_cast<std::size_t>(i)];
    contact.push(force * h + k * h * all + c * (d1 - d0),
                 (force + 0.5 * k * (d1 + d0)) * (d1 - d0) + c * squares_of_rate(link.d));
  }

 private:
  static constexpr int order = 13;
  // Maximum omega h of a step, for omega not below that of any structure with these links: relative errors below 3e-8,
  // 3e-10 and 3e-12 of the motion. A single link separates within two steps at the tolerance of studies. If another one
  // may touch, a step has at most one reversal.
  double reach(double tolerance) const noexcept {
    const double longest = tolerance >= 1e-5 ? 1.75 : tolerance >= 1e-7 ? 1.25 : 0.9;
    return s_.links() == 1 ? longest : std::min(longest, 1.0);
  }
  struct Link {
    laws::Response slopes;  // with the force for d = 0 and d' = 0
    Polynomial d;           // penetration
  };

  // Integral of d'^2 over the last step by Gauss's rule; the middle point has no partner.
  double squares_of_rate(const Polynomial& d) const noexcept {
    static constexpr auto& points = gauss_points;
    static constexpr auto& weights = gauss_weights;
    const Pack<4> t = length_ * four(points[0], points[1], points[3], points[4]);
    const double middle = length_ * points[2];
    Pack<4> v = four(0, 0, 0, 0);
    double at_middle = 0;
#pragma GCC unroll 16
    for (std::size_t i = order; i > 0; --i) {
      const double term = static_cast<double>(i) * d.c[i];
      v = v * t + four(term, term, term, term);
      at_middle = at_middle * middle + term;
    }
    return length_ *
           (sum(four(weights[0], weights[1], weights[3], weights[4]) * (v * v)) + weights[2] * at_middle * at_middle);
  }

  void motion(double t, ModalState<M>& x) const noexcept {
    for (std::size_t i = 0; i < s_.k.parts(); ++i) {
      auto q = terms_[order].part(i), v = 0 * q;
#pragma GCC unroll 16
      for (std::size_t term = order - 1; term < order; --term) {
        v = t * v + q;
        q = t * q + terms_[term].part(i);
      }
      x.q.part(i) = q, x.v.part(i) = v;
    }
  }

  std::array<Modes<M>, order + 1> terms_;
  Numbers<L, Link> links_;
  std::vector<double> squares_;
  double stiffest_ = 0, strongest_ = 0, longest_ = 0, length_ = 0;
};

}  // namespace pounding::study
