#pragma once
/// Elastic response spectra, and the exact oscillator step used to compute them.

#include <span>
#include <vector>

#include <pounding/ground/ground_motion.hpp>

namespace pounding {

/// If the samples of a motion reach less than this fraction of its peak, their spectrum is too low.
inline constexpr double enough_of_the_peak = 0.95;

/// Motion of an oscillator relative to the ground.
struct OscillatorState {
  double displacement = 0;  ///< u [m]
  double velocity = 0;      ///< v [m/s]
};

/// Exact step of  u'' + 2 zeta w u' + w^2 u = -a(t)  over a time h with linear a(t).
///
/// Recurrence of Nigam and Jennings (Bull. Seism. Soc. Am. 59 (1969) 909). The coefficients are computed from power
/// series in w h, which, unlike the closed forms, are accurate for w h -> 0 and need no special case for zeta >= 1.
class OscillatorStep {
 public:
  /// w > 0 [rad/s], zeta >= 0 [-], h > 0 [s]; w h must be at most 1, so that the series converge quickly.
  OscillatorStep(double w, double zeta, double h);

  /// State after the step, from the state before it and the ground accelerations at both ends [m/s^2].
  OscillatorState advance(const OscillatorState& s, double a0, double a1) const noexcept {
    return {u_[0] * s.displacement + u_[1] * s.velocity + u_[2] * a0 + u_[3] * (a1 - a0),
            v_[0] * s.displacement + v_[1] * s.velocity + v_[2] * a0 + v_[3] * (a1 - a0)};
  }

 private:
  double u_[4], v_[4];  // responses to unit displacement, velocity, acceleration, and change of acceleration
};

/// Peaks of one oscillator.
struct SpectrumPoint {
  double period = 0;  ///< T [s]
  double sd = 0;      ///< maximum |relative displacement| [m]
  double psv = 0;     ///< pseudo-velocity, (2 pi/T) sd [m/s]
  double psa = 0;     ///< pseudo-acceleration, (2 pi/T)^2 sd [m/s^2]
};

/// Peak response of oscillators with these periods [s] and damping ratio [-], from rest until one period after the end
/// of the motion, which includes the maximum of the free vibration.
///
/// Exact for samples; a closed form is replaced by 720 linear pieces per period, which lowers the peak by about 6e-6
/// relative. Peaks between steps are those of the cubic through both ends. Throws std::invalid_argument for a period
/// that is not > 0 and a damping ratio outside [0, 1).
std::vector<SpectrumPoint> response_spectrum(const GroundMotion& motion, std::span<const double> periods,
                                             double damping);

}  // namespace pounding
