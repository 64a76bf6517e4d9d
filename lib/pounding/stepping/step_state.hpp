#pragma once
/// State of the integrator at one instant, and one trial step: data only.

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/links/contact.hpp>

namespace pounding {

/// State of all degrees of freedom; massless ones are in static equilibrium (see PseudoForces).
struct State {
  double time = 0;
  Eigen::VectorXd u, v;   ///< relative to the ground [m], [m/s]
  Eigen::VectorXd a;      ///< relative to the ground, from dynamic equilibrium just after `time` [m/s^2]
  Eigen::VectorXd force;  ///< of every link just after `time` [N]
};

/// Reported quantities: System::outputs^T times displacement, velocity and acceleration.
struct OutputQuantities {
  double time = 0;
  Eigen::MatrixXd motion;  ///< [quantity, u v a]; a just after `time`
};

/// One event function of one contact.
struct EventId {
  int link = 0, event = 0;
};

/// Running maximum of the motion of each group, as a mass-weighted root mean square. Errors and round-off are relative
/// to it.
struct MotionScales {
  std::vector<double> displacement;  ///< [m]
  std::vector<double> velocity;      ///< [m/s]

  /// Largest scale of all groups [m], [m/s].
  double max_displacement() const { return *std::max_element(displacement.begin(), displacement.end()); }
  double max_velocity() const { return *std::max_element(velocity.begin(), velocity.end()); }
};

/// Motion, forces and ground acceleration at one instant, in the coordinates of the StructureSolver. The instant at
/// the end of a step holds left limits; the present state holds right limits.
struct Instant {
  /// Columns of `motion`: displacement, velocity, acceleration, the acceleration that generalized-alpha carries if it
  /// differs, and the products of these with K and C.
  enum Column { u, v, a, carried, ku, kv, ka, k_carried, cv, ca, c_carried, columns };

  double time = 0;
  Eigen::VectorXd ground;          ///< accelerations of the grounds [m/s^2]
  Eigen::VectorXd ground_carried;  ///< ground accelerations that correspond to `carried` [m/s^2]
  Eigen::MatrixXd motion;          ///< [coordinate, Column]
  Eigen::VectorXd force;           ///< of every link [N]
  Eigen::MatrixXd relative;        ///< B^T of the motion, [link, u v a carried]
  Eigen::MatrixXd by_ground;       ///< relative motion due to ground and gravity, [link, u v a]; empty if there is none
  Eigen::VectorXd pseudo_force;    ///< see PseudoForces, [coordinate]; empty if there is none
  Eigen::VectorXd slip;            ///< LinkMotion::slip of every spring and friction; empty if none slips (LinkSlips)
  Eigen::VectorXd friction_slip_rate;  ///< of the same size: rates of the slip of friction, zero for springs [m/s]
  // Empty unless springs have relief (SpringRelief):
  Eigen::VectorXd relief;  ///< S F of every spring [m]
  /// [spring, deformation of its element] dF/dd in the step that ends here [N/m]; one column without coupled elements
  Eigen::MatrixXd spring_slopes;
  Eigen::MatrixXd force_rates;  ///< first and second time derivative of the force of every spring, with these slopes

  /// One column of `motion`.
  const double* at(Column column) const { return motion.col(column).data(); }
  double* at(Column column) { return motion.col(column).data(); }

  /// Writes or reads all members.
  void archive(Archive& archive) {
    archive(time, ground, ground_carried, motion, force, relative, by_ground, pseudo_force, slip, friction_slip_rate,
            relief, spring_slopes, force_rates);
  }
};

/// Ground motion in a step due to the short motions (ShortMotions); zero for those that do not act in the step:
/// [motion, u v a].
struct ShortMotionStep {
  Eigen::MatrixXd begin, middle, end;
};

/// One trial or accepted step.
struct Trial {
  double h = 0;  ///< length [s]
  Instant end;
  Eigen::VectorXd force_middle;         ///< of every link at mid-step [N]
  mutable Eigen::VectorXd a_middle;     ///< mid-step accelerations; massless coordinates are computed on demand
  Eigen::VectorXd pseudo_force_middle;  ///< as Instant::pseudo_force
  std::vector<LinkMotion> middle;       ///< of every link at mid-step
  Eigen::VectorXd ground_middle;        ///< accelerations [m/s^2]
  Eigen::MatrixXd by_ground_middle;     ///< as Instant::by_ground
  std::optional<ShortMotionStep> short_motions;  ///< nullopt if none acts
  // Empty unless springs have relief; computed with the mid-step slopes, as are those at the end:
  Eigen::MatrixXd spring_rates;  ///< rates of deformation: first and second derivative at the beginning, first at the
                                 ///< middle, both at the end
  Eigen::MatrixXd force_rates_begin;  ///< as Instant::force_rates

  /// True if every spring stays in its range (ElasticRanges); then `middle` is not set for springs.
  bool springs_stay = false;
  /// Deformation of every spring in such a trial: at its beginning, at its end, lower bound, upper bound.
  Eigen::MatrixXd spring_paths;
  double error = 0;                          ///< divided by the allowed error
  std::vector<double> squares_u, squares_v;  ///< sums of m u^2 and m v^2 by group, at the end
  std::vector<double> squares_slow;          ///< as squares_v, without velocities due to short ground motions

  /// Writes or reads all members.
  void archive(Archive& archive) {
    archive(h, end, a_middle, force_middle, pseudo_force_middle, middle, ground_middle, by_ground_middle, spring_rates,
            force_rates_begin, error, squares_u, squares_v, squares_slow);
  }
};

/// Estimated errors of a trial in displacement and velocity [coordinate], and in the slips (LinkSlips); `slip` is empty
/// if none slips.
struct StepError {
  Eigen::VectorXd u, v;
  Eigen::VectorXd slip{};
};

}  // namespace pounding
