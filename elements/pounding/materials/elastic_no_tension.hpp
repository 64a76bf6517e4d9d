#pragma once
#include <array>
#include <cmath>
#include <string_view>

#include <pounding/materials/material.hpp>

namespace pounding::materials {

/// s = E min(e, 0).
///
/// s [Pa] stress, e [-] strain, E [Pa] modulus in compression.
struct ElasticNoTension : ByPieces<ElasticNoTension> {
  static constexpr std::string_view name = "elastic_no_tension", shape = "s = E min(e, 0)";
  static constexpr std::string_view summary = "elastic in compression, no tension (ENT)";
  static constexpr std::string_view source = "closed form";
  static constexpr std::string_view symbols = "E [Pa] modulus in compression";
  static constexpr std::string_view range = "any strain", beware = "never crushes";
  static constexpr bool is_symmetric = false, is_cubic = true, forgets_small_reversals = true;

  double E = 0;  ///< > 0 [Pa]

  static constexpr std::array parameters{Parameter{{"E", "Pa", "modulus in compression", 25e9}, &ElasticNoTension::E}};

  /// Accepted strain [-].
  struct State {
    double deformation = 0;
  };
  using Branch = State;
  static constexpr std::array<StateValue<ElasticNoTension>, 0> state{};

  void check() const { laws::require_positive("E", E); }
  double stiffness() const noexcept { return E; }
  /// Infinite.
  double yield_deformation() const noexcept { return HUGE_VAL; }

  Branch branch(const State& kept) const noexcept { return kept; }
  Answer respond(const State&, double strain) const noexcept {
    return {strain < 0 ? E * strain : 0, strain <= 0 ? E : 0};
  }
  State advance(const State&, double strain) const noexcept { return {strain}; }
  std::array<double, 1> corners(const State&) const noexcept { return {0}; }
  double unloaded(const State& kept) const noexcept { return kept.deformation < 0 ? 0 : kept.deformation; }
};

}  // namespace pounding::materials
