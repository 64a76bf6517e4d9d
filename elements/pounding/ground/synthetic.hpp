#pragma once
/// Artificial earthquakes: filtered noise from a seed, so that examples need no recorded accelerogram.

#include <cstdint>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// Filter of Clough and Penzien (Dynamics of Structures, 2nd ed. 1993, 23-4): the Kanai-Tajimi soil layer, which
/// amplifies around w_g, and a high-pass filter that removes frequencies below w_f.
struct GroundFilter {
  double omega_g;  ///< w_g of the soil layer [rad/s]
  double zeta_g;   ///< its damping ratio [-]
  double omega_f;  ///< w_f of the high-pass filter [rad/s]
  double zeta_f;   ///< its damping ratio [-]
};

/// Filters for three soils: Der Kiureghian and Neuenhofer, Earthq. Eng. Struct. Dyn. 21 (1992) 713.
inline constexpr GroundFilter firm_soil{15.0, 0.6, 1.5, 0.6};
inline constexpr GroundFilter medium_soil{10.0, 0.4, 1.0, 0.6};
inline constexpr GroundFilter soft_soil{5.0, 0.2, 0.5, 0.6};

/// A synthetic motion; equal options give equal samples.
struct SyntheticOptions {
  std::uint64_t seed = 0;
  double duration = 0;  ///< [s]
  double pga = 0;       ///< maximum |acceleration| of the samples, exact [m/s^2]
  double step = 0.01;   ///< [s]; the last step ends at or before `duration`
  GroundFilter filter = firm_soil;
  /// The envelope of Amin and Ang (J. Eng. Mech. Div. ASCE 94 (1968) 559), with times as fractions of the duration: the
  /// noise grows with (t/rise)^2, is constant until `strong_until`, and then decays exponentially to 2 % at the end.
  double rise = 0.15, strong_until = 0.5;
};

/// Samples of the absolute ground acceleration. White noise, made nonstationary by the envelope, drives the two filters
/// from rest, so that velocity and displacement of the ground remain bounded without a baseline correction. Normal
/// random numbers are computed from std::mt19937_64 by the Box-Muller formula instead of a library distribution: a seed
/// defines the same earthquake on all platforms, up to the round-off of log and cos. Throws std::invalid_argument for a
/// value out of range, and for a `step` that is too long for the filter (w step > 1/2).
GroundMotion synthetic_motion(const SyntheticOptions& options);

}  // namespace pounding
