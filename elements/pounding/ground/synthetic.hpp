#pragma once
/// Artificial earthquakes: seeded noise through a ground filter, so that examples need no recorded accelerogram.

#include <cstdint>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Filter of Clough and Penzien (Dynamics of Structures, 2nd ed. 1993, 23-4): the soil layer of Kanai and Tajimi, which
/// amplifies around w_g, and a second filter that removes what lies below w_f.
struct GroundFilter {
  double omega_g;  ///< w_g of the soil layer [rad/s]
  double zeta_g;   ///< its damping ratio [-]
  double omega_f;  ///< w_f of the low cut [rad/s]
  double zeta_f;   ///< its damping ratio [-]
};

/// Filters for three soils: Der Kiureghian and Neuenhofer, Earthq. Eng. Struct. Dyn. 21 (1992) 713.
inline constexpr GroundFilter firm_soil{15.0, 0.6, 1.5, 0.6};
inline constexpr GroundFilter medium_soil{10.0, 0.4, 1.0, 0.6};
inline constexpr GroundFilter soft_soil{5.0, 0.2, 0.5, 0.6};

/// A synthetic motion: the same options give the same samples.
struct SyntheticOptions {
  std::uint64_t seed = 0;
  double duration = 0;  ///< [s]
  double pga = 0;       ///< largest |acceleration| of the samples, met exactly [m/s^2]
  double step = 0.01;   ///< [s]; the last one ends at or before `duration`
  GroundFilter filter = firm_soil;
  /// The noise grows with (t/rise)^2, is strong until `strong_until`, and then decays exponentially to 2 % at the end:
  /// the envelope of Amin and Ang (J. Eng. Mech. Div. ASCE 94 (1968) 559), as parts of the duration.
  double rise = 0.15, strong_until = 0.5;
};

/// Samples of the absolute ground acceleration. White noise, made non-stationary by the envelope, drives the two
/// filters from rest, so that velocity and displacement of the ground stay bounded and no baseline needs to be
/// corrected. Normal numbers come from the bits of std::mt19937_64 by the Box-Muller formula and not from a library's
/// distribution: a seed means the same earthquake everywhere, to the rounding of log and cos. Throws
/// std::invalid_argument when a value lies outside its range, or `step` is too long for the filter (w step > 1/2).
GroundMotion synthetic_motion(const SyntheticOptions& options);

}  // namespace pounding
