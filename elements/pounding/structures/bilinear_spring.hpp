#pragma once
/// A bilinear spring with kinematic hardening: a storey that yields.

#include <pounding/structures/spring.hpp>

namespace pounding {

/// F = a k u + (1 - a) k clamp(u - s, -Fy/k, Fy/k): a spring a k beside an elastic, perfectly plastic one with the slip s.
///
/// k [N/m] initial stiffness, Fy [N] force at the first yield, a [-] stiffness after it over k, u [m] deformation.
/// Loading follows k up to Fy, then a k; unloading follows k over a range of 2 Fy, whatever went before. The slip moves
/// by the return mapping of one-dimensional plasticity, exact for a deformation that does not turn within a step; where it
/// turns, accept() follows it to the turning points of the cubic through both ends of the step (Simo & Hughes 1998,
/// Computational Inelasticity, section 1.4).
///
/// As a Spring it answers F - k u, which is -(1 - a) k s while it is elastic; its slope is -(1 - a) k while it yields, else
/// zero, and at the yield point that of the elastic side. There is no dashpot.
class BilinearSpring final : public Spring {
 public:
  /// Its force over deformation: slope k up to Fy, then a k.
  struct Parameters {
    double stiffness = 0;    ///< k > 0 [N/m]
    double yield_force = 0;  ///< Fy > 0 [N]
    double hardening = 0;    ///< a in [0, 1); 0 is perfectly plastic [-]
  };
  /// Undeformed. Throws std::invalid_argument for a parameter that is out of range or not finite.
  explicit BilinearSpring(const Parameters& parameters);

  laws::Response evaluate(const LinkMotion& motion) const noexcept override;
  double stiffness() const noexcept override { return parameters_.stiffness; }
  double yield_deformation() const noexcept override { return yield_point_; }
  std::optional<double> corner(double deformation) const noexcept override;
  void accept(const LinkStep& step) override;
  double lost() const noexcept override { return lost_; }
  double stored_correction() const noexcept override;
  void archive(Archive& archive) override;

  /// Plastic part of the deformation [m].
  double slip() const noexcept { return slip_; }

 private:
  void follow(double deformation);

  Parameters parameters_;
  double yielding_;     // (1 - a) k, the part of the stiffness that yields [N/m]
  double yield_point_;  // Fy/k [m]
  double slip_ = 0, deformation_ = 0;  // at the last kept state [m]
  double lost_ = 0;
};

}  // namespace pounding
