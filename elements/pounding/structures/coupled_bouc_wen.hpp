#pragma once
/// An isolator with a Bouc-Wen law that couples both horizontal directions.

#include <pounding/hysteresis/bouc_wen.hpp>
#include <pounding/structures/coupled_yielding.hpp>

namespace pounding {

/// f = a k d + (1-a) k z, dz = dd - z (z.dd) |z/dy|^n/|z|^2 (g + (1-g) sign(z.dd)), with vectors f, d and z.
///
/// Parameters as in hysteresis::BoucWen, with which it agrees on every straight path through the origin. Park, Wen &
/// Ang 1986, EESD 14:543; ElastomericBearingBoucWen of OpenSees in space, with eta = n, beta = 1 - g, gamma = g.
///
/// |z| <= dy in every direction. With the stored energy (1-a) k |z|^2/2 the law dissipates at any instant. A straight
/// path has a closed form for n = 2; for other n it is integrated to about 1e-9. For g < 1/2, z unloads on a curve.
class CoupledBoucWen final : public CoupledYielding {
 public:
  /// Throws std::invalid_argument for a parameter out of range.
  explicit CoupledBoucWen(const hysteresis::BoucWen& law) : law_(law) { law_.check(); }

  double stiffness(int) const noexcept override { return law_.stiffness(); }
  double yield_deformation(int) const noexcept override { return law_.yield_deformation(); }

 protected:
  Flow flow(const State& state, const Pair& deformation, double speed) const noexcept override;
  double lost_stiffness(int) const noexcept override { return (1 - law_.hardening) * law_.initial_stiffness; }

 private:
  hysteresis::BoucWen law_;
};

}  // namespace pounding
