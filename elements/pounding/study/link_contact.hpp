#pragma once
/// One link in a history of the kernel: inlined law, phase, peaks.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <pounding/laws/law.hpp>
#include <pounding/links/contact_state.hpp>
#include <pounding/study/calibration.hpp>
#include <pounding/study/kernel.hpp>

namespace pounding::study {

using LinkEvent = ContactEvent;

/// The p for which the force of a law is smooth in (t - touch)^(1/p): 1, 2 or 4, from the exponents of its spring and
/// dashpot at touch, measured numerically. The value 4 is a compromise for exponents that are not multiples of a
/// quarter.
template <class Law>
int clock_root(const Law& law, const laws::Impact& impact) {
  constexpr double d = 1e-9;
  // The dashpot of some laws acts only in approach, which any positive rate is.
  constexpr double rate = 1e-300;
  const laws::Response near = law.contact(d, rate, impact), far = law.contact(2 * d, rate, impact);
  const auto whole = [](double at_far, double at_near, int p) {
    if (!(at_near > 0 && at_far > 0)) return true;
    const double exponent = p * std::log2(at_far / at_near);
    return std::abs(exponent - std::round(exponent)) < 1e-4;
  };
  for (const int p : {1, 2})
    if (whole(far.force, near.force, p) && whole(far.by_rate, near.by_rate, p)) return p;
  return 4;
}

/// True if the response of a law depends on the exact instant of reversal: it has a history, or a dashpot in one
/// direction only.
template <class Law>
bool turn_matters(const Law& law, const laws::Impact& impact) {
  if constexpr (laws::crushes<Law> || requires(laws::Impact i) { law.keep(0.0, 0.0, i); }) return true;
  constexpr double d = 1e-4, rate = 1e-12;
  return law.contact(d, rate, impact).by_rate != law.contact(d, -rate, impact).by_rate;
}

/// True for a law whose slopes jump within an impact: the error estimate can overlook a jump inside a step, so steps
/// end there.
template <class Law>
inline constexpr bool has_corner =
    requires(const Law& law, const laws::Impact& impact) { law.corner(0.0, 0.0, impact); };

template <class Law>
class LinkContact {
 public:
  LinkContact(Law law, double gap) : law_(std::move(law)), state_{.gap = gap} {}

  bool closed() const noexcept { return state_.phase != ContactPhase::open; }
  bool pressed() const noexcept {
    return state_.phase == ContactPhase::approach || state_.phase == ContactPhase::restitution;
  }
  double gap() const noexcept { return state_.gap; }
  /// See clock_root(); valid once the link has touched.
  int root() const noexcept { return root_; }
  const LinkPeaks& peaks() const noexcept { return peaks_; }

  /// Force and slopes of a closed link, without cut-off, as within a step of the solver; zero otherwise. At a corner of
  /// the law the slopes are those of the current side, independent of round-off.
  laws::Response force(double penetration, double rate) const noexcept {
    if (!pressed()) return {};
    laws::Response f = law().contact(penetration, rate, state_.impact);
    if constexpr (has_corner<Law>)
      if (!(before_corner(penetration, rate) > 0))
        for (const double step : {trace(penetration), -trace(penetration)}) {
          if (!(before_corner(penetration + step, rate) > 0)) continue;
          const laws::Response beside = law().contact(penetration + step, rate, state_.impact);
          f.by_penetration = beside.by_penetration, f.by_rate = beside.by_rate;
        }
    return f;
  }
  /// Slopes of a linear law in the current phase.
  laws::Response slopes() const noexcept {
    return law().contact(1, state_.phase == ContactPhase::approach ? 1 : -1, state_.impact);
  }
  /// Formula of the law in any phase.
  laws::Response uncut(double penetration, double rate) const noexcept {
    return law().contact(penetration, rate, state_.impact);
  }
  /// Force for slow loading to this penetration [N].
  double slow_force(double penetration) const noexcept { return law().contact(penetration, 0, state_.impact).force; }

  /// Positive while the bodies remain on their side of the law's corner.
  double before_corner(double penetration, double rate) const noexcept {
    if constexpr (has_corner<Law>) return side_ * law().corner(penetration, rate, state_.impact);
    return std::numeric_limits<double>::infinity();
  }
  /// Positive during the current phase, negative after its end by this event; infinite for an event that cannot end it.
  /// Touches are located elsewhere.
  double margin(LinkEvent event, double penetration, double rate) const noexcept {
    const bool slack = state_.phase == ContactPhase::slack;
    if (event == LinkEvent::corner && !slack) return before_corner(penetration, rate);
    const bool can_end = event == LinkEvent::separation || (slack && event == LinkEvent::turn) ||
                         (event != LinkEvent::touch && slack == (event == LinkEvent::engage));
    if (!can_end || (event == LinkEvent::turn && !located_turn_)) return std::numeric_limits<double>::infinity();
    return state_.margin(event, law(), penetration, rate);
  }

  /// True if no margin is negative, which is the usual case. `force` is that of the state [N].
  bool goes_on(double penetration, double rate, double force) const noexcept {
    if (!pressed() || !(penetration > at_least_a_trace(0, state_.impact))) return false;
    return (laws::may_pull<Law> || force > 0) &&
           !(located_turn_ && (state_.phase == ContactPhase::approach) != (rate >= 0)) &&
           !(before_corner(penetration, rate) < 0);
  }

  /// Accepts a state within the contact. Throws laws::BeyondDesign.
  void keep(double penetration, double rate, double force) {
    laws::require_design(law_, penetration, state_.impact);
    state_.keep(law(), penetration, rate);
    peaks_.peak_penetration = std::max(peaks_.peak_penetration, penetration);
    record(force);
    if (!located_turn_ && pressed()) state_.phase = rate > 0 ? ContactPhase::approach : ContactPhase::restitution;
  }
  void record(double force) noexcept { peaks_.peak_force = std::max(peaks_.peak_force, force); }
  void record_depth(double penetration) noexcept {
    peaks_.peak_penetration = std::max(peaks_.peak_penetration, penetration);
  }
  /// Adds an impulse [N s] and work done on the link [J].
  void push(double impulse, double work) noexcept {
    peaks_.impulse += impulse;
    peaks_.energy_lost += work;
  }

  /// Applies an event at an accepted state, with the rate [m/s] and the penetration [m] there.
  void apply(LinkEvent event, double penetration, double rate) {
    change(event, penetration, rate);
    if constexpr (has_corner<Law>)
      if (pressed()) side_ = event == LinkEvent::corner ? -side_ : side_of_corner(penetration, rate);
  }

  /// Ends the history in this state: the recoverable energy of the contact is not lost.
  void finish(double penetration) noexcept {
    if (pressed()) peaks_.energy_lost -= laws::stored_energy(law(), penetration, state_.impact);
  }

 private:
  // Law of the current impact.
  const Law& law() const noexcept {
    if constexpr (has_curve<Law>) return curve_;
    return law_;
  }

  void change(LinkEvent event, double penetration, double rate) {
    if (event != LinkEvent::touch) return state_.apply(event, law(), std::max(0.0, penetration), rate);
    state_.begin(law_, rate);
    if constexpr (has_curve<Law>) curve_ = with_curve(law_, state_.impact);
    ++peaks_.impacts;
    if (root_ != 0) return;
    root_ = clock_root(law(), state_.impact);
    located_turn_ = turn_matters(law(), state_.impact);
  }

  // Distance well above round-off and well below all relevant distances [m].
  static double trace(double penetration) noexcept { return penetration > 0 ? 1e-9 * penetration : 1e-12; }

  // Sign of the law's corner() slightly further in the direction of motion.
  double side_of_corner(double penetration, double rate) const noexcept {
    const double step = state_.phase == ContactPhase::approach ? trace(penetration) : -trace(penetration);
    return law().corner(penetration + step, rate, state_.impact) < 0 ? -1 : 1;
  }

  Law law_, curve_ = law_;
  ContactState state_;
  LinkPeaks peaks_;
  int root_ = 0;
  bool located_turn_ = false;
  double side_ = 1;  // current sign of the law's corner()
};

}  // namespace pounding::study
