#pragma once
/// A law outside the catalogue, written as a user would.

#include <string_view>

#include <pounding/laws/viscous_hertz.hpp>

namespace pounding::reference {

/// F = k d^1.5 + c d' in approach and restitution, c = 2 xi sqrt(k sqrt(d) m), in contact until d = 0: it pulls at the
/// end.
///
/// k [N/m^1.5], xi [-], m [kg] reduced mass, d [m], d' [m/s]. `viscous_hertz` of exponent 1.5 and alpha = 2 xi, uncut.
struct JankowskiInBothPhases {
  static constexpr std::string_view name = "jankowski_in_both_phases";
  static constexpr bool may_pull = true;

  laws::ViscousHertz uncut;

  void check() const { uncut.check(); }
  double damping_for(double closing_speed) const { return uncut.damping_for(closing_speed); }
  laws::Response contact(double penetration, double rate, const laws::Impact& impact) const noexcept {
    return uncut.contact(penetration, rate, impact);
  }
  laws::Response respond(double penetration, double rate, const laws::Impact& impact) const noexcept {
    return laws::pressed(*this, penetration, rate, impact);
  }
};

inline JankowskiInBothPhases jankowski_in_both_phases_of(double xi, double stiffness, double reduced_mass) {
  return {{.stiffness = stiffness, .damping_ratio = 2 * xi, .reduced_mass = reduced_mass}};
}

}  // namespace pounding::reference
