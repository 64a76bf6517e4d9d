#pragma once
/// The size of errors: scales of the motion by group and by link, and the verdict on a trial.

#include <Eigen/Core>
#include <vector>

#include <pounding/model/scheme.hpp>
#include <pounding/stepping/equations.hpp>

namespace pounding {

/// Compares the errors of a step with the motion: displacements and velocities of each group as root mean squares
/// weighed by the masses, those of each contact that presses with the motion of its impact.
class ErrorNorm {
 public:
  /// `equations` must outlive it. `tolerance`: of a whole run, relative.
  ErrorNorm(const Equations& equations, const Scheme& scheme, double tolerance);

  /// Scales that errors are relative to.
  const MotionScales& scales() const { return scales_; }

  /// Largest error of a trial over the error that is allowed in one step: good is at most 1. `active`: links that have
  /// a force. Sets the sums of squares of the trial; see worst_link().
  double ratio(Trial& trial, const StepError& error, const std::vector<int>& active);
  /// The link whose error was the largest of all in the last ratio(); -1 if that was the error of a group.
  int worst_link() const { return worst_link_; }

  /// From now on a step may have this part of the error that the tolerance allows.
  void allow(double part) { allowed_ = std::max(part * allowed_by_tolerance_, rounding); }

  /// Scales of a motion to start from.
  void start(const Instant& now);
  /// Scales never shrink, but for those of a contact, which begin anew with each impact.
  void learn(const Trial& kept);
  void learn(int contact, const LinkMotion& end);
  void begin_impact(int contact, double rate);

  /// Size of a change of the displacement, relative to the displacement or its scale: the largest of all groups.
  double relative_size(const Eigen::VectorXd& change, const Eigen::VectorXd& displacement) const;
  /// Kinetic energy at the smallest velocities that errors are compared with [J].
  double min_energy() const;
  /// Inner product weighed by the masses.
  double product(const Eigen::VectorXd& p, const Eigen::VectorXd& q) const;

  /// Writes the scales, or reads them back.
  void archive(Archive& archive);

 private:
  void measure(const Instant& x, std::vector<double>& squares_u, std::vector<double>& squares_v);
  void raise(std::vector<double>& scales, const std::vector<double>& squares) const;
  double group_error(Trial& trial, const StepError& error);
  double contact_error(int contact, Eigen::Index row, const Trial& trial) const;
  double slip_error(int spring, const Trial& trial, double error) const;
  double stretch(int spring, const Instant& x) const;

  const Equations& equations_;
  const double allowed_by_tolerance_;  // relative error of one step
  double allowed_;                     // at present
  MotionScales scales_;
  // By group: velocities that errors are relative to, without what short motions of the ground give. A pulse that
  // leaves a small motion behind would else hide errors in it.
  std::vector<double> slow_velocity_;
  std::vector<double> rate_scale_, penetration_scale_;  // by link, of the present impact
  std::vector<double> stretch_scale_;          // by spring that slips: largest stretch beside its dashpot so far
  std::vector<double> rest_size_;              // by group, of ElasticForces::at_rest()
  std::vector<std::vector<int>> link_groups_;  // groups that a link joins
  int worst_link_ = -1;
  std::vector<double> sums_;  // by group: errors in u and v, u, v, slow v squared
  Eigen::MatrixXd errors_, link_errors_;
};

/// Adds the error by Simpson's rule: the step's own velocities and displacements against the integral of the
/// accelerations from dynamic equilibrium at its ends and its middle. It sees forces that are not smooth, such as a
/// dashpot that grows with d^(1/4) from the touch. In each coordinate the larger of this error, times `part`, and the
/// present one stays. Accelerations count without those of short motions of the ground, which the step integrates
/// exactly.
void add_simpson_error(const ShortMotions& short_motions, const Instant& begin, const Trial& trial, double part,
                       StepError& error);

}  // namespace pounding
