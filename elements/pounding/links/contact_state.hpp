#pragma once
/// History of one contact, all that must be kept between two states: the same for a gap link and for the C interface.

#include <algorithm>
#include <cstdint>

#include <pounding/laws/law.hpp>

namespace pounding {

/// Phase of a contact. It is set from the state at a located instant, never toggled.
enum class ContactPhase : std::uint8_t {
  open,         ///< apart
  approach,     ///< pressed, still closing
  restitution,  ///< pressed, opening
  slack,        ///< overlapping, while the law's force would pull and is cut at zero
  resting       ///< held at zero rate by whatever force that needs (rigid contact after its last bounce)
};

/// Pressed together, with a force or held.
constexpr bool presses(ContactPhase phase) noexcept {
  return phase == ContactPhase::approach || phase == ContactPhase::restitution || phase == ContactPhase::resting;
}

/// History of one contact. It moves at kept states only, by the three functions below; copying it back takes a step
/// back.
struct ContactState {
  ContactPhase phase = ContactPhase::open;
  laws::Impact impact{};  ///< of the present impact; while the contact is open, of the one before
  double gap = 0;         ///< present gap [m]: the initial one and the indentation that the law has left in it

  /// Penetration [m] when the two ends have approached each other by `relative_displacement` [m] since the undeformed
  /// state.
  constexpr double penetration(double relative_displacement) const noexcept { return relative_displacement - gap; }

  /// An impact begins at this rate [m/s]; a negative one counts as zero. The law calibrates its damping here.
  template <class Law>
  void begin(const Law& law, double rate) {
    phase = ContactPhase::approach;
    impact = laws::touch(law, std::max(0.0, rate), impact.crushed);
  }

  /// The bodies are pressed together at rest by this penetration [m].
  template <class Law>
  void press(const Law& law, double penetration) {
    begin(law, 0);
    keep(law, penetration, 0);
  }

  /// A state inside the impact was kept: penetration [m] and rate [m/s]. Throws laws::BeyondDesign as
  /// laws::require_design() does.
  template <class Law>
  void keep(const Law& law, double penetration, double rate) {
    laws::require_design(law, penetration, impact);
    laws::keep(law, penetration, rate, impact);
  }

  /// The impact is over. `left` >= 0 is the penetration at which the force ended [m]; a law with permanent indentation
  /// adds it to the gap, or its own indentation where it remembers how deep the bodies were crushed.
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
