#pragma once
/// Common parts of all hysteretic laws: their response, the required members, and derived functions.
///
/// A law is a plain struct with parameters as members and
///
///     static constexpr std::string_view name;
///     struct State { double deformation = 0; ... };  // last accepted state; by default undeformed
///     void check() const;  // throws std::invalid_argument for an invalid parameter
///     double stiffness() const noexcept;  // initial stiffness k > 0
///     double yield_deformation() const noexcept;  // > 0, defines ductility
///     Answer respond(const State&, double d) const noexcept;  // at the end of the straight path to d
///     State advance(const State&, double d) const noexcept;  // accepts that end
///     double stored(const State&) const noexcept;  // recoverable energy
///     double work(const State&, double d) const noexcept;  // work of the force on the straight path to d
///     std::optional<double> corner(const State&, double d) const noexcept;  // first slope jump on it
///
/// and optionally
///
///     static constexpr bool has_corners;  // false if corner() is always empty
///     static constexpr double gives_back;  // see gives_back below
///     static constexpr bool ripples_give_back;  // see ripples_give_back below
///     static constexpr double cycle_gives_back;  // see cycle_gives_back below
///     Answer excess(const State&, double d) const noexcept;  // see excess() below
///     double lost(const State&, double d) const noexcept;  // see lost() below
///     double stored_excess(const State&) const noexcept;  // see stored_excess() below
///     Range elastic(const State&) const noexcept;  // see Range below
///
/// All functions are pure: the history is in State, and only `advance` creates a new one. The path between two accepted
/// states is integrated exactly, so the division of a monotonic path into steps does not matter.
///
/// Units: deformation d in m, force in N, energy in J; at a hinge d is in rad and the force is a moment in N m. Sign:
/// as for a spring, positive for a deformation d that increases from rest.

#include <concepts>
#include <optional>
#include <string_view>
#include <type_traits>

namespace pounding::hysteresis {

/// Force [N] and its slope along the path [N/m]. At a corner, the slope is that before it. At the accepted deformation
/// itself, it is that of either direction.
struct Answer {
  double force = 0, slope = 0;
};

/// Open range of deformations [m] in which, on any path, excess() is bitwise constant, advance() changes only the
/// deformation, and no energy is dissipated.
struct Range {
  double low = 0, high = 0;
};

/// A hysteretic law.
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

/// False for a law whose slope jumps only at reversals.
template <Law L>
inline constexpr bool has_corners = !requires { requires !L::has_corners; };

/// Upper bound on the energy that a path can recover beyond stored(), divided by yield force times yield deformation.
/// Nonzero only for published laws with this defect.
template <Law L>
inline constexpr double gives_back = [] {
  if constexpr (requires { L::gives_back; }) return L::gives_back;
  return 0.0;
}();

/// True for a published law whose small cycles can return energy, in total less than earlier cycles have lost.
template <Law L>
inline constexpr bool ripples_give_back = requires { requires L::ripples_give_back; };

/// Bound as gives_back, for a cycle that has been repeated a hundred times.
template <Law L>
inline constexpr double cycle_gives_back = [] {
  if constexpr (requires { L::cycle_gives_back; }) return L::cycle_gives_back;
  return 0.0;
}();

/// Response minus that of an elastic spring k d; exactly zero in the elastic range of laws that provide it.
template <Law L>
Answer excess(const L& law, const typename L::State& kept, double d) noexcept {
  if constexpr (requires { law.excess(kept, d); }) {
    return law.excess(kept, d);
  } else {
    const Answer all = law.respond(kept, d);
    return {all.force - law.stiffness() * d, all.slope - law.stiffness()};
  }
}

/// Energy dissipated on the straight path to d [J]: the work minus the increase of stored energy.
template <Law L>
double lost(const L& law, const typename L::State& kept, double d) noexcept {
  if constexpr (requires { law.lost(kept, d); })
    return law.lost(kept, d);
  else
    return law.work(kept, d) - (law.stored(law.advance(kept, d)) - law.stored(kept));
}

/// Stored energy [J] in excess of an elastic spring, k d^2/2.
template <Law L>
double stored_excess(const L& law, const typename L::State& kept) noexcept {
  if constexpr (requires { law.stored_excess(kept); })
    return law.stored_excess(kept);
  else
    return law.stored(kept) - 0.5 * law.stiffness() * kept.deformation * kept.deformation;
}

/// True if x lies strictly between the other two.
constexpr bool is_strictly_between(double x, double a, double b) noexcept {
  return b > a ? x > a && x < b : x < a && x > b;
}

}  // namespace pounding::hysteresis
