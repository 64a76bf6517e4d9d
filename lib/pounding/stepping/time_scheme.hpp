#pragma once
/// One trial step by a time-stepping scheme.

#include <memory>

#include <pounding/stepping/coefficients.hpp>
#include <pounding/stepping/stage_solver.hpp>

namespace pounding {

/// A scheme with its workspace. A step is pure: it writes only the trial and the error passed to it.
class TimeScheme {
 public:
  virtual ~TimeScheme() = default;

  /// A = mass M + damping C + stiffness K of a step of length h; the same for all stages.
  virtual EffectiveMatrix matrix(double h) const = 0;
  /// Solves the step of length trial.h from `begin`. `last_step`: length of the last accepted step, zero if there is
  /// none [s]. On input, `trial` has h, the end time, and ground and by_ground at the end and the middle. Sets all
  /// other members except Trial::error and the sums of squares, and the estimated errors. False if the equations of a
  /// stage cannot be solved.
  virtual bool try_step(const Instant& begin, double last_step, Trial& trial, StepError& error) = 0;
};

/// The arguments must outlive the scheme.
std::unique_ptr<TimeScheme> make_generalized_alpha(Equations& equations, StageSolver& stages,
                                                   const GeneralizedAlpha& coefficients);
std::unique_ptr<TimeScheme> make_esdirk4(Equations& equations, StageSolver& stages);

}  // namespace pounding
