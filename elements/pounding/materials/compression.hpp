#pragma once
/// Compression of concrete: envelope of Kent and Park, and straight unloading.

#include <cmath>

#include <pounding/materials/material.hpp>

namespace pounding::materials {

/// Throws std::invalid_argument unless the value is finite and negative.
inline void require_negative(std::string_view name, double value) {
  if (!(std::isfinite(value) && value < 0))
    laws::refuse(name, value, "finite and negative, since compression is negative");
}

/// Throws std::invalid_argument unless the value is finite and below a negative bound.
inline void require_below(std::string_view name, double value, std::string_view bound_name, double bound) {
  if (!(std::isfinite(value) && value < bound))
    laws::refuse(name, value, "below " + std::string(bound_name) + ", which is " + laws::number_text(bound));
}

/// Envelope in compression: a parabola to (epsc0, fpc), a line to (epsU, fpcu), constant beyond. Kent & Park 1971;
/// Scott, Park & Priestley 1982.
struct KentPark {
  double fpc = 0;    ///< strength, < 0 [Pa]
  double epsc0 = 0;  ///< strain at the strength, < 0 [-]
  double fpcu = 0;   ///< crushing strength, in [fpc, 0] [Pa]
  double epsU = 0;   ///< strain at the crushing strength, < epsc0 [-]

  /// Rows of a table of parameters.
  static constexpr hysteresis::ParameterInfo fpc_info{"fpc", "Pa", "compressive strength (negative)", -30e6},
      epsc0_info{"epsc0", "", "strain at the strength (negative)", -0.002},
      fpcu_info{"fpcu", "Pa", "crushing strength (negative)", -6e6},
      epsU_info{"epsU", "", "strain at the crushing strength (negative)", -0.006};

  void check() const {
    require_negative("fpc", fpc);
    require_negative("epsc0", epsc0);
    if (!(fpcu >= fpc && fpcu <= 0)) laws::refuse("fpcu", fpcu, "between fpc and 0");
    require_below("epsU", epsU, "epsc0", epsc0);
  }
  /// Initial modulus 2 fpc/epsc0 [Pa].
  double stiffness() const noexcept { return 2 * fpc / epsc0; }
  double yield_deformation() const noexcept { return -epsc0; }
  /// Stress on the envelope at a strain of 0 or less.
  Answer envelope(double strain) const noexcept {
    const double r = strain / epsc0, softening = (fpcu - fpc) / (epsU - epsc0);
    const double line = fpc + softening * (strain - epsc0);
    const bool is_rising = strain >= epsc0, is_softening = strain > epsU;
    return {is_rising      ? fpc * r * (2 - r)
            : is_softening ? line
                           : fpcu,
            is_rising      ? stiffness() * (1 - r)
            : is_softening ? softening
                           : 0};
  }
};

/// A straight line of unloading and reloading: zero stress at `end`.
struct Unloading {
  double slope = 0, end = 0;
};

/// Line from the minimum strain to the residual strain of Karsan & Jirsa 1969, at most as steep as the initial modulus.
/// Beyond `crushing`, the residual strain remains constant.
inline Unloading karsan_jirsa(double minimum, double stress, double modulus, double epsc0, double crushing) noexcept {
  const double eta = std::fmax(minimum, crushing) / epsc0;
  const double ratio = eta < 2 ? 0.145 * eta * eta + 0.13 * eta : 0.707 * (eta - 2) + 0.834;
  const double length = minimum - ratio * epsc0;
  if (!(length < 0) || length > stress / modulus) return {modulus, minimum - stress / modulus};
  return {stress / length, ratio * epsc0};
}

}  // namespace pounding::materials
