#pragma once
/// Shared by all laws of yielding: their answer, what they are, and what follows from it.
///
/// A law is a plain struct with parameters as members and
///
///     static constexpr std::string_view name;
///     struct State { double deformation = 0; ... };                   // the last kept state; by itself undeformed
///     void check() const;                                             // std::invalid_argument for a wrong parameter
///     double stiffness() const noexcept;                              // k > 0, before anything has yielded
///     double yield_deformation() const noexcept;                      // > 0, counts ductility
///     Answer respond(const State&, double d) const noexcept;          // at the end of the straight way to d
///     State advance(const State&, double d) const noexcept;           // that end is kept
///     double stored(const State&) const noexcept;                     // energy that the state can give back
///     double work(const State&, double d) const noexcept;             // of the force, on the straight way to d
///     std::optional<double> corner(const State&, double d) const noexcept;  // where the slope first jumps on it
///     static constexpr bool has_corners;                              // optional: false where no corner() is ever
///     given static constexpr double gives_back;                             // optional, see gives_back below Answer
///     excess(const State&, double d) const noexcept;           // optional, see excess() below double lost(const
///     State&, double d) const noexcept;             // optional, see lost() below double stored_excess(const State&)
///     const noexcept;              // optional, see stored_excess() below Range elastic(const State&) const noexcept;
///     // optional, see Range below
///
/// All are pure: a law holds no history, its State does, and only `advance` makes a new one. The path between two kept
/// states is followed exactly, so it does not matter where a way without a turn is cut into steps.
///
/// Units: a deformation d is in m, a force in N, an energy in J; at a hinge d is in rad and the force a moment in N m.
/// The force has the sign of a spring: positive where d grew from rest.

#include <concepts>
#include <optional>
#include <string_view>
#include <type_traits>

namespace pounding::hysteresis {

/// Force [N] and its slope along the way [N/m]. At a corner the slope is that before it; at the kept deformation
/// itself, where there is no way, that of one of the two directions.
struct Answer {
  double force = 0, slope = 0;
};

/// Deformations strictly between which excess() is constant to the bit and advance() changes the deformation alone, on
/// whatever way, and nothing is lost [m].
struct Range {
  double low = 0, high = 0;
};

/// A law of yielding.
template <class L>
concept Law = requires(const L& law, const typename L::State& kept, double d) {
  requires std::is_trivially_copyable_v<typename L::State> && std::is_default_constructible_v<typename L::State>;
  { kept.deformation } -> std::convertible_to<double>;
  { L::name } -> std::convertible_to<std::string_view>;
  law.check();
  { law.stiffness() } noexcept -> std::same_as<double>;
  { law.yield_deformation() } noexcept -> std::same_as<double>;
  { law.respond(kept, d) } noexcept -> std::same_as<Answer>;
  { law.advance(kept, d) } noexcept -> std::same_as<typename L::State>;
  { law.stored(kept) } noexcept -> std::same_as<double>;
  { law.work(kept, d) } noexcept -> std::same_as<double>;
  { law.corner(kept, d) } noexcept -> std::same_as<std::optional<double>>;
};

/// False for a law whose slope jumps at turning points alone.
template <Law L>
inline constexpr bool has_corners = !requires { requires !L::has_corners; };

/// Energy that a path may give back beyond what stored() says, over the yield force times the yield deformation: 0 but
/// for published laws that cannot be cured of it.
template <Law L>
inline constexpr double gives_back = [] {
  if constexpr (requires { L::gives_back; }) return L::gives_back;
  return 0.0;
}();

/// The answer minus that of an elastic spring k d, exactly nothing where the law says that it is one.
template <Law L>
Answer excess(const L& law, const typename L::State& kept, double d) noexcept {
  if constexpr (requires { law.excess(kept, d); }) {
    return law.excess(kept, d);
  } else {
    const Answer all = law.respond(kept, d);
    return {all.force - law.stiffness() * d, all.slope - law.stiffness()};
  }
}

/// Energy that is lost on the straight way to d [J]: the work less what is stored by it.
template <Law L>
double lost(const L& law, const typename L::State& kept, double d) noexcept {
  if constexpr (requires { law.lost(kept, d); })
    return law.lost(kept, d);
  else
    return law.work(kept, d) - (law.stored(law.advance(kept, d)) - law.stored(kept));
}

/// Energy that is stored [J] beyond that of an elastic spring, k d^2/2.
template <Law L>
double stored_excess(const L& law, const typename L::State& kept) noexcept {
  if constexpr (requires { law.stored_excess(kept); })
    return law.stored_excess(kept);
  else
    return law.stored(kept) - 0.5 * law.stiffness() * kept.deformation * kept.deformation;
}

/// Whether x lies between the two others and is neither of them.
constexpr bool is_strictly_between(double x, double a, double b) noexcept {
  return b > a ? x > a && x < b : x < a && x > b;
}

}  // namespace pounding::hysteresis
