#pragma once
/// Ground motions that are short compared with the periods of the structures, integrated exactly over a step.

#include <Eigen/Core>
#include <vector>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// Errors in displacement and velocity of a scheme's integral of each short ground motion [m], [m/s].
struct GroundDefect {
  Eigen::VectorXd u, v;
};

/// A short ground motion moves a structure as a rigid body. While a motion with displacement g lasts, the relative
/// motion is nearly -R g, where R = M^-1 P, and the remaining motion may be far smaller. The schemes therefore
/// integrate the absolute acceleration a + R ag, which is smooth and small, and treat the ground motion in closed form.
/// Where a scheme approximates an integral of ag by a sum, its result is corrected by R times the defect: the sum minus
/// the exact integral.
///
/// A closed-form motion is short for a group of the system if its period is below a quarter of the period of the group
/// (from Rayleigh's quotient of R) and at most one second. Longer motions, records and rectangular pulses are excluded:
/// steps end at their corners, so straight segments are integrated exactly.
class ShortMotions {
 public:
  /// Both arguments must outlive this object. Collective.
  ShortMotions(const System& system, const StructureSolver& solver);

  /// True if there are any short motions.
  bool any() const { return !index_.empty(); }
  /// Sets Trial::short_motions of a trial from `begin`; its h, end time and ground accelerations must be set.
  void follow(const Instant& begin, Trial& trial) const;
  /// One column of ShortMotionStep: at a time in a step from `begin`, with the accelerations `ground`.
  Eigen::MatrixXd at(double time, const Eigen::VectorXd& ground, const Instant& begin) const;
  /// Defect at mid-step of the cubic through both ends of a step.
  static GroundDefect of_cubic(const ShortMotionStep& step, double h);

  /// R times one value per short motion.
  Eigen::VectorXd shift(const Eigen::VectorXd& by) const { return shift_ * by; }
  /// Damping forces C R times these velocities.
  Eigen::VectorXd damping(const Eigen::VectorXd& velocities) const { return damping_ * velocities; }
  /// Forces due to a defect, K R u + C R v.
  Eigen::VectorXd forces(const GroundDefect& defect) const { return stiffness_ * defect.u + damping_ * defect.v; }
  /// Closing of a link due to R times one value per short motion.
  double closing(int link, const Eigen::VectorXd& by) const { return closing_.row(link).dot(by); }
  /// R times the ground velocity at the end of a step, summed over the short motions that still act then.
  Eigen::VectorXd velocity_at_end(const Trial& trial) const;

  /// Work of the short motions in an accepted step [J]; of the coordinates on this process.
  double work(const Instant& begin, const Trial& kept) const;
  /// P without the load of the short motions.
  const Eigen::MatrixXd& other_load() const { return any() ? other_load_ : solver_.layout().load; }

 private:
  bool acts(std::size_t motion, double step_begin) const {
    const GroundMotion& of = system_.grounds[index_[motion]];
    return of.start() <= step_begin && step_begin < of.duration();
  }

  const System& system_;
  const StructureSolver& solver_;
  std::vector<int> index_;      // into the grounds
  Eigen::MatrixXd load_;        // P, one column per short motion; zero in groups for which the motion is not short
  Eigen::MatrixXd other_load_;  // P of all grounds minus load_
  Eigen::MatrixXd shift_;       // R
  Eigen::MatrixXd stiffness_, damping_;            // K R, C R
  Eigen::MatrixXd closing_;                        // B^T R
  Eigen::MatrixXd coupling_, springs_, dashpots_;  // R^T M R, R^T K R, R^T C R; of the coordinates on this process
};

}  // namespace pounding
