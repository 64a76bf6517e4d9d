#pragma once
/// Ground motions that are short beside the periods of the structures, integrated exactly over a step.

#include <Eigen/Core>
#include <vector>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// Displacements and velocities by which a rule of integration misses the ground, one entry a short motion [m], [m/s].
struct GroundDefect {
  Eigen::VectorXd u, v;
};

/// Short motions of the ground shift a structure as a whole: while one with displacement g lasts, the relative motion
/// is nearly -R g, with R = M^-1 P, and what is left of it afterwards may be far smaller. So the schemes integrate the
/// absolute acceleration a + R ag, which is smooth and small, and the ground in closed form: wherever a rule of theirs
/// integrates ag by a sum, its result is corrected by R times the defect, the sum less the exact integral.
///
/// A closed form is short for a group of the system if its period is below a quarter of that of the group, taken by
/// Rayleigh's quotient of R and at most a second. Motions that last longer, records and rectangles have no part in
/// this: steps that end at corners integrate straight lines exactly.
class ShortMotions {
 public:
  /// Both must outlive it. Collective.
  ShortMotions(const System& system, const StructureSolver& solver);

  /// Whether there is any.
  bool any() const { return !index_.empty(); }
  /// Sets Trial::short_motions of a trial from `begin`, whose h, end time and accelerations of the grounds are known.
  void follow(const Instant& begin, Trial& trial) const;
  /// One column of ShortMotionStep: at a time in a step from `begin`, with these accelerations of all grounds.
  Eigen::MatrixXd at(double time, const Eigen::VectorXd& ground, const Instant& begin) const;
  /// Defect of the cubic through both ends of a step at its middle.
  static GroundDefect of_cubic(const ShortMotionStep& step, double h);

  /// R times one number a short motion.
  Eigen::VectorXd shift(const Eigen::VectorXd& by) const { return shift_ * by; }
  /// Damping forces C R of these velocities.
  Eigen::VectorXd damping(const Eigen::VectorXd& velocities) const { return damping_ * velocities; }
  /// Forces that a defect adds, K R u + C R v.
  Eigen::VectorXd forces(const GroundDefect& defect) const { return stiffness_ * defect.u + damping_ * defect.v; }
  /// Closing of a link by R times one number a short motion.
  double closing(int link, const Eigen::VectorXd& by) const { return closing_.row(link).dot(by); }
  /// R times the velocity of the ground at the end of a step in which short motions act; without those that are over
  /// then.
  Eigen::VectorXd velocity_at_end(const Trial& trial) const;

  /// Work of the short motions in a kept step [J]; of the coordinates on this process.
  double work(const Instant& begin, const Trial& kept) const;
  /// P without what work() takes.
  const Eigen::MatrixXd& other_load() const { return any() ? other_load_ : solver_.load(); }

 private:
  bool acts(std::size_t motion, double step_begin) const {
    const GroundMotion& of = system_.grounds[index_[motion]];
    return of.start() <= step_begin && step_begin < of.duration();
  }

  const System& system_;
  const StructureSolver& solver_;
  std::vector<int> index_;               // into the grounds
  Eigen::MatrixXd load_;                 // P, one column a short motion; zero in groups for which it is not short
  Eigen::MatrixXd other_load_;           // P of all grounds, without load_
  Eigen::MatrixXd shift_;                // R
  Eigen::MatrixXd stiffness_, damping_;  // K R, C R
  Eigen::MatrixXd closing_;              // B^T R
  Eigen::MatrixXd coupling_, springs_, dashpots_;  // R^T M R, R^T K R, R^T C R; of the coordinates on this process
};

}  // namespace pounding
