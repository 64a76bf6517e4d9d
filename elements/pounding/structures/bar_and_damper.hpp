#pragma once
/// Components of devices: an elastic bar, a damper.

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
/// For a = 1 it is linear. For a < 1 the slope at v = 0 would be infinite, so the power law is regularised for a != 1,
///
///   f = c v (v^2 + v0^2)^((a-1)/2),
///
/// with a relative error of (a-1)/2 (v0/v)^2: for a = 0.35 and v0 = 1 mm/s, the force is 1.3 % too low at 5 mm/s and
/// 0.003 % at 100 mm/s (Constantinou & Symans 1993, The Structural Design of Tall Buildings 2, 93-132, for the power
/// law).
///
/// With a stiffness, the damper is in series with a spring that represents its own flexibility and that of its brace: a
/// Maxwell element. The force is f = k_d s with the stretch s of the spring. The dashpot elongates at the rate
/// (|f|/c)^(1/a) sign f, without regularisation:
///
///   df/dt = k_d (v - (|f|/c)^(1/a) sign f).
struct Damper {
  static constexpr double min_exponent = 0.05, largest_exponent = 2;
  /// Lower bound on the relaxation time a c/k_d of a Maxwell element at 1 m/s [s]. Smaller values give the same motion
  /// at a higher cost: the number of steps is inversely proportional to this time, about 10,000 per second at the
  /// bound. Braces of real dampers exceed 1e-5 s.
  static constexpr double shortest_relaxation = 1e-8;

  double coefficient = 0;           ///< c > 0 [N (s/m)^a]
  double exponent = 1;              ///< a in [0.05, 2]
  double rounding_velocity = 1e-3;  ///< v0 > 0 [m/s]; unused for a = 1 and with a stiffness
  double stiffness = 0;             ///< k_d > 0 of the spring in series [N/m]; 0 for a rigid connection

  bool is_linear() const noexcept { return exponent == 1; }  ///< linear, without regularisation
  double force(double rate) const noexcept;                  ///< [N]
  double slope(double rate) const noexcept;                  ///< derivative of the force, positive [N s/m]

  bool has_stiffness() const noexcept { return stiffness > 0; }  ///< if true, force() and slope() do not apply
  /// Elongation rate [m/s] of the dashpot in series with a spring of this stretch [m].
  double slip_rate(double stretch) const noexcept;
  /// Stretch s [m] that satisfies s + lag slip_rate(s) = length; 0 for an infinite lag [s].
  double stretch(double length, double lag) const noexcept;
  /// Derivative of stretch() with respect to the length, in [0, 1].
  double stretch_slope(double stretch, double lag) const noexcept;
  /// Throws std::invalid_argument for a value out of range.
  void check() const;
};

}  // namespace pounding
