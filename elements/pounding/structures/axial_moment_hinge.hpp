#pragma once
/// A plastic hinge with interaction of axial force and bending moment.

#include <pounding/structures/coupled_yielding.hpp>

namespace pounding {

/// N = a kN e + (1-a) kN (e - ep), M = a kM r + (1-a) kM (r - rp), e [m] elongation, r [rad] rotation, ep and rp
/// plastic. The forces kN (e - ep), kM (r - rp) stay within a yield surface, and (ep, rp) flows along its normal.
///
/// The surfaces, with m = M/Mp and n = N/Np: `parabola` |m| + n^2 = 1, exact for a rectangle of steel that is fully
/// plastic; `ellipse` m^2 + (n - n0)^2 = 1, n0 = N0/Np, for example for a column of reinforced concrete with its
/// largest moment at the compression N0 < 0. N > 0 is tension. a > 0 is a linear kinematic hardening.
/// Neal 1961, J. Appl. Mech. 28:269; Powell & Chen 1986, J. Struct. Eng. 112:627.
struct AxialMomentLaw {
  enum class Surface { parabola, ellipse };

  Surface surface = Surface::parabola;
  double axial_stiffness = 0;       ///< kN > 0 [N/m]
  double rotational_stiffness = 0;  ///< kM > 0 [N m/rad]
  double axial_capacity = 0;        ///< Np > 0 [N]
  double plastic_moment = 0;        ///< Mp > 0 [N m], largest moment of the surface
  double balanced_force = 0;        ///< N0 [N], |N0| < Np; 0 for the parabola
  double hardening = 0;             ///< a in [0, 1) [-]

  /// Throws std::invalid_argument for a value out of range.
  void check() const;
};

/// The hinge as an element: deformation 0 is the elongation, deformation 1 the rotation. A straight path is integrated
/// to about 1e-9 along the yield surface; within it, the element is exactly linear.
class AxialMomentHinge final : public CoupledYielding {
 public:
  /// Throws std::invalid_argument like check().
  explicit AxialMomentHinge(const AxialMomentLaw& law) : law_(law) { law_.check(); }

  double stiffness(int i) const noexcept override { return i == 0 ? law_.axial_stiffness : law_.rotational_stiffness; }
  double yield_deformation(int i) const noexcept override;

 protected:
  Flow flow(const State& state, const Pair& deformation, double speed) const noexcept override;
  double lost_stiffness(int i) const noexcept override { return (1 - law_.hardening) * stiffness(i); }

 private:
  AxialMomentLaw law_;
};

}  // namespace pounding
