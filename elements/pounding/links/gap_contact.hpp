#pragma once
/// Contact with a law: zero force until the gap is closed, then the force of the law. Each impact is recorded in a
/// row.

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <pounding/base/root.hpp>
#include <pounding/laws/compiled.hpp>
#include <pounding/links/contact.hpp>

namespace pounding {

/// `Law` is any struct with the members of a contact law (see laws/law.hpp), including user-defined ones.
///
/// `evaluate` and `event_functions` are pure; the memory changes only in `press`, `accept` and `on_event`.
template <class Law>
class GapContact final : public Contact {
 public:
  /// Initial gap [m], negative for overlapping ends that are pressed together; `link` is written into the rows of the
  /// impacts. Throws std::invalid_argument for a gap that is not finite and for invalid parameters of the law.
  GapContact(Law law, double gap, int link = 0) : law_(std::move(law)), gap_(gap), link_(link) {
    if (!std::isfinite(gap)) throw std::invalid_argument("gap must be finite");
    law_.check();
  }

  /// The law with its parameters.
  const Law& law() const noexcept { return law_; }

  ContactMemory initial() const override { return {.state = {.gap = gap_}, .log = ImpactLog(link_)}; }

  laws::Response first_loading(double penetration) const noexcept override {
    return laws::pressed(law_, penetration, 0, laws::slow_touch(law_));
  }

  // Damping calibrated for a zero closing speed would be zero or unbounded.
  void press(ContactMemory& memory, double penetration) const override {
    const auto force = [&](double speed) { return law_.contact(penetration, 1, laws::touch(law_, speed)).force; };
    if (force(1) != force(2))
      throw std::invalid_argument(
          "a contact that is closed at the start has no closing speed, which its law requires; give impact_velocity, "
          "or a law without closing speed, such as linear_spring or hertz");
    memory.state.press(law_, penetration);
    memory.log.begin(0, 0);
    const double stored = laws::stored_energy(law_, penetration, memory.state.impact);
    memory.log.push(0, stored);
    memory.log.store(stored);
  }

  laws::Response evaluate(const ContactMemory& memory, const LinkMotion& motion) const noexcept override {
    if (memory.state.phase != ContactPhase::approach && memory.state.phase != ContactPhase::restitution) return {};
    return law_.contact(motion.penetration, motion.rate, memory.state.impact);
  }

  bool may_pull() const noexcept override { return laws::may_pull<Law>; }

  bool needs_closing_speed() const noexcept override {
    if constexpr (laws::designed_for_speed<Law>) return law_.needs_closing_speed();
    return false;
  }

  EventFunctions event_functions(const ContactMemory& memory, const LinkMotion& motion,
                                 double /*force*/) const noexcept override {
    EventFunctions functions{};
    for (std::size_t i = 0; i < functions.size(); ++i)
      functions[i] = memory.state.margin(ends_of(memory.state.phase)[i], law_, motion.penetration, motion.rate);
    return functions;
  }

  double force_event_noise(const ContactMemory& memory, const LinkMotion& motion,
                           const LinkMotion& rounding) const noexcept override {
    const double d = at_least_a_trace(motion.penetration, memory.state.impact);
    const laws::Response r = law_.contact(d, motion.rate, memory.state.impact);
    const double all = sum_of_terms(r, d, motion.rate);
    // Beyond separation the sign is that of the limit, even if the evaluated penetration is small compared with
    // round-off.
    const double uncertain = motion.penetration < -rounding.penetration ? 0 : rounding.penetration;
    return all > 0 ? (std::abs(r.by_penetration) * uncertain + std::abs(r.by_rate) * rounding.rate) / all : 0;
  }

  void accept(ContactMemory& memory, const LinkStep& step) const override {
    if (memory.state.phase == ContactPhase::open) return;
    memory.log.add(step);
    record_peak(memory, step);
    memory.state.keep(law_, step.motion_end.penetration, step.motion_end.rate);
    memory.log.store(
        presses(memory.state.phase) ? laws::stored_energy(law_, step.motion_end.penetration, memory.state.impact) : 0);
  }

  void on_event(ContactMemory& memory, int index, double time, const LinkMotion& motion) const override {
    const ContactEvent event = ends_of(memory.state.phase)[static_cast<std::size_t>(index)];
    if (event == ContactEvent::release) memory.log.release(time);
    if (event == ContactEvent::engage || (event == ContactEvent::turn && memory.state.phase == ContactPhase::slack))
      memory.log.engage();
    memory.state.apply(event, law_, motion.penetration, motion.rate);
    if (event == ContactEvent::touch)
      memory.log.begin(time, std::max(0.0, motion.rate));
    else if (memory.state.phase == ContactPhase::open)
      memory.log.end(time, motion.rate);
  }

 private:
  // A force that rises at the beginning of a step and falls at its end has its peak inside: where its slope on the
  // polynomial of degree five through the motion at both ends is zero.
  void record_peak(ContactMemory& memory, const LinkStep& step) const {
    const auto slope = [&](const LinkMotion& motion, double acceleration) {
      const laws::Response f = evaluate(memory, motion);
      return f.by_penetration * motion.rate + f.by_rate * acceleration;
    };
    const double begin = slope(step.motion_begin, step.acceleration_begin),
                 end = slope(step.motion_end, step.acceleration_end);
    if (!(begin > 0) || !(end <= 0)) return;
    const Quintic path = pounding::path(step);
    const auto slope_at = [&](double s) {
      const Jet at = path.at(s);
      return slope({at.x, at.v}, at.a);
    };
    const double top = find_root(slope_at, 0, begin, 1, end);
    const Jet at = path.at(top);
    memory.log.record_peak(step.begin + top * (step.end - step.begin), evaluate(memory, {at.x, at.v}).force);
  }

  Law law_;
  double gap_;
  int link_;
};

/// Contact of a law by name: a RigidContact for stereomechanical, otherwise a GapContact. Arguments and errors are
/// theirs.
std::unique_ptr<const Contact> make_contact(const laws::AnyLaw& law, double gap, int link = 0);

}  // namespace pounding
