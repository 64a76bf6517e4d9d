#pragma once
#include <array>
#include <cmath>
#include <string_view>

#include <pounding/materials/material.hpp>

namespace pounding::materials {

/// s = E e.
///
/// s [Pa] stress, e [-] strain, E [Pa] modulus.
struct Elastic : ByPieces<Elastic> {
  static constexpr std::string_view name = "elastic", shape = "s = E e", summary = "linear elastic (Elastic)";
  static constexpr std::string_view source = "Hooke's law";
  static constexpr std::string_view symbols = "E [Pa] modulus";
  static constexpr std::string_view range = "any strain", beware = "never yields";
  static constexpr bool has_corners = false, is_cubic = true, forgets_small_reversals = true;

  double E = 0;  ///< > 0 [Pa]

  static constexpr std::array parameters{Parameter{{"E", "Pa", "modulus", 200e9}, &Elastic::E}};

  /// Accepted strain [-].
  struct State {
    double deformation = 0;
  };
  using Branch = State;
  static constexpr std::array<StateValue<Elastic>, 0> state{};

  void check() const { laws::require_positive("E", E); }
  double stiffness() const noexcept { return E; }
  /// Infinite.
  double yield_deformation() const noexcept { return HUGE_VAL; }

  Branch branch(const State& kept) const noexcept { return kept; }
  Answer respond(const State&, double strain) const noexcept { return {E * strain, E}; }
  State advance(const State&, double strain) const noexcept { return {strain}; }
  std::array<double, 0> corners(const State&) const noexcept { return {}; }
  double unloaded(const State&) const noexcept { return 0; }
};

}  // namespace pounding::materials
