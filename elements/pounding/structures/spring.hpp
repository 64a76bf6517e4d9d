#pragma once
/// Forces between two points beside those of the linear structures: of storeys and hinges that yield, of bars and
/// dampers.

#include <limits>
#include <optional>

#include <pounding/core/archive.hpp>
#include <pounding/links/contact.hpp>

namespace pounding {

/// The force on top of k u, as a function of the deformation (LinkMotion::penetration) from the last kept state on,
/// where k is the stiffness that the structures are assembled with: that of a storey or a hinge, none for what joins
/// two structures. It pulls the two points together where it is positive. Histories move at kept steps only.
class Spring {
 public:
  virtual ~Spring() = default;

  /// Pure. force is that of the spring minus k times the deformation, so the slope of a storey is not positive [N],
  /// [N/m].
  virtual laws::Response evaluate(const LinkMotion& motion) const noexcept = 0;
  /// evaluate() for a deformation that comes so slowly that nothing in it damps.
  virtual laws::Response evaluate_slowly(double deformation) const noexcept { return evaluate({deformation, 0}); }
  /// k [N/m].
  virtual double stiffness() const noexcept { return 0; }
  /// Slope of evaluate() before anything has yielded: of what the structures are not assembled with [N/m].
  virtual double first_slope() const noexcept { return 0; }
  /// Deformations between which, on any way from the last kept state, nothing but the deformation changes, and the
  /// force of evaluate() is this one to the bit. Nothing where there is no such range.
  struct Elastic {
    double low = 0, high = 0;  ///< [m]
    double force = 0;          ///< [N]
  };
  virtual std::optional<Elastic> elastic() const noexcept { return {}; }
  /// As accept(), for a step that stayed strictly inside elastic() and ended at this deformation.
  virtual void stay(double /*deformation*/) {}
  /// Size of the deformation at which it first yields, in the weaker direction [m]; infinite for what never does.
  virtual double yield_deformation() const noexcept { return std::numeric_limits<double>::infinity(); }
  /// This size in the direction of a positive or of a negative deformation.
  virtual double yields_towards(double /*way*/) const noexcept { return yield_deformation(); }
  /// The first deformation on the straight way from the last kept one to this one at which the slope jumps, itself
  /// excluded; nothing where it does not jump.
  virtual std::optional<double> corner(double /*deformation*/) const noexcept { return {}; }
  /// How much the slope that it has at the end of the straight way to this deformation is below the one with which it
  /// turns back [N/m].
  virtual double slope_lost(double deformation) const noexcept { return -evaluate({deformation, 0}).by_penetration; }
  /// Whether the force depends on the rate as well, so that bend() says where its corners are, not corner().
  virtual bool bends_with_rate() const noexcept { return false; }
  /// The first instant at which such a force has a corner on a path from the last kept state, from 0 to 1; nothing
  /// where it has none. What is no further than `near` from an end does not count.
  virtual std::optional<double> bend(const Quintic& /*path*/, double /*near*/) const noexcept { return {}; }
  /// Whether the force has corners, at which steps end.
  virtual bool has_corners() const noexcept { return true; }
  /// Whether a dashpot inside it gets longer by its own force, so that the force depends on the path in time. The
  /// integrator keeps its length, LinkMotion::slip.
  virtual bool slips() const noexcept { return false; }
  /// Rate at which that dashpot gets longer [m/s]. Pure.
  virtual double slip_rate(const LinkMotion& /*motion*/) const noexcept { return 0; }
  /// Its length where the run begins with this motion [m].
  virtual double first_slip(const LinkMotion& /*motion*/) const noexcept { return 0; }
  /// The run begins with this motion, or goes on from it after somebody changed it.
  virtual void start(const LinkMotion& /*motion*/) {}
  /// A step was kept.
  virtual void accept(const LinkStep& step) = 0;
  /// Force and loss at one instant.
  struct Instant {
    double force = 0;  ///< as evaluate() gives it [N]
    double lost = 0;   ///< by yielding until then, as lost() [J]
  };
  /// At s from 0 to 1 of the step that was kept last, where the deformation is this [m], so that histories are exact
  /// between the ends of steps. Pure. Written here for springs without memory.
  virtual Instant inside(const LinkStep& step, double s, double deformation) const noexcept {
    return {evaluate({deformation, interpolate(step, s).rate}).force, lost()};
  }
  /// Whether the force may bend so sharply inside this kept step that a parabola through its ends and its middle misses
  /// a peak.
  virtual bool bends_sharply(const LinkStep& /*step*/) const noexcept { return false; }
  /// Energy that the spring has lost by yielding [J].
  virtual double lost() const noexcept = 0;
  /// Energy that it has lost by damping [J].
  virtual double damped() const noexcept { return 0; }
  /// Energy that it stores, minus k/2 times the square of its deformation [J].
  virtual double stored_correction() const noexcept = 0;
  virtual void archive(Archive& archive) = 0;
};

}  // namespace pounding
