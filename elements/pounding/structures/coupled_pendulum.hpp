#pragma once
/// A friction pendulum with friction along the direction of sliding.

#include <pounding/structures/coupled_yielding.hpp>
#include <pounding/structures/sliding_spring.hpp>

namespace pounding {

/// f = W d/R + q, |q| <= mu(|v|) W in series with a spring k0 = mu_fast W/u_y, with vectors f, d and q; the slip
/// follows the direction of q. v is the rate of d.
///
/// Parameters and mu as in SlidingFriction; slow = fast for constant friction. A law with q bounded by a circle, such
/// as lead rubber in both directions, is the case W = Q, mu = 1, R = Q/k2. Zayas, Low & Mahin 1990, Earthq. Spectra
/// 6:317; Mosqueda, Whittaker & Fenves 2004, J. Struct. Eng. 130:433; singleFPBearing of OpenSees in space. In contrast
/// to the latter, the axial force is the constant weight W, and the surface is a paraboloid.
///
/// A straight path with constant friction is exact: the angle between q and the path decreases by tan(angle/2) ~
/// exp(-k0 x/(mu W)). If the friction changes, it has its final value on the whole straight path.
class CoupledPendulum final : public CoupledYielding {
 public:
  /// Throws std::invalid_argument for a parameter out of range.
  explicit CoupledPendulum(const SlidingFriction& friction) : law_(friction) { law_.check(); }

  double stiffness(int) const noexcept override { return law_.dish() + law_.stick(); }
  double yield_deformation(int) const noexcept override { return law_.sliding_deformation; }

 protected:
  Flow flow(const State& state, const Pair& deformation, double speed) const noexcept override;
  double lost_stiffness(int) const noexcept override { return law_.stick(); }
  int min_pieces() const noexcept override { return law_.slow < law_.fast ? 8 : 1; }

 private:
  /// mu W/k0 [m].
  double reach(double speed) const noexcept { return law_.coefficient(speed) * law_.weight / law_.stick(); }

  SlidingFriction law_;
};

}  // namespace pounding
