#pragma once
/// Common parts of all contact laws: their response, the history of an impact, the no-tension rule, and how that
/// history begins and is updated.
///
/// A law is a plain struct with parameters as members and
///
///     static constexpr std::string_view name;
///     void check() const;  // throws std::invalid_argument for an invalid value
///     Response contact(double penetration, double rate, const Impact&) const noexcept;  // formula without the cut-off
///     Response respond(double penetration, double rate, const Impact&) const noexcept;  // force on the bodies
///
/// and optionally
///
///     double damping_for(double closing_speed) const;  // dissipative laws
///     double corner(double penetration, double rate, const Impact&) const noexcept;  // changes sign at slope jumps
///     void keep(double penetration, double rate, Impact&) const noexcept;  // laws with memory
///     double stored_energy(double penetration, const Impact&) const noexcept;  // see stored_energy() below
///     double crushed(const Impact&) const noexcept;  // see crushes
///     double indentation(const Impact&) const noexcept;  // see crushes
///     bool needs_closing_speed() const noexcept;  // see designed_for_speed
///     double softening(double penetration, const Impact&) const noexcept;  // see designed_for_speed
///     bool heals() const noexcept;  // see heals() below
///     static constexpr bool is_dashpot = true;  // see is_dashpot below
///
/// `contact` extends the formula smoothly beyond the end of contact; its sign changes where the force is released.
/// `respond` is zero for an open gap and never pulls, unless the law has `static constexpr bool may_pull = true`.
///
/// Sign: penetration d > 0 [m] is overlap, rate d' > 0 [m/s] closes, force > 0 [N] pushes apart. SI units.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include <pounding/base/gauss.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// x if `kept`, else +0. A bit mask: for arrays of unordered states, branch misprediction would cost more than
/// evaluating a typical law.
constexpr double only_if(bool kept, double x) noexcept {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & -std::uint64_t{kept});
}

/// Force and its two derivatives.
struct Response {
  double force = 0;           ///< [N]
  double by_penetration = 0;  ///< dF/dd [N/m]
  double by_rate = 0;         ///< dF/dd' [N s/m]
};

/// The response if `kept`, else all zeros.
constexpr Response only_if(bool kept, const Response& r) noexcept {
  return {only_if(kept, r.force), only_if(kept, r.by_penetration), only_if(kept, r.by_rate)};
}

/// History of the current impact: all data that a law may use in addition to the state. Links update it at accepted
/// states only.
struct Impact {
  double closing_speed = 0;        ///< rate at the touch, or the fixed design velocity [m/s]
  double damping = 0;              ///< coefficient of the law for this impact, in the law's own unit
  double largest_penetration = 0;  ///< running maximum in this impact [m]
  double slip = 0;                 ///< plastic slip of laws that have one [m]
  double crushed = 0;              ///< maximum penetration in earlier impacts, for laws that crush [m]
};

/// No-tension rule for a force [N]: contact cannot pull, so a force that is not positive becomes +0.
constexpr double no_tension(double force) noexcept { return only_if(force > 0, force); }
/// No-tension rule for force and derivatives: all are zero if the force is not positive.
constexpr Response no_tension(const Response& r) noexcept { return only_if(r.force > 0, r); }

/// Lower bound of the closing speed in damping formulas, which divide by it [m/s].
inline constexpr double slowest_closing_speed = 1e-6;

/// Closing speed used for calibration [m/s]: the fixed design velocity if there is one, otherwise the closing speed of
/// the impact; never below slowest_closing_speed.
constexpr double calibration_speed(const std::optional<double>& impact_velocity, double closing_speed) noexcept {
  return std::max(impact_velocity.value_or(closing_speed), slowest_closing_speed);
}

/// True for a law that pulls at the end of an impact, as published: it is exempt from the no-tension rule.
template <class L>
inline constexpr bool may_pull = requires { requires L::may_pull; };

/// True for a law with F = k d + c d' whose k and c change only with the phase of an impact.
template <class L>
inline constexpr bool is_linear = requires { requires L::is_linear; };

/// True if the contact ends when the force reaches zero, and the remaining penetration is added to the gap.
template <class L>
inline constexpr bool leaves_indentation = requires { requires L::leaves_indentation; };

/// True for a soil law, whose stiffness does not follow from two bodies.
template <class L>
inline constexpr bool presses_soil = requires { requires L::presses_soil; };

/// True for a law that is a velocity jump at the touch, without a force history.
template <class L>
inline constexpr bool instantaneous = requires { requires L::instantaneous; };

/// True for a law that accepts a restitution of 0: after the touch the bodies stay together until they are pulled
/// apart.
template <class L>
inline constexpr bool sticks_at_zero = requires { requires L::sticks_at_zero; };

/// True for a law with permanent crushing. `crushed` is the maximum penetration up to and including this impact, from
/// the undamaged surface [m]; `indentation` is the increase of the gap in this impact [m].
template <class L>
inline constexpr bool crushes = requires(const L& law, const Impact& impact) {
  law.crushed(impact);
  law.indentation(impact);
};

/// True for a law with these parameters that leaves no indentation although others of its type do: after the force has
/// ended, the surface follows the body while it separates. Its next force begins where the body reverses.
template <class L>
bool heals(const L& law) noexcept {
  if constexpr (requires { law.heals(); }) return law.heals();
  return false;
}

/// True for a law with a coefficient that is calibrated at each impact.
template <class L>
inline constexpr bool has_damping = requires(const L& law) { law.damping_for(1.0); };

/// True for a law with an expensive calibration of a damping that acts on the rate alone: none is needed at rest.
template <class L>
inline constexpr bool is_dashpot = requires { requires L::is_dashpot; };

/// True for a law whose stiffness is designed for the closing speed of each impact. `needs_closing_speed` is false if a
/// fixed design speed or the stiffness itself is given. `softening` is the ratio of the stiffness of an undamped
/// contact at a penetration to the design stiffness [-].
template <class L>
inline constexpr bool designed_for_speed = requires(const L& law, const Impact& impact) {
  law.needs_closing_speed();
  law.softening(1.0, impact);
};

/// Maximum softening of an impact. For an exponent of 1.5 it corresponds to a hundred times the design penetration; a
/// free impact stays below the design penetration.
inline constexpr double max_softening = 10;

/// Thrown if a contact is pressed so deep that its design stiffness is no longer valid. The message states which
/// parameters to give instead.
class BeyondDesign : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Throws BeyondDesign for a contact that is softer than max_softening allows at this penetration. This happens if
/// bodies touch almost at rest and other forces press them together.
template <class L>
void require_design(const L& law, double penetration, const Impact& impact) {
  if constexpr (designed_for_speed<L>) {
    if (!law.needs_closing_speed() || !(law.softening(penetration, impact) > max_softening)) return;
    throw BeyondDesign(std::string(L::name) + " designs its stiffness for the closing speed, " +
                       short_text(impact.closing_speed) + " m/s in this impact; it is " +
                       short_text(law.softening(penetration, impact)) + " times too soft at the penetration of " +
                       short_text(penetration) + " m; give a design speed, such as " +
                       "impact_velocity: 0.5 m/s, or initial_stiffness, secondary_stiffness and yield_penetration");
  }
}

/// Initial history of an impact. closing_speed is the rate at the touch [m/s]; `crushed` is that of
/// the previous impact [m].
template <class L>
Impact touch(const L& law, double closing_speed, double crushed = 0) {
  Impact impact{.closing_speed = closing_speed, .crushed = crushed};
  if constexpr (requires { law.impact_velocity; }) impact.closing_speed = law.impact_velocity.value_or(closing_speed);
  if constexpr (has_damping<L>) impact.damping = law.damping_for(closing_speed);
  return impact;
}

/// Initial history of a slow loading, for forces and their slopes by the penetration at a zero rate.
template <class L>
Impact slow_touch(const L& law) {
  if constexpr (is_dashpot<L>)
    return {};
  else
    return touch(law, 0);
}

/// Updates the history with an accepted state: the maximum penetration, and the memory of laws that have one.
template <class L>
void keep(const L& law, double penetration, double rate, Impact& impact) noexcept {
  impact.largest_penetration = std::max(impact.largest_penetration, penetration);
  if constexpr (requires { law.keep(penetration, rate, impact); }) law.keep(penetration, rate, impact);
}

/// Energy [J] recovered from the contact if the bodies separate slowly from this penetration [m]: the integral of the
/// force at rate zero. Laws whose force has corners there provide a member function. The integral of a force
/// proportional to d^n is exact for n = 1, 1.5, 2, ... 4, and accurate to 1e-7 between.
template <class L>
double stored_energy(const L& law, double penetration, const Impact& impact) noexcept {
  if (!(penetration > 0)) return 0;
  if constexpr (requires { law.stored_energy(penetration, impact); }) {
    return law.stored_energy(penetration, impact);
  } else {
    // Five-point Gauss rule in t, with x = penetration t^2.
    double sum = 0;
    for (int i = 0; i < 5; ++i) {
      const double t = gauss_points[i];
      sum += gauss_weights[i] * t * no_tension(law.contact(penetration * t * t, 0, impact).force);
    }
    return 2 * penetration * sum;
  }
}

/// Force on the bodies and derivatives: zero across an open gap, and without tension unless the law may pull. The
/// formula is always evaluated, so that compilers can hoist the terms that depend only on the impact out of loops over
/// states.
template <class L>
Response pressed(const L& law, double penetration, double rate, const Impact& impact) noexcept {
  const Response r = law.contact(penetration, rate, impact);
  return only_if(penetration > 0, may_pull<L> ? r : no_tension(r));
}

/// Throws std::invalid_argument unless damping is given exactly once: by a restitution or by one direct value.
template <class L>
void require_one_damping(const L& law) {
  std::string names, given;
  int count = 0;
  const auto note = [&](std::string_view name, const std::optional<double>& value) {
    names += (names.empty() ? "" : " or ") + std::string(name);
    if (value) given += (count++ ? " and " : "") + std::string(name);
  };
  note("restitution", law.restitution);
  for (const auto& p : L::parameters)
    if (p.info.need == Need::damping) note(p.info.name, law.*p.choice);
  const std::string name(L::name);
  if (count == 0) throw std::invalid_argument(name + " has no damping; give " + names);
  if (count > 1)
    throw std::invalid_argument(name + " takes one damping parameter, but " + given + " are given; remove all but one");
}

/// Throws std::invalid_argument for an invalid stiffness, exponent, damping, design velocity or reduced mass of a law
/// with a dashpot.
template <class L>
void check_dashpot(const L& law) {
  require_positive("stiffness", law.stiffness);
  if constexpr (requires { law.exponent; }) require_exponent(law.exponent);
  require_restitution(law.restitution, sticks_at_zero<L>);
  bool has_coefficient = false;
  for (const auto& p : L::parameters) {
    if (p.info.need != Need::damping) continue;
    require_not_negative(p.info.name, law.*p.choice);
    has_coefficient = has_coefficient || (p.info.name == L::coefficient.name && law.*p.choice);
  }
  if constexpr (requires { law.impact_velocity; }) require_positive("impact_velocity", law.impact_velocity);
  require_one_damping(law);
  if constexpr (requires { law.impact_velocity; })
    if (law.impact_velocity && has_coefficient)
      throw std::invalid_argument("impact_velocity has no effect together with " + std::string(L::coefficient.name) +
                                  "; remove one of them");
  if constexpr (requires { law.reduced_mass; }) {
    if (is_linear<L> && has_coefficient) return require_not_negative("reduced_mass", law.reduced_mass);
    require_positive("reduced_mass", law.reduced_mass);
  }
}

}  // namespace pounding::laws
