#pragma once
/// Parts of devices: an elastic bar, a damper.

namespace pounding {

/// An elastic bar: f = k d. d [m] elongation, f > 0 is tension [N].
struct Bar {
  double stiffness = 0;  ///< k > 0 [N/m]

  double force(double elongation) const noexcept { return stiffness * elongation; }  ///< [N]
  /// Throws std::invalid_argument for a stiffness that is not positive and finite.
  void check() const;
};

/// A viscous damper: f = c |v|^a sign v. v [m/s] rate of elongation, f > 0 is tension [N].
///
/// With a = 1 it is linear. Below a = 1 the slope at v = 0 would be infinite, so every other power is rounded there,
///
///   f = c v (v^2 + v0^2)^((a-1)/2),
///
/// which is c |v|^a but for a part (a-1)/2 (v0/v)^2: with a = 0.35 and v0 = 1 mm/s the force is 1.3 % smaller at 5 mm/s
/// and 0.003 % at 100 mm/s (Constantinou & Symans 1993, The Structural Design of Tall Buildings 2, 93-132, for the
/// power law).
///
/// With a stiffness the damper stands in series with a spring, which real ones and their braces are: a Maxwell element.
/// Its force is the same all along it, f = k_d s with the stretch s of the spring, and the dashpot gets longer at the
/// rate (|f|/c)^(1/a) sign f, which needs no rounding:
///
///   df/dt = k_d (v - (|f|/c)^(1/a) sign f),   a <= 1.
struct Damper {
  static constexpr double least_exponent = 0.2, largest_exponent = 2;
  /// Lower bound on the relaxation time a c/k_d of a Maxwell element at 1 m/s [s]. Stiffer ones give the same motion at
  /// the cost of round-off: the number of steps is inversely proportional to this time, some 10,000 per second at the
  /// bound. Braces of real dampers take above 1e-5 s.
  static constexpr double shortest_relaxation = 1e-8;

  double coefficient = 0;           ///< c > 0 [N (s/m)^a]
  double exponent = 1;              ///< a in [0.2, 2]
  double rounding_velocity = 1e-3;  ///< v0 > 0 [m/s]; without a part where a = 1, and beside a stiffness
  double stiffness = 0;             ///< k_d > 0 of the spring in series [N/m]; 0 for a rigid one

  bool is_linear() const noexcept { return exponent == 1; }  ///< and not rounded
  double force(double rate) const noexcept;                  ///< [N]
  double slope(double rate) const noexcept;                  ///< of the force, positive [N s/m]

  bool has_stiffness() const noexcept { return stiffness > 0; }  ///< then force() and slope() do not hold
  /// Rate at which the dashpot behind a spring with this stretch [m] gets longer [m/s].
  double slip_rate(double stretch) const noexcept;
  /// The stretch s [m] that leaves s + lag slip_rate(s) = length, for a lag [s] that may be infinite, where the answer
  /// is 0.
  double stretch(double length, double lag) const noexcept;
  /// Its derivative by the length, in [0, 1].
  double stretch_slope(double stretch, double lag) const noexcept;
  /// Throws std::invalid_argument for a number that is out of range.
  void check() const;
};

}  // namespace pounding
