#pragma once
/// Shared by all contact laws: their answer, the history of an impact that they may use, the no-tension rule, and how
/// that history begins and moves.
///
/// A law is a plain struct with parameters as members and
///
///     static constexpr std::string_view name;
///     void check() const;                                            // std::invalid_argument for a wrong value
///     double damping_for(double closing_speed) const;                // dissipative laws only
///     Response contact(double penetration, double rate, const Impact&) const noexcept;  // the formula, uncut
///     Response respond(double penetration, double rate, const Impact&) const noexcept;  // what acts on the bodies
///     double corner(double penetration, double rate, const Impact&) const noexcept;  // optional: changes sign where
///     slopes jump void keep(double penetration, double rate, Impact&) const noexcept;               // laws with
///     memory only double stored_energy(double penetration, const Impact&) const noexcept;  // optional, see
///     stored_energy() below double crushed(const Impact&) const noexcept;                                     // laws
///     that crush only, see crushes double indentation(const Impact&) const noexcept; bool needs_closing_speed() const
///     noexcept;                        // optional, see designed_for_speed below double softening(double penetration,
///     const Impact&) const noexcept;
///
/// `contact` continues the formula smoothly past its end, and its sign tells where the force is released; `respond` is
/// zero for an open gap and never pulls, unless the law says `static constexpr bool may_pull = true`.
///
/// Sign: penetration d > 0 [m] is overlap, rate d' > 0 [m/s] closes, force > 0 [N] pushes apart. SI units.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include <pounding/laws/checks.hpp>
#include <pounding/laws/gauss.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// x where `kept`, else +0. A bit mask: on arrays of unordered states a mispredicted branch would cost more than most
/// laws.
constexpr double only_if(bool kept, double x) noexcept {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & -std::uint64_t{kept});
}

/// Force and its two slopes, from one call.
struct Response {
  double force = 0;           ///< [N]
  double by_penetration = 0;  ///< dF/dd [N/m]
  double by_rate = 0;         ///< dF/dd' [N s/m]
};

/// The answer where `kept`, else all zeros.
constexpr Response only_if(bool kept, const Response& r) noexcept {
  return {only_if(kept, r.force), only_if(kept, r.by_penetration), only_if(kept, r.by_rate)};
}

/// History of the present impact, all that a law may use beside the state. The link writes it, at kept states only.
struct Impact {
  double closing_speed = 0;        ///< rate at the touch, or the fixed design velocity [m/s]
  double damping = 0;              ///< the law's coefficient for this impact, in the law's own unit
  double largest_penetration = 0;  ///< so far in this impact [m]
  double slip = 0;                 ///< plastic slip of laws that have one [m]
  double crushed = 0;  ///< deepest penetration of all impacts before, from the sound surface, of laws that crush [m]
};

/// The no-tension rule, for a force [N]: contact cannot pull, so a force that is not positive becomes +0.
constexpr double no_tension(double force) noexcept { return only_if(force > 0, force); }
/// The no-tension rule, for force and slopes: all are zero where the force is not positive.
constexpr Response no_tension(const Response& r) noexcept { return only_if(r.force > 0, r); }

/// Lower bound of the closing speed in damping formulas, which divide by it [m/s].
inline constexpr double slowest_closing_speed = 1e-6;

/// The speed that calibrates an impact [m/s]: the fixed design velocity when there is one, else the fresh closing
/// speed, never below slowest_closing_speed.
constexpr double calibration_speed(const std::optional<double>& impact_velocity, double closing_speed) noexcept {
  return std::max(impact_velocity.value_or(closing_speed), slowest_closing_speed);
}

/// True for a law that pulls at the end of an impact, as published: it is exempt from the no-tension rule.
template <class L>
inline constexpr bool may_pull = requires { requires L::may_pull; };

/// True for a law with F = k d + c d', whose k and c change with the phase of an impact only.
template <class L>
inline constexpr bool is_linear = requires { requires L::is_linear; };

/// True where the contact ends as the force reaches zero, and the penetration left then is added to the gap.
template <class L>
inline constexpr bool leaves_indentation = requires { requires L::leaves_indentation; };

/// True for a law of soil, whose stiffness follows from no pair of bodies.
template <class L>
inline constexpr bool presses_soil = requires { requires L::presses_soil; };

/// True for a law that is a jump of the velocity at the touch; it has no force history.
template <class L>
inline constexpr bool instantaneous = requires { requires L::instantaneous; };

/// True for a law that takes a restitution of 0: the bodies stay together after the touch until something pulls them
/// apart.
template <class L>
inline constexpr bool sticks_at_zero = requires { requires L::sticks_at_zero; };

/// True for a law that remembers how deep the bodies were crushed: `crushed` is the deepest penetration so far, this
/// impact included, from the sound surface [m], and `indentation` what this impact has added to the gap [m].
template <class L>
inline constexpr bool crushes = requires(const L& law, const Impact& impact) {
  law.crushed(impact);
  law.indentation(impact);
};

/// True for a law with a coefficient that is calibrated at each impact.
template <class L>
inline constexpr bool has_damping = requires(const L& law) { law.damping_for(1.0); };

/// True for a law whose stiffness is designed for the closing speed of each impact. `needs_closing_speed` is false if a
/// fixed design speed or the stiffness itself is given. `softening` is the stiffness of an undamped contact at a
/// penetration over that of the design [-].
template <class L>
inline constexpr bool designed_for_speed = requires(const L& law, const Impact& impact) {
  law.needs_closing_speed();
  law.softening(1.0, impact);
};

/// Largest softening of an impact. It is reached at a hundred times the design penetration for an exponent of 1.5; a
/// free impact stays below the design penetration.
inline constexpr double max_softening = 10;

/// A contact was pressed so deep that the design of its stiffness no longer holds. The text says what to give instead.
class BeyondDesign : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Throws BeyondDesign for a contact that is softer than max_softening allows at this penetration: bodies that touch
/// nearly at rest and are pressed together by other forces.
template <class L>
void require_design(const L& law, double penetration, const Impact& impact) {
  if constexpr (designed_for_speed<L>) {
    if (!law.needs_closing_speed() || !(law.softening(penetration, impact) > max_softening)) return;
    throw BeyondDesign(std::string(L::name) + " takes its stiffness from the closing speed, " +
                       short_text(impact.closing_speed) + " m/s in this impact, and is " +
                       short_text(law.softening(penetration, impact)) + " times too soft at the penetration of " +
                       short_text(penetration) + " m; give a design speed, such as " +
                       "impact_velocity: 0.5 m/s, or initial_stiffness, secondary_stiffness and yield_penetration");
  }
}

/// An impact begins: what the law may know of it. closing_speed is the rate at the touch [m/s], `crushed` that of the
/// impact before.
template <class L>
Impact touch(const L& law, double closing_speed, double crushed = 0) {
  Impact impact{.closing_speed = closing_speed, .crushed = crushed};
  if constexpr (requires { law.impact_velocity; }) impact.closing_speed = law.impact_velocity.value_or(closing_speed);
  if constexpr (has_damping<L>) impact.damping = law.damping_for(closing_speed);
  return impact;
}

/// A state was kept: the largest penetration grows, and a law with memory moves it.
template <class L>
void keep(const L& law, double penetration, double rate, Impact& impact) noexcept {
  impact.largest_penetration = std::max(impact.largest_penetration, penetration);
  if constexpr (requires { law.keep(penetration, rate, impact); }) law.keep(penetration, rate, impact);
}

/// Energy [J] that the contact gives back when the bodies part slowly from this penetration [m]: the integral of the
/// force at rate zero. A law whose force has corners there answers by a member of its own. The integral of a force in
/// proportion to d^n is exact for n = 1, 1.5, 2, ... up to 4, and right to 1e-7 between them.
template <class L>
double stored_energy(const L& law, double penetration, const Impact& impact) noexcept {
  if (!(penetration > 0)) return 0;
  if constexpr (requires { law.stored_energy(penetration, impact); }) {
    return law.stored_energy(penetration, impact);
  } else {
    // Gauss's rule with five points in t, where x = penetration t^2.
    double sum = 0;
    for (int i = 0; i < 5; ++i) {
      const double t = gauss_points[i];
      sum += gauss_weights[i] * t * no_tension(law.contact(penetration * t * t, 0, impact).force);
    }
    return 2 * penetration * sum;
  }
}

/// Force on the bodies, and slopes: zero across an open gap, and without tension unless the law may pull. The formula
/// is evaluated in any case: in a loop over states the part of it that depends on the impact alone is then computed
/// once.
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
  if (count == 0) throw std::invalid_argument(name + " needs its damping: give " + names);
  if (count > 1)
    throw std::invalid_argument(name + " takes its damping once, but " + given + " are given; keep one of them");
}

/// Throws std::invalid_argument for a wrong stiffness, exponent, damping, design velocity or reduced mass of a law with
/// a dashpot.
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
      throw std::invalid_argument("impact_velocity has no effect beside " + std::string(L::coefficient.name) +
                                  "; leave one of them out");
  if constexpr (requires { law.reduced_mass; }) {
    if (is_linear<L> && has_coefficient) return require_not_negative("reduced_mass", law.reduced_mass);
    require_positive("reduced_mass", law.reduced_mass);
  }
}

}  // namespace pounding::laws
