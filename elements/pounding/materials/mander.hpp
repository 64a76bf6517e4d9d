#pragma once
/// Strength and strains of concrete confined by hoops. Mander, Priestley & Park 1988, Theoretical stress-strain model
/// for confined concrete, Journal of Structural Engineering 114(8).

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include <pounding/laws/checks.hpp>

namespace pounding::materials {

/// Rectangular core within hoops. SI units; strengths are positive.
struct ConfinedCore {
  double strength = 0;            ///< unconfined strength fco [Pa]
  double strain = 0.002;          ///< unconfined strain eco at fco [-]
  double width = 0, depth = 0;    ///< between the centre lines of the perimeter hoop, bc and dc [m]
  double bars = 0;                ///< total area of the longitudinal bars in the core [m^2]
  double hoops_across_width = 0;  ///< area of the hoop legs parallel to the width [m^2]
  double hoops_across_depth = 0;  ///< area of the hoop legs parallel to the depth [m^2]
  double spacing = 0;             ///< of hoops along the member, centre to centre, s [m]
  double clear_spacing = 0;       ///< of hoops along the member, s' [m]
  double hoop_strength = 0;       ///< yield stress fyh of the hoops [Pa]
  double hoop_strain = 0.1;       ///< strain of the hoops at their tensile strength, e_su [-]
};

/// Properties of confined concrete; strengths and strains are positive.
struct Confinement {
  double effectiveness = 0;                             ///< confinement effectiveness ke [-]
  double pressure_in_width = 0, pressure_in_depth = 0;  ///< effective lateral pressures [Pa]
  double strength = 0;                                  ///< fcc [Pa]
  double strain = 0;                                    ///< ecc at fcc [-]
  double ultimate_strain = 0;                           ///< ecu at the first fracture of a hoop [-]
};

/// Ratio of confined to unconfined strength under two lateral pressures divided by the unconfined strength: the
/// five-parameter surface of William and Warnke with the meridians that Elwi and Murray (1979) fitted to the tests of
/// Schickert and Winkler, as in Mander et al. For equal pressures x it agrees with their equation 29, -1.254 + 2.254
/// sqrt(1 + 7.94 x) - 2 x, to the digits of the coefficients.
inline double confined_strength_ratio(double one, double other) {
  const double s1 = -std::min(one, other), s2 = -std::max(one, other);
  const auto next = [&](double ratio) {
    const double s3 = -ratio, mean = (s1 + s2 + s3) / 3;
    const double shear = std::sqrt((s1 - s2) * (s1 - s2) + (s2 - s3) * (s2 - s3) + (s3 - s1) * (s3 - s1)) / 3;
    const double cosine = (s1 - mean) / (std::sqrt(2.0) * shear);
    const double tension = 0.069232 - (0.661091 + 0.049350 * mean) * mean;
    const double compression = 0.122965 - (1.150502 + 0.315545 * mean) * mean;
    const double difference = 4 * (compression * compression - tension * tension) * cosine * cosine;
    const double excess = 2 * tension - compression;
    const double root = std::sqrt(difference + (5 * tension - 4 * compression) * tension);
    const double limit = compression * (0.5 * difference / cosine + excess * root) / (difference + excess * excess);
    return std::sqrt(4.5 * limit * limit - 0.75 * (s1 - s2) * (s1 - s2)) - 0.5 * (s1 + s2);
  };
  double ratio = 1;
  for (int i = 0; i < 500; ++i) {
    const double better = next(ratio);
    if (std::abs(better - ratio) < 1e-14 * ratio) return better;
    ratio = better;
  }
  throw std::invalid_argument("the lateral pressures of the hoops are outside the range of the strength surface");
}

/// Confinement of a rectangular core. `clear_distances` [m]: between adjacent longitudinal bars that hoop corners or
/// cross ties hold, around the perimeter, w'. The ultimate strain is 0.004 + 1.4 rho_s fyh e_su/fcc (Paulay & Priestley
/// 1992, equation 3.12). Throws std::invalid_argument for an invalid dimension.
inline Confinement confine(const ConfinedCore& core, std::span<const double> clear_distances) {
  for (const auto& [name, value] : {std::pair{"strength", core.strength},
                                    {"strain", core.strain},
                                    {"width", core.width},
                                    {"depth", core.depth},
                                    {"spacing", core.spacing},
                                    {"fyh", core.hoop_strength},
                                    {"hoops_across_width", core.hoops_across_width},
                                    {"hoops_across_depth", core.hoops_across_depth},
                                    {"hoop_strain", core.hoop_strain}})
    laws::require_positive(name, value);
  const double area = core.width * core.depth;
  if (!(core.bars >= 0 && core.bars < area)) laws::refuse("bars", core.bars, "less than the area of the core");
  if (!(core.clear_spacing >= 0 && core.clear_spacing < 2 * std::min(core.width, core.depth)))
    laws::refuse("clear_spacing", core.clear_spacing, "less than twice the smaller dimension of the core");
  double arches = 0;
  for (const double w : clear_distances) arches += w * w / 6;
  if (!(arches < area)) laws::refuse("clear_distances", std::sqrt(6 * arches), "small compared with the core");

  Confinement result;
  result.effectiveness = (1 - arches / area) * (1 - core.clear_spacing / (2 * core.width)) *
                         (1 - core.clear_spacing / (2 * core.depth)) / (1 - core.bars / area);
  const double across_width = core.hoops_across_width / (core.spacing * core.depth);
  const double across_depth = core.hoops_across_depth / (core.spacing * core.width);
  result.pressure_in_width = result.effectiveness * across_width * core.hoop_strength;
  result.pressure_in_depth = result.effectiveness * across_depth * core.hoop_strength;
  result.strength = core.strength * confined_strength_ratio(result.pressure_in_width / core.strength,
                                                            result.pressure_in_depth / core.strength);
  result.strain = core.strain * (1 + 5 * (result.strength / core.strength - 1));
  result.ultimate_strain =
      0.004 + 1.4 * (across_width + across_depth) * core.hoop_strength * core.hoop_strain / result.strength;
  return result;
}

/// Stress of confined concrete at its ultimate strain, > 0 [Pa]: fcc x r/(r - 1 + x^r), x = ecu/ecc, r = Ec/(Ec -
/// fcc/ecc), Ec = 5000 MPa sqrt(fco/MPa), for an unconfined strength fco [Pa]. Mander, Priestley & Park 1988.
inline double strength_at_ultimate(const Confinement& confined, double unconfined_strength) {
  const double modulus = 5e9 * std::sqrt(unconfined_strength / 1e6), secant = confined.strength / confined.strain;
  const double r = modulus / (modulus - secant), x = confined.ultimate_strain / confined.strain;
  return confined.strength * x * r / (r - 1 + std::pow(x, r));
}

}  // namespace pounding::materials
