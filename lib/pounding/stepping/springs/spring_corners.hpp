#pragma once
/// Corners of the forces of springs inside a trial step.

#include <optional>

#include <pounding/stepping/springs/spring_forces.hpp>

namespace pounding {

/// Corners of the spring forces, where a spring yields or unloads. A step that ends at a corner preserves the order of
/// the scheme.
class SpringCorners {
 public:
  /// Both arguments must outlive this object.
  SpringCorners(SpringForces& springs, const LinkSet& links) : springs_(springs), links_(links) {}

  /// Fraction (0 to 1) of the solved step `trial` from `now` at the first spring corner well inside it, on the cubic
  /// through the motions at both ends; `nullopt` if there is none. With relief, the force of one spring bends the path
  /// of another, so the estimate is void beyond the first corner. `longest_step`: current maximum step, see
  /// Stepper::longest_step() [s].
  std::optional<double> first(const Instant& now, const Trial& trial, double longest_step) const;

 private:
  SpringForces& springs_;
  const LinkSet& links_;
};

}  // namespace pounding
