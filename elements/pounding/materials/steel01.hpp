#pragma once
#include <array>
#include <string_view>

#include <pounding/hysteresis/bilinear.hpp>
#include <pounding/hysteresis/made_of.hpp>
#include <pounding/materials/material.hpp>

namespace pounding::materials {

/// s = b E0 e + (1-b) E0 clamp(e - p, -ey, ey): the bilinear law with kinematic hardening.
///
/// s [Pa] stress, e [-] strain, Fy [Pa] yield stress, E0 [Pa] modulus, b [-] hardening ratio, ey = Fy/E0 [-], p [-]
/// plastic strain.
struct Steel01 : hysteresis::MadeOf<Steel01, hysteresis::Bilinear> {
  static constexpr std::string_view name = "steel01", shape = "s = b E0 e + (1-b) E0 clamp(e - p, -ey, ey)";
  static constexpr std::string_view summary = "bilinear steel with kinematic hardening (Steel01)";
  static constexpr std::string_view source = hysteresis::Bilinear::source;
  static constexpr std::string_view symbols =
      "Fy [Pa] yield stress, E0 [Pa] modulus, b [-] hardening ratio, ey = Fy/E0 [-], p [-] plastic strain";
  static constexpr std::string_view range = "0 <= b < 1";
  static constexpr std::string_view beware =
      "without the isotropic hardening a1 to a4 of OpenSees, with which any small reversal changes later stresses";
  static constexpr bool forgets_small_reversals = true;

  double Fy = 0;  ///< > 0 [Pa]
  double E0 = 0;  ///< > 0 [Pa]
  double b = 0;   ///< in [0, 1) [-]

  static constexpr std::array parameters{Parameter{{"Fy", "Pa", "yield stress", 460e6}, &Steel01::Fy},
                                         Parameter{{"E0", "Pa", "modulus", 200e9}, &Steel01::E0},
                                         Parameter{{"b", "", "hardening ratio", 0.01}, &Steel01::b}};
  using Branch = State;
  static constexpr std::array state{
      StateValue<Steel01>{{"plastic_strain", "", "plastic strain p"}, [](const State& kept) { return kept.slip; }}};

  void check() const {
    laws::require_positive("Fy", Fy);
    laws::require_positive("E0", E0);
    if (!(b >= 0 && b < 1)) laws::refuse("b", b, "in [0, 1)");
  }
  /// The law of springs with these parameters.
  hysteresis::Bilinear made() const noexcept { return {.initial_stiffness = E0, .yield_force = Fy, .hardening = b}; }
  Branch branch(const State& kept) const noexcept { return kept; }
};

}  // namespace pounding::materials
