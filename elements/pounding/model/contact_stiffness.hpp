#pragma once
/// Estimates of an unmeasured contact stiffness: from the slabs, from Hertz's theory, or from an admissible
/// penetration. Forces and accelerations at the contact depend on the stiffness, drifts hardly do.

#include <array>
#include <string>
#include <variant>

namespace pounding {

/// Material of two bodies, for Hertz's theory; concrete by default.
struct ContactMaterial {
  double young = 30e9;    ///< E [Pa]
  double poisson = 0.2;   ///< nu, 0 to 0.5
  double density = 2500;  ///< rho [kg/m^3]
};

/// Each body is a ball with its own mass and density, R = (3 m/(4 pi rho))^(1/3); a wall is flat. Used for `stiffness:
/// auto`.
struct StiffnessOfBalls {
  ContactMaterial material{};
};
/// Bodies with these radii at the contact [m]; an infinite one is flat. Hertz: k = (4/3) E/(2 (1 - nu^2)) sqrt(R1
/// R2/(R1 + R2)) (Goldsmith, Impact, 1960, section 4.2).
struct StiffnessOfRadii {
  std::array<double, 2> radii{};
  ContactMaterial material{};
};
/// Two slabs that collide end to end: 1/k = L1/(E A1) + L2/(E A2), with the section A [m^2] of each and the length L
/// [m] from the contact to the centre of mass of the floor. A slab of zero length is rigid.
struct StiffnessOfSlabs {
  double young = 30e9;  ///< E [Pa]
  std::array<double, 2> areas{}, lengths{};
};
/// Penetration [m] of a free elastic impact at `velocity` [m/s].
struct StiffnessOfPenetration {
  double penetration = 0, velocity = 0;
};

/// Method to estimate the stiffness of a contact.
using StiffnessEstimate = std::variant<StiffnessOfBalls, StiffnessOfRadii, StiffnessOfSlabs, StiffnessOfPenetration>;

/// Closing speed of the impact in which a spring of another exponent absorbs the same energy at the same penetration as
/// the estimate [m/s].
inline constexpr double estimate_speed = 0.5;

/// The bodies at the ends of a link.
struct CollidingMasses {
  std::array<double, 2> masses{};  ///< [kg]; infinite for a wall
  double reduced = 0;              ///< m1 m2/(m1 + m2) [kg]
};

/// Stiffness k [N/m^n] of a contact F = k d^n with this exponent n. Hertz's theory yields k for n = 1.5, slabs yield it
/// for n = 1; for another n the spring absorbs the same energy at the same maximum penetration in an elastic impact at
/// `estimate_speed`. Throws std::invalid_argument for numbers that are not positive and finite, and for balls if both
/// masses are infinite.
double estimated_stiffness(const StiffnessEstimate& estimate, const CollidingMasses& bodies, double exponent);

/// One line for reports: "Hertz, balls of 120 t and 120 t, E 30 GPa, nu 0.2".
std::string describe(const StiffnessEstimate& estimate, const CollidingMasses& bodies);

}  // namespace pounding
