#pragma once
/// History of one contact, all that is saved between two states: the same for a gap link and for the C interface.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <pounding/laws/law.hpp>

namespace pounding {

/// Penetration [m] at which the sign of a force is evaluated, bounded below by a small fraction of the peak
/// penetration. Thus a release shortly before the separation is detected, and a law whose formula extends to negative
/// penetrations does not appear to be in contact again.
inline double at_least_a_trace(double penetration, const laws::Impact& impact) noexcept {
  return std::max(penetration, 1e-9 * impact.largest_penetration);
}

/// Sum of the magnitudes of a force's terms [N], at a penetration that is at least a trace, see above.
inline double sum_of_terms(const laws::Response& r, double penetration, double rate) noexcept {
  return std::abs(r.by_penetration * penetration) + std::abs(r.by_rate * rate);
}

/// The law's force, negative where it would pull, over the sum of the magnitudes of its terms [-]: near the separation
/// all terms vanish, but this ratio stays as sharp as elsewhere.
template <class Law>
double signed_force(const Law& law, double penetration, double rate, const laws::Impact& impact) noexcept {
  const double d = at_least_a_trace(penetration, impact);
  const laws::Response r = law.contact(d, rate, impact);
  const double all = sum_of_terms(r, d, rate);
  return all > 0 ? r.force / all : 0;
}

/// Phase of a contact. It is set from the state at a located instant, never toggled.
enum class ContactPhase : std::uint8_t {
  open,         ///< apart
  approach,     ///< pressed, still closing
  restitution,  ///< pressed, opening
  slack,        ///< overlapping, while the force of the law would pull and is cut off at zero
  resting       ///< held at zero rate by the required force (rigid contact after its last bounce)
};

/// Event at the end of a phase. At a corner the slopes of the law jump, and the phase continues.
enum class ContactEvent : std::uint8_t { none, touch, turn, corner, release, engage, separation };

/// Events that end a phase with a force, filled up with `none`.
constexpr std::array<ContactEvent, 3> ends_of(ContactPhase phase) noexcept {
  using enum ContactEvent;
  switch (phase) {
    case ContactPhase::open: return {touch, none, none};
    case ContactPhase::approach: return {turn, separation, none};
    case ContactPhase::restitution: return {separation, release, turn};
    case ContactPhase::slack: return {separation, engage, turn};
    case ContactPhase::resting: break;
  }
  return {none, none, none};
}

/// True if the bodies are pressed together, by a force or held.
constexpr bool presses(ContactPhase phase) noexcept {
  return phase == ContactPhase::approach || phase == ContactPhase::restitution || phase == ContactPhase::resting;
}

/// History of one contact. Only the three functions below change it, at accepted states. To undo steps, restore
/// a copy.
struct ContactState {
  ContactPhase phase = ContactPhase::open;
  laws::Impact impact{};  ///< current impact; while the contact is open, the previous one
  double gap = 0;         ///< current gap [m]: initial gap plus the indentation left by the law

  /// Penetration [m] for an approach of the two ends by `relative_displacement` [m] since the undeformed state.
  constexpr double penetration(double relative_displacement) const noexcept { return relative_displacement - gap; }

  /// Starts the next impact at this rate [m/s]; a negative one counts as zero. Calibrates the damping of the law.
  template <class Law>
  void begin(const Law& law, double rate) {
    phase = ContactPhase::approach;
    impact = laws::touch(law, std::max(0.0, rate), impact.crushed);
  }

  /// Presses the bodies together at rest by this penetration [m].
  template <class Law>
  void press(const Law& law, double penetration) {
    begin(law, 0);
    keep(law, penetration, 0);
  }

  /// Accepts a state within the impact: penetration [m] and rate [m/s]. Throws laws::BeyondDesign like
  /// laws::require_design().
  template <class Law>
  void keep(const Law& law, double penetration, double rate) {
    laws::require_design(law, penetration, impact);
    laws::keep(law, penetration, rate, impact);
  }

  /// Positive during the current phase, zero at its end by this event; infinite for an event that cannot occur.
  template <class Law>
  double margin(ContactEvent event, const Law& law, double penetration, double rate) const noexcept {
    switch (event) {
      case ContactEvent::touch: return -penetration;
      case ContactEvent::separation: return penetration;
      case ContactEvent::turn:
        // A surface that follows the body presses as soon as the body reverses.
        if (phase == ContactPhase::slack && !laws::heals(law)) break;
        return phase == ContactPhase::approach ? rate : -rate;
      case ContactEvent::engage:
        if (laws::heals(law)) break;
        return -signed_force(law, penetration, rate, impact);
      case ContactEvent::release:
        if constexpr (!laws::may_pull<Law>) return signed_force(law, penetration, rate, impact);
        break;
      case ContactEvent::corner:
      case ContactEvent::none: break;
    }
    return std::numeric_limits<double>::infinity();
  }

  /// Enters the next phase after an event at an accepted state with this penetration [m] and rate [m/s].
  template <class Law>
  void apply(ContactEvent event, const Law& law, double penetration, double rate) {
    switch (event) {
      case ContactEvent::touch: return begin(law, rate);
      case ContactEvent::turn:
        phase = phase == ContactPhase::approach ? ContactPhase::restitution : ContactPhase::approach;
        return;
      case ContactEvent::release:
        if (laws::leaves_indentation<Law> && !laws::heals(law))
          end(law, penetration);
        else
          phase = ContactPhase::slack;
        return;
      case ContactEvent::engage: phase = rate > 0 ? ContactPhase::approach : ContactPhase::restitution; return;
      case ContactEvent::separation: return end(law, 0);
      case ContactEvent::corner:
      case ContactEvent::none: return;
    }
  }

  /// Ends the impact. `left` >= 0 is the penetration at which the force ended [m]. A law with permanent indentation
  /// adds it to the gap, or its own indentation if it records the maximum penetration.
  template <class Law>
  void end(const Law& law, double left) noexcept {
    phase = ContactPhase::open;
    if constexpr (laws::crushes<Law>) {
      gap += law.indentation(impact);
      impact.crushed = law.crushed(impact);
    } else if constexpr (laws::leaves_indentation<Law>) {
      gap += left;
    }
  }
};

}  // namespace pounding
