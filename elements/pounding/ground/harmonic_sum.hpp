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

  /// Sum at a time after the start [m/s^2], the duration not regarded.
  double acceleration(double after_start) const noexcept;
  /// Shortest of the periods [s].
  double shortest_period() const noexcept;
  /// Largest absolute acceleration [m/s^2], to 1e-4 of the sum of all amplitudes; that sum where the duration is longer
  /// than 10000 times the shortest period.
  double peak() const;
};

}  // namespace pounding
