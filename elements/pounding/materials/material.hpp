#pragma once
/// Common parts of all uniaxial materials of fibres: the required members, and the part that most of them share.
///
/// A material is a hysteretic law (hysteresis/law.hpp) whose deformation is a strain [-] and whose force is a stress
/// [Pa]; energies are per volume [J/m^3]. Tension is positive. It also provides
///
///     struct Branch { double ...; };  // numbers of the response that depend on the state only
///     Branch branch(const State&) const noexcept;  // computed when a step is accepted
///     Answer respond(const Branch&, double strain) const noexcept;  // free of branches, so that a loop vectorizes
///     static constexpr bool forgets_small_reversals;  // a reversal of size e changes later stresses by O(e)
///
/// If it is false, no error tolerance applies to results. Any material may serve as a spring, and any hysteretic law
/// with a Branch as a fibre. Parameters have the names of OpenSees; compressive strengths and strains are negative.

#include <concepts>
#include <optional>
#include <type_traits>

#include <pounding/hysteresis/integral.hpp>
#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding::materials {

using hysteresis::Answer;
using hysteresis::Parameter;
using hysteresis::StateValue;

/// True if a reversal of size e changes later stresses by O(e): constant, or of a material that depends on another one.
template <class M>
constexpr bool forgets_small_reversals(const M& law) noexcept {
  if constexpr (requires { law.forgets_small_reversals(); })
    return law.forgets_small_reversals();
  else
    return M::forgets_small_reversals;
}

/// A uniaxial material.
template <class M>
concept Material = hysteresis::Law<M> && requires(const M& law, const typename M::State& kept,
                                                  const typename M::Branch& branch, double strain) {
  requires std::is_trivially_copyable_v<typename M::Branch>;
  { law.branch(kept) } noexcept -> std::same_as<typename M::Branch>;
  { law.respond(branch, strain) } noexcept -> std::same_as<Answer>;
  { materials::forgets_small_reversals(law) } noexcept -> std::same_as<bool>;
};

/// Base of a material Self whose stress is smooth between some strains. Self provides branch(), respond(branch,
/// strain), advance(), and
///
///     auto corners(const State&) const noexcept;  // array, unsorted, of the strains of slope jumps in both directions
///
///     double unloaded(const State&) const noexcept;  // strain at zero stress on direct unloading
///
///     static constexpr bool is_cubic = true;  // optional: a polynomial of degree 3 or less between corners
///
/// Strains that are not strictly ahead, or not a number, are ignored.
template <class Self>
struct ByPieces {
  template <class State>
  Answer respond(const State& kept, double strain) const noexcept {
    return self().respond(self().branch(kept), strain);
  }
  template <class State>
  std::optional<double> corner(const State& kept, double strain) const noexcept {
    const double first = next(self().corners(kept), kept.deformation, strain);
    return first == strain ? std::nullopt : std::optional(first);
  }
  template <class State>
  double work(const State& kept, double strain) const noexcept {
    const auto corners = self().corners(kept);
    const auto branch = self().branch(kept);
    double sum = 0;
    for (double begin = kept.deformation; begin != strain;) {
      const double end = next(corners, begin, strain);
      sum += piece([&](double x) { return self().respond(branch, x).force; }, begin, end);
      begin = end;
    }
    return sum;
  }
  template <class State>
  double stored(const State& kept) const noexcept {
    return 0 - work(kept, self().unloaded(kept));
  }

 private:
  const Self& self() const noexcept { return static_cast<const Self&>(*this); }
  /// First of some strains strictly between two strains; the second one if there is none.
  template <class Strains>
  static double next(const Strains& strains, double begin, double end) noexcept {
    for (const double at : strains)
      if (hysteresis::is_strictly_between(at, begin, end)) end = at;
    return end;
  }
  template <class Stress>
  double piece(const Stress& stress, double a, double b) const noexcept {
    if constexpr (requires { requires Self::is_cubic; }) {
      // Gauss rule of two points, exact for cubic polynomials.
      const double middle = 0.5 * (a + b), offset = 0.28867513459481287 * (b - a);
      return 0.5 * (b - a) * (stress(middle - offset) + stress(middle + offset));
    } else {
      const double dy = self().yield_deformation();
      return hysteresis::integral(stress, a, b, 1e-14 * self().stiffness() * dy * dy);
    }
  }
};

}  // namespace pounding::materials
