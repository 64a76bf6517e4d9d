#pragma once
/// Forces between two points in addition to those of the linear structures: yielding storeys and hinges, bars and
/// dampers.

#include <limits>
#include <optional>

#include <pounding/core/archive.hpp>
#include <pounding/links/contact.hpp>

namespace pounding {

/// Force in addition to k u, as a function of the deformation (LinkMotion::penetration) from the last accepted state. k
/// is the stiffness contained in the stiffness matrix: that of a storey or a hinge, zero for a device between two
/// structures. A positive force pulls the two points together. The history changes only at accepted steps.
class Spring {
 public:
  virtual ~Spring() = default;

  /// Pure. The force is that of the spring minus k times the deformation [N], so the slope of a storey is not positive
  /// [N/m].
  virtual laws::Response evaluate(const LinkMotion& motion) const noexcept = 0;
  /// evaluate() for a quasi-static deformation, without damping.
  virtual laws::Response evaluate_slowly(double deformation) const noexcept { return evaluate({deformation, 0}); }
  /// k [N/m].
  virtual double stiffness() const noexcept { return 0; }
  /// Initial slope of evaluate(), of a slack cable when taut: the stiffness that the stiffness matrix does not contain
  /// [N/m].
  virtual double first_slope() const noexcept { return 0; }
  /// Range of deformations in which, on any path from the last accepted state, only the deformation changes and the
  /// force of evaluate() is bitwise constant. `nullopt` if there is none.
  struct Elastic {
    double low = 0, high = 0;  ///< [m]
    double force = 0;          ///< [N]
  };
  virtual std::optional<Elastic> elastic() const noexcept { return {}; }
  /// As accept(), for a step that stayed strictly inside elastic() and ended at this deformation.
  virtual void stay(double /*deformation*/) {}
  /// Magnitude of the deformation at first yield, in the weaker direction [m]; infinite for an elastic spring.
  virtual double yield_deformation() const noexcept { return std::numeric_limits<double>::infinity(); }
  /// This magnitude in the direction of positive or negative deformations.
  virtual double yields_towards(double /*way*/) const noexcept { return yield_deformation(); }
  /// First deformation at which the slope jumps on the straight path from the last accepted state (exclusive);
  /// `nullopt` if there is none.
  virtual std::optional<double> corner(double /*deformation*/) const noexcept { return {}; }
  /// Decrease of the slope from unloading to loading: the slope after a reversal at the end of the straight path to
  /// this deformation, minus that before it [N/m].
  virtual double slope_lost(double deformation) const noexcept { return -evaluate({deformation, 0}).by_penetration; }
  /// Force at first yield [N].
  virtual double yield_force() const noexcept { return (stiffness() + first_slope()) * yield_deformation(); }
  /// True if the force also depends on the rate, so that its corners are reported by bend() and not by corner().
  virtual bool bends_with_rate() const noexcept { return false; }
  /// First corner of such a force on a path from the last accepted state, from 0 to 1; `nullopt` if there is none.
  /// Corners within `near` of an end are ignored.
  virtual std::optional<double> bend(const Quintic& /*path*/, double /*near*/) const noexcept { return {}; }
  /// True if the force has corners, at which steps end.
  virtual bool has_corners() const noexcept { return true; }
  /// True if the spring contains a dashpot in series, whose elongation depends on its own force, so that the force
  /// depends on the path in time. The integrator stores the elongation in LinkMotion::slip.
  virtual bool slips() const noexcept { return false; }
  /// Elongation rate of that dashpot [m/s]. Pure.
  virtual double slip_rate(const LinkMotion& /*motion*/) const noexcept { return 0; }
  /// Elongation of the dashpot at the start of a run with this motion [m].
  virtual double first_slip(const LinkMotion& /*motion*/) const noexcept { return 0; }
  /// Called when a run starts with this motion, or resumes from it after it was modified.
  virtual void start(const LinkMotion& /*motion*/) {}
  /// Loads the spring slowly and monotonically from its present state to this deformation, before a run; counts the
  /// loss. For an initial displacement beyond yield.
  virtual void load(double /*deformation*/) {}
  /// Called for each accepted step.
  virtual void accept(const LinkStep& step) = 0;
  /// Force and loss at one instant.
  struct Instant {
    double force = 0;  ///< as returned by evaluate() [N]
    double lost = 0;   ///< by yielding up to this instant, as lost() [J]
  };
  /// At s from 0 to 1 of the last accepted step, for this deformation [m], so that histories are exact between the ends
  /// of steps. Pure. The default is for springs without memory.
  virtual Instant inside(const LinkStep& step, double s, double deformation) const noexcept {
    return {evaluate({deformation, interpolate(step, s).rate}).force, lost()};
  }
  /// True if the force may change so sharply inside this accepted step that a parabola through its ends and its middle
  /// misses a peak.
  virtual bool bends_sharply(const LinkStep& /*step*/) const noexcept { return false; }
  /// Energy dissipated by yielding [J].
  virtual double lost() const noexcept = 0;
  /// Energy dissipated by damping [J].
  virtual double damped() const noexcept { return 0; }
  /// Stored energy minus k/2 times the square of the deformation [J].
  virtual double stored_correction() const noexcept = 0;
  virtual void archive(Archive& archive) = 0;
};

}  // namespace pounding
