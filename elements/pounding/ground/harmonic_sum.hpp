#pragma once
/// A sum of harmonics as a ground motion.

#include <vector>

namespace pounding {

/// a = sum of A_k sin(2 pi (t - start)/T_k + phase_k) for start <= t < start + duration, zero before and after.
struct HarmonicSum {
  /// One harmonic.
  struct Part {
    double amplitude;  ///< A_k [m/s^2]
    double period;     ///< T_k [s]
    double phase = 0;  ///< [rad]
  };
  std::vector<Part> parts;
  double duration;   ///< [s]
  double start = 0;  ///< [s]

  /// Sum at a time after the start [m/s^2], without regard to the duration.
  double acceleration(double after_start) const noexcept;
  /// Shortest period [s].
  double shortest_period() const noexcept;
  /// Maximum absolute acceleration [m/s^2], to 1e-4 of the sum of all amplitudes; for durations of more than 10000
  /// times the shortest period, that sum.
  double peak() const;
};

}  // namespace pounding
