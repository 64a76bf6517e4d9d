#pragma once
/// Error norm: motion scales by group and by link, and the error ratio of a trial step.

#include <Eigen/Core>
#include <vector>

#include <pounding/model/scheme.hpp>
#include <pounding/stepping/equations.hpp>

namespace pounding {

/// Measures the errors of a step relative to the motion. Displacements and velocities of each group are mass-weighted
/// root mean squares; active contacts are measured relative to the motion of the current impact.
class ErrorNorm {
 public:
  /// `equations` must outlive this object. `tolerance`: relative, of the whole run.
  ErrorNorm(const Equations& equations, const Scheme& scheme, double tolerance);

  /// Reference scales of the errors.
  const MotionScales& scales() const { return scales_; }

  /// Largest error of a trial divided by the allowed error of one step; acceptable if at most 1. `active`: links with a
  /// force. Also sets the sums of squares of the trial; see worst_link().
  double ratio(Trial& trial, const StepError& error, const std::vector<int>& active);
  /// Link with the largest error in the last ratio(); -1 if it belongs to a group.
  int worst_link() const { return worst_link_; }

  /// Limits the error of later steps to this fraction of the tolerance.
  void allow(double part) { allowed_ = std::max(part * allowed_by_tolerance_, rounding); }

  /// Initializes the scales from a state.
  void start(const Instant& now);
  /// Updates the scales. They never decrease, except those of a contact, which are reset at each impact.
  void learn(const Trial& kept);
  void learn(int contact, const LinkMotion& end);
  void begin_impact(int contact, double rate);

  /// Norm of a displacement change relative to the displacement or its scale: maximum over the nonlinear groups, which
  /// all others follow.
  double relative_size(const Eigen::VectorXd& change, const Eigen::VectorXd& displacement) const;
  /// Allowed relative error of one step.
  double allowed() const { return allowed_; }
  /// Kinetic energy at the minimum velocities used as error scales [J].
  double min_energy() const;
  /// Mass-weighted inner product.
  double product(const Eigen::VectorXd& p, const Eigen::VectorXd& q) const;

  /// Writes or reads the scales.
  void archive(Archive& archive);

 private:
  void measure(const Instant& x, std::vector<double>& squares_u, std::vector<double>& squares_v);
  void raise(std::vector<double>& scales, const std::vector<double>& squares) const;
  double group_error(Trial& trial, const StepError& error);
  double contact_error(int contact, Eigen::Index row, const Trial& trial) const;
  double slip_error(int slip, const Trial& trial, double error) const;
  double stretch(int slip, const Instant& x) const;

  const Equations& equations_;
  const double allowed_by_tolerance_;  // relative error of one step
  double allowed_;                     // current
  MotionScales scales_;
  // By group: velocity scales without the contribution of short ground motions. Otherwise a pulse that leaves only a
  // small motion behind would mask errors in it.
  std::vector<double> slow_velocity_;
  std::vector<double> rate_scale_, penetration_scale_;  // by link, of the current impact
  std::vector<double> stretch_scale_;                   // by slip: largest elongation of the spring in series
  std::vector<double> rest_size_;                       // by group, of ElasticForces::at_rest()
  std::vector<std::vector<int>> link_groups_;           // groups that a link connects
  int worst_link_ = -1;
  std::vector<double> sums_;  // by group: squares of the errors in u and v, of u, v and slow v
  Eigen::MatrixXd errors_, link_errors_;
};

/// Adds the error estimate of Simpson's rule: the difference between the velocities and displacements of the step and
/// the integral of its accelerations in dynamic equilibrium (beginning, middle, end). It detects non-smooth forces,
/// such as a dashpot that grows as d^(1/4) from first contact. In each coordinate, the maximum of this error times
/// `part` and the existing error is kept. Accelerations exclude those of short ground motions, which are integrated
/// exactly.
void add_simpson_error(const ShortMotions& short_motions, const Instant& begin, const Trial& trial, double part,
                       StepError& error);

}  // namespace pounding
