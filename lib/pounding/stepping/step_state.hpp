#pragma once
/// The state of the integrator at one instant, and one trial step: data only.

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/links/contact.hpp>

namespace pounding {

/// State of all degrees of freedom; those without mass are in static equilibrium (see PseudoForces).
struct State {
  double time = 0;
  Eigen::VectorXd u, v;   ///< relative to the ground [m], [m/s]
  Eigen::VectorXd a;      ///< relative to the ground, from dynamic equilibrium just after `time` [m/s^2]
  Eigen::VectorXd force;  ///< of every link just after `time` [N]
};

/// The quantities that are reported, System::outputs^T times displacement, velocity and acceleration.
struct OutputQuantities {
  double time = 0;
  Eigen::MatrixXd motion;  ///< [quantity, u v a]; a just after `time`
};

/// One event function of one contact.
struct EventId {
  int link = 0, event = 0;
};

/// Largest motion so far of each group, as the root mean square weighed by the masses. Errors and round-off are
/// relative to it.
struct MotionScales {
  std::vector<double> displacement;  ///< [m]
  std::vector<double> velocity;      ///< [m/s]

  /// Largest scale of all groups [m], [m/s].
  double max_displacement() const { return *std::max_element(displacement.begin(), displacement.end()); }
  double max_velocity() const { return *std::max_element(velocity.begin(), velocity.end()); }
};

/// Motion, forces and ground at one instant, in the coordinates of the StructureSolver. An instant that ends a step
/// holds left limits, the present state right limits.
struct Instant {
  /// Columns of `motion`: displacement, velocity, acceleration, the acceleration that generalized-alpha carries where
  /// it is another one, and the products of these with K and C.
  enum Column { u, v, a, carried, ku, kv, ka, k_carried, cv, ca, c_carried, columns };

  double time = 0;
  Eigen::VectorXd ground;          ///< accelerations of the grounds [m/s^2]
  Eigen::VectorXd ground_carried;  ///< those that `carried` answers to [m/s^2]
  Eigen::MatrixXd motion;          ///< [coordinate, Column]
  Eigen::VectorXd force;           ///< of every link [N]
  Eigen::MatrixXd relative;        ///< B^T of the motion, [link, u v a carried]
  Eigen::MatrixXd by_ground;  ///< part of the relative motion due to ground and gravity, [link, u v a]; empty for none
  Eigen::VectorXd pseudo_force;  ///< see PseudoForces, [coordinate]; empty for none
  Eigen::VectorXd slip;          ///< LinkMotion::slip of every spring; empty where none slips
  // Where springs give way (SpringRelief), else empty:
  Eigen::VectorXd relief;         ///< S F of every spring [m]
  Eigen::VectorXd spring_slopes;  ///< dF/dd of every spring in the step that ends here [N/m]
  Eigen::MatrixXd force_rates;  ///< first and second derivative in time of the force of every spring, with these slopes

  /// One column of `motion`.
  const double* at(Column column) const { return motion.col(column).data(); }
  double* at(Column column) { return motion.col(column).data(); }

  /// Writes all members, or reads them back.
  void archive(Archive& archive) {
    archive(time, ground, ground_carried, motion, force, relative, by_ground, pseudo_force, slip, relief, spring_slopes,
            force_rates);
  }
};

/// Motion of the ground in a step by those of its motions that are short (ShortMotions), zero for those that do not act
/// in the step: [motion, u v a].
struct ShortMotionStep {
  Eigen::MatrixXd begin, middle, end;
};

/// One step, tried or kept.
struct Trial {
  double h = 0;  ///< length [s]
  Instant end;
  Eigen::VectorXd force_middle;      ///< of every link at mid-step [N]
  mutable Eigen::VectorXd a_middle;  ///< mid-step accelerations; massless coordinates are filled in on demand
  std::vector<LinkMotion> middle;    ///< of every link at mid-step
  Eigen::VectorXd ground_middle;     ///< accelerations [m/s^2]
  Eigen::MatrixXd by_ground_middle;  ///< as Instant::by_ground
  std::optional<ShortMotionStep> short_motions;  ///< nothing where none acts
  // Where springs give way, else empty; with the slopes of the middle, as those at the end:
  Eigen::MatrixXd spring_rates;  ///< of the deformation: rate and acceleration at the beginning, rate in the middle,
                                 ///< both at the end
  Eigen::MatrixXd force_rates_begin;  ///< as Instant::force_rates
  bool springs_stay = false;  ///< whether every spring stays in its range (ElasticRanges); then middle has none of them
  Eigen::MatrixXd spring_paths;  ///< deformation of every spring in such a trial: at its beginning, at its end, below
                                 ///< all of it, above
  double error = 0;              ///< over the allowed one
  std::vector<double> squares_u, squares_v;  ///< sums of m u^2 and m v^2 by group, at the end
  std::vector<double> squares_slow;  ///< as squares_v, without the velocity that short motions of the ground give

  /// Writes all members, or reads them back.
  void archive(Archive& archive) {
    archive(h, end, a_middle, force_middle, middle, ground_middle, by_ground_middle, spring_rates, force_rates_begin,
            error, squares_u, squares_v, squares_slow);
  }
};

/// Estimated errors of a trial in displacement and velocity [coordinate], and in the slip of every spring; that empty
/// where none slips.
struct StepError {
  Eigen::VectorXd u, v;
  Eigen::VectorXd slip{};
};

}  // namespace pounding
