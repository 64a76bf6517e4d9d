#pragma once
/// Corners of the forces of springs inside a trial step.

#include <optional>

#include <pounding/stepping/springs/spring_forces.hpp>

namespace pounding {

/// Corners of the forces of springs, where a spring yields or unloads: a step that ends at one keeps its order.
class SpringCorners {
 public:
  /// Both must outlive it.
  SpringCorners(const SpringForces& springs, const LinkSet& links) : springs_(springs), links_(links) {}

  /// Position in the solved step `trial` from `now`, from 0 to 1, of the first corner of all springs that lies well
  /// inside it, by the cubic through the motions at both ends; nothing for none. Where springs give way the force of
  /// one bends the path of another, and after the first corner nothing is as it was. `longest_step`: at present, see
  /// Stepper::longest_step() [s].
  std::optional<double> first(const Instant& now, const Trial& trial, double longest_step) const;

 private:
  const SpringForces& springs_;
  const LinkSet& links_;
};

}  // namespace pounding
