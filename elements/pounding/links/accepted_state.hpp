#pragma once
/// Updates of a contact by the accepted states of a host program that does not locate touches and separations.

#include <pounding/laws/law.hpp>
#include <pounding/links/contact_state.hpp>

namespace pounding {

/// Updates the history with an accepted state: an approach of the two ends [m] and its rate [m/s]. An impact begins
/// with the first state in which the bodies overlap, and ends with the first in which they do not; with a law that
/// leaves an indentation also when the force has returned to zero. Throws laws::BeyondDesign.
template <class Law>
void accept(const Law& law, double relative_displacement, double rate, ContactState& state) {
  const double d = state.penetration(relative_displacement);
  const bool touching = presses(state.phase);
  if (!(d > 0)) {
    if (touching) state.end(law, 0);
    return;
  }
  if (!touching) state.begin(law, rate);
  if (laws::leaves_indentation<Law> && !laws::heals(law) && !(law.contact(d, rate, state.impact).force > 0))
    return state.end(law, d);
  state.keep(law, d, rate);
}

}  // namespace pounding
