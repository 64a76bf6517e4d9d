#pragma once
/// Elements with one deformation: yielding storeys and hinges, isolators, bars and dampers.

#include <limits>
#include <optional>
#include <utility>

#include <pounding/laws/law.hpp>
#include <pounding/structures/element.hpp>

namespace pounding {

/// Force in addition to k u, as a function of the deformation (LinkMotion::penetration) from the last accepted state. k
/// is the stiffness contained in the stiffness matrix: that of a storey or a hinge, zero for a device between two
/// structures. A positive force pulls the two points together. See Element for the memory.
class Spring : public Element {
 public:
  /// Pure. The force is that of the spring minus k times the deformation [N], so the slope of a storey is not positive
  /// [N/m].
  virtual laws::Response evaluate(ConstElementMemory memory, const LinkMotion& motion) const noexcept = 0;
  /// evaluate() for a quasi-static deformation, without damping.
  virtual laws::Response evaluate_slowly(ConstElementMemory memory, double deformation) const noexcept {
    return evaluate(memory, {deformation, 0});
  }
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
  virtual std::optional<Elastic> elastic(ConstElementMemory /*memory*/) const noexcept { return {}; }
  /// As accept(), for a step that stayed strictly inside elastic() and ended at this deformation.
  virtual void stay(ElementMemory /*memory*/, double /*deformation*/) const {}
  /// Magnitude of the deformation at first yield, in the weaker direction [m]; infinite for an elastic spring.
  virtual double yield_deformation() const noexcept { return std::numeric_limits<double>::infinity(); }
  /// This magnitude in the direction of positive or negative deformations.
  virtual double yields_towards(double /*way*/) const noexcept { return yield_deformation(); }
  /// First deformation at which the slope jumps on the straight path from the last accepted state (exclusive);
  /// `nullopt` if there is none.
  virtual std::optional<double> corner(ConstElementMemory /*memory*/, double /*deformation*/) const noexcept {
    return {};
  }
  /// Decrease of the slope from unloading to loading: the slope after a reversal at the end of the straight path to
  /// this deformation, minus that before it [N/m].
  virtual double slope_lost(ConstElementMemory memory, double deformation) const noexcept {
    return -evaluate(memory, {deformation, 0}).by_penetration;
  }
  /// Force at first yield [N].
  virtual double yield_force() const noexcept { return (stiffness() + first_slope()) * yield_deformation(); }
  /// True if the force also depends on the rate, so that its corners are reported by bend() and not by corner().
  virtual bool bends_with_rate() const noexcept { return false; }
  /// First corner of such a force on a path from the last accepted state, from 0 to 1; `nullopt` if there is none.
  /// Corners within `near` of an end are ignored.
  virtual std::optional<double> bend(ConstElementMemory /*memory*/, const Quintic& /*path*/,
                                     double /*near*/) const noexcept {
    return {};
  }
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
  virtual void start(ElementMemory /*memory*/, const LinkMotion& /*motion*/) const {}
  /// Loads the spring slowly and monotonically from its present state to this deformation, before a run; counts the
  /// loss. For an initial displacement beyond yield.
  virtual void load(ElementMemory /*memory*/, double /*deformation*/) const {}
  /// Called for each accepted step.
  virtual void accept(ElementMemory memory, const LinkStep& step) const = 0;
  /// Force and loss at one instant.
  struct Instant {
    double force = 0;  ///< as returned by evaluate() [N]
    double lost = 0;   ///< by yielding up to this instant, as lost() [J]
  };
  /// At s from 0 to 1 of the last accepted step, for this deformation [m], so that histories are exact between the ends
  /// of steps. Pure. The default is for springs without memory.
  virtual Instant inside(ConstElementMemory memory, const LinkStep& step, double s, double deformation) const noexcept {
    return {evaluate(memory, {deformation, interpolate(step, s).rate}).force, energy(memory).lost};
  }
  /// True if the force may change so sharply inside this accepted step that a parabola through its ends and its middle
  /// misses a peak.
  virtual bool bends_sharply(const LinkStep& /*step*/) const noexcept { return false; }

  // As an Element with one deformation.
  int deformations() const noexcept final { return 1; }
  double stiffness(int) const noexcept final { return stiffness(); }
  double yield_deformation(int) const noexcept final { return yield_deformation(); }
  void evaluate(ConstElementMemory memory, std::span<const LinkMotion> motion,
                ElementResponse& response) const noexcept final {
    const laws::Response one = evaluate(memory, motion[0]);
    response.force[0] = one.force;
    response.by_deformation[0][0] = one.by_penetration;
    response.by_rate[0][0] = one.by_rate;
  }
  void start(ElementMemory memory, std::span<const LinkMotion> motion) const final { start(memory, motion[0]); }
  void load(ElementMemory memory, std::span<const double>, std::span<const double> to) const final {
    load(memory, to[0]);
  }
  void accept(ElementMemory memory, std::span<const LinkStep> step) const final { accept(memory, step[0]); }
  double dissipated(ConstElementMemory memory, int) const noexcept final {
    const ElementEnergy energy = this->energy(memory);
    return energy.lost + energy.damped;
  }
};

/// A spring together with its memory, for static loading and for reports.
class LoadedSpring {
 public:
  /// Undeformed. `spring` must outlive this object.
  explicit LoadedSpring(const Spring& spring) : spring_(&spring) { memory_.add(spring); }

  const Spring& spring() const noexcept { return *spring_; }         ///< the spring
  const Spring* operator->() const noexcept { return spring_; }      ///< its other functions
  ElementMemory memory() noexcept { return memory_[0]; }             ///< its memory
  ConstElementMemory memory() const noexcept { return memory_[0]; }  ///< its memory
  /// See the functions of Spring with these names.
  laws::Response evaluate(const LinkMotion& motion) const noexcept { return spring_->evaluate(memory(), motion); }
  laws::Response evaluate_slowly(double deformation) const noexcept {
    return spring_->evaluate_slowly(memory(), deformation);
  }
  std::optional<double> corner(double deformation) const noexcept { return spring_->corner(memory(), deformation); }
  double slope_lost(double deformation) const noexcept { return spring_->slope_lost(memory(), deformation); }
  void start(const LinkMotion& motion) { spring_->start(memory(), motion); }
  void load(double deformation) { spring_->load(memory(), deformation); }
  void accept(const LinkStep& step) { spring_->accept(memory(), step); }
  Spring::Instant inside(const LinkStep& step, double s, double deformation) const noexcept {
    return spring_->inside(memory(), step, s, deformation);
  }
  ElementEnergy energy() const noexcept { return spring_->energy(memory()); }
  void archive(Archive& archive) { memory_.archive(archive); }

 private:
  const Spring* spring_;
  ElementMemories memory_;
};

}  // namespace pounding
