#pragma once
/// A bilinear spring with kinematic hardening: a yielding storey.

#include <pounding/hysteresis/bilinear.hpp>
#include <pounding/structures/hysteretic_spring.hpp>
#include "support/loaded.hpp"

namespace pounding {

/// F = a k u + (1 - a) k clamp(u - s, -Fy/k, Fy/k): a spring a k in parallel with an elastic-perfectly plastic spring
/// with slip s, see hysteresis::Bilinear. evaluate() returns F - k u, which is -(1 - a) k s in the elastic range. Its
/// slope is -(1 - a) k during yielding and zero otherwise; at the yield point it is that of the elastic side.
class BilinearSpring final : public HystereticSpring<hysteresis::Bilinear> {
 public:
  /// Force-deformation curve: slope k up to Fy, then a k.
  struct Parameters {
    double stiffness = 0;    ///< k > 0 [N/m]
    double yield_force = 0;  ///< Fy > 0 [N]
    double hardening = 0;    ///< a in [0, 1); 0 is perfectly plastic [-]
  };
  /// Undeformed. Throws std::invalid_argument for a parameter that is out of range or not finite.
  explicit BilinearSpring(const Parameters& p)
      : HystereticSpring({.initial_stiffness = p.stiffness, .yield_force = p.yield_force, .hardening = p.hardening}) {}

  /// Plastic part of the deformation [m].
  static double slip(ConstElementMemory memory) noexcept { return kept(memory).slip; }
};

namespace test {

/// A bilinear spring in isolation.
class LoadedBilinear : public Loaded<BilinearSpring, BilinearSpring::Parameters> {
 public:
  using Loaded::Loaded;
  double slip() const noexcept { return BilinearSpring::slip(memory()); }
};

}  // namespace test
}  // namespace pounding
