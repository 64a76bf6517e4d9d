#pragma once
/// Gap link with a contact law: zero force until the gap is closed, then the force of the law. Each impact is recorded
/// in a row.

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include <pounding/base/root.hpp>
#include <pounding/laws/compiled.hpp>
#include <pounding/links/contact.hpp>
#include <pounding/links/contact_state.hpp>
#include <pounding/links/impact_log.hpp>

namespace pounding {

/// `Law` is any struct with the members of a contact law (see laws/law.hpp), including user-defined ones.
///
/// `evaluate` and `event_functions` are pure; the ContactState changes only in `accept` and `on_event`.
template <class Law>
class GapLink final : public Contact {
 public:
  /// Initial gap [m], negative for overlapping ends that are pressed together; `link` is written into the rows of the
  /// impacts. Throws std::invalid_argument for a gap that is not finite and for invalid parameters of the law.
  GapLink(Law law, double gap, int link = 0) : law_(std::move(law)), state_{.gap = gap}, log_(link) {
    if (!std::isfinite(gap)) throw std::invalid_argument("gap must be finite");
    law_.check();
  }

  /// The law with its parameters.
  const Law& law() const noexcept { return law_; }
  /// Current gap [m]: laws that leave an indentation add it.
  double gap() const noexcept { return state_.gap; }

  ContactPhase phase() const noexcept override { return state_.phase; }
  double penetration(double relative_displacement) const noexcept override {
    return state_.penetration(relative_displacement);
  }

  laws::Response first_loading(double penetration) const noexcept override {
    return laws::pressed(law_, penetration, 0, laws::slow_touch(law_));
  }

  // Damping calibrated for a zero closing speed would be zero or unbounded.
  void press(double penetration) override {
    const auto force = [&](double speed) { return law_.contact(penetration, 1, laws::touch(law_, speed)).force; };
    if (force(1) != force(2))
      throw std::invalid_argument(
          "a contact that is closed at the start has no closing speed, which its law requires; give impact_velocity, "
          "or a law without closing speed, such as linear_spring or hertz");
    state_.press(law_, penetration);
    log_.begin(0, 0);
    const double stored = laws::stored_energy(law_, penetration, state_.impact);
    log_.push(0, stored);
    log_.store(stored);
  }

  laws::Response evaluate(const LinkMotion& motion) const noexcept override {
    if (state_.phase != ContactPhase::approach && state_.phase != ContactPhase::restitution) return {};
    return law_.contact(motion.penetration, motion.rate, state_.impact);
  }

  bool may_pull() const noexcept override { return laws::may_pull<Law>; }

  bool needs_closing_speed() const noexcept override {
    if constexpr (laws::designed_for_speed<Law>) return law_.needs_closing_speed();
    return false;
  }

  EventFunctions event_functions(const LinkMotion& motion, double /*force*/) const noexcept override {
    EventFunctions functions{};
    for (std::size_t i = 0; i < functions.size(); ++i)
      functions[i] = state_.margin(ends_of(state_.phase)[i], law_, motion.penetration, motion.rate);
    return functions;
  }

  double force_event_noise(const LinkMotion& motion, const LinkMotion& rounding) const noexcept override {
    const double d = at_least_a_trace(motion.penetration, state_.impact);
    const laws::Response r = law_.contact(d, motion.rate, state_.impact);
    const double all = sum_of_terms(r, d, motion.rate);
    // Beyond separation the sign is that of the limit, even if the evaluated penetration is small compared with
    // round-off.
    const double uncertain = motion.penetration < -rounding.penetration ? 0 : rounding.penetration;
    return all > 0 ? (std::abs(r.by_penetration) * uncertain + std::abs(r.by_rate) * rounding.rate) / all : 0;
  }

  void accept(const LinkStep& step) override {
    if (state_.phase == ContactPhase::open) return;
    log_.add(step);
    record_peak(step);
    state_.keep(law_, step.motion_end.penetration, step.motion_end.rate);
    log_.store(presses(state_.phase) ? laws::stored_energy(law_, step.motion_end.penetration, state_.impact) : 0);
  }

  void on_event(int index, double time, const LinkMotion& motion) override {
    const ContactEvent event = ends_of(state_.phase)[static_cast<std::size_t>(index)];
    if (event == ContactEvent::release) log_.release(time);
    if (event == ContactEvent::engage || (event == ContactEvent::turn && state_.phase == ContactPhase::slack))
      log_.engage();
    state_.apply(event, law_, motion.penetration, motion.rate);
    if (event == ContactEvent::touch)
      log_.begin(time, std::max(0.0, motion.rate));
    else if (state_.phase == ContactPhase::open)
      log_.end(time, motion.rate);
  }

  double work() const noexcept override { return log_.work(); }
  std::span<const ImpactRow> impacts() const noexcept override { return log_.rows(); }
  void archive(Archive& archive) override {
    archive(state_.gap, state_.phase, state_.impact);
    log_.archive(archive);
  }

 private:
  // A force that rises at the beginning of a step and falls at its end has its peak inside: where its slope on the
  // polynomial of degree five through the motion at both ends is zero.
  void record_peak(const LinkStep& step) {
    const auto slope = [&](const LinkMotion& motion, double acceleration) {
      const laws::Response f = evaluate(motion);
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
    log_.record_peak(step.begin + top * (step.end - step.begin), evaluate({at.x, at.v}).force);
  }

  Law law_;
  ContactState state_;
  ImpactLog log_;
};

/// Link for a law by name: a RigidGapLink for stereomechanical, otherwise a GapLink. Arguments and errors are theirs.
std::unique_ptr<Contact> make_gap_link(const laws::AnyLaw& law, double gap, int link = 0);

}  // namespace pounding
