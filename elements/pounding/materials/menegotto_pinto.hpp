#pragma once
#include <array>
#include <cmath>
#include <string_view>

#include <pounding/hysteresis/made_of.hpp>
#include <pounding/hysteresis/menegotto_pinto.hpp>
#include <pounding/materials/material.hpp>

namespace pounding::materials {

/// s = b E e + (1-b) E z: the law of hysteresis/menegotto_pinto.hpp with nested memory.
///
/// s [Pa] stress, e [-] strain, Fy [Pa] yield stress, E [Pa] modulus, b [-] hardening ratio.
struct MenegottoPinto : hysteresis::MadeOf<MenegottoPinto, hysteresis::MenegottoPinto> {
  static constexpr std::string_view name = "menegotto_pinto", shape = "s = b E e + (1-b) E z";
  static constexpr std::string_view summary = "reinforcing steel with Bauschinger effect and nested memory";
  static constexpr std::string_view source = hysteresis::MenegottoPinto::source;
  static constexpr std::string_view symbols =
      "Fy [Pa] yield stress, E [Pa] modulus, b [-] hardening ratio, z [-] as in the law of springs";
  static constexpr std::string_view range = hysteresis::MenegottoPinto::range;
  static constexpr std::string_view beware =
      "without isotropic hardening, with which any small reversal would change later stresses. steel02 is the law of "
      "OpenSees";
  static constexpr double gives_back = hysteresis::MenegottoPinto::gives_back;
  static constexpr bool forgets_small_reversals = true;

  double Fy = 0;       ///< > 0 [Pa]
  double E = 0;        ///< > 0 [Pa]
  double b = 0;        ///< in [0, 1) [-]
  double R0 = 20;      ///< [-]
  double cR1 = 0.925;  ///< in [0, 1) [-]
  double cR2 = 0.15;   ///< > 0 [-]

  static constexpr std::array parameters{
      Parameter{{"Fy", "Pa", "yield stress", 460e6}, &MenegottoPinto::Fy},
      Parameter{{"E", "Pa", "modulus", 200e9}, &MenegottoPinto::E},
      Parameter{{"b", "", "hardening ratio", 0.01}, &MenegottoPinto::b},
      Parameter{{"R0", "", "sharpness of the first transition", 20, hysteresis::Need::optional}, &MenegottoPinto::R0},
      Parameter{{"cR1", "", "maximum relative reduction of R0", 0.925, hysteresis::Need::optional},
                &MenegottoPinto::cR1},
      Parameter{{"cR2", "", "plastic excursion, divided by Fy/E, at half of that reduction", 0.15,
                 hysteresis::Need::optional},
                &MenegottoPinto::cR2}};
  using Branch = State;
  static constexpr std::array state{
      StateValue<MenegottoPinto>{{"maximum", "", "maximum reversal"}, [](const State& kept) { return kept.maximum; }},
      StateValue<MenegottoPinto>{{"minimum", "", "minimum reversal"}, [](const State& kept) { return kept.minimum; }}};

  void check() const {
    laws::require_positive("Fy", Fy);
    laws::require_positive("E", E);
    if (!(b >= 0 && b < 1)) laws::refuse("b", b, "in [0, 1)");
    made().check();
  }
  /// The law of springs with these parameters.
  hysteresis::MenegottoPinto made() const noexcept {
    return {.initial_stiffness = E,
            .yield_force = Fy,
            .hardening = b,
            .sharpness = R0,
            .rounding = cR1,
            .rounding_range = cR2};
  }
  Branch branch(const State& kept) const noexcept { return kept; }
};

}  // namespace pounding::materials
