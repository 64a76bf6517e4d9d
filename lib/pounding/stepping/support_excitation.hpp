#pragma once
/// Ground motion of a system during a step: accelerations, breakpoints, and effect on the links.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// Round-off of sums and differences of a motion, relative to the motion.
inline constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

/// Ground motions as needed by a step: forces due to their accelerations, their contribution to the relative motion of
/// links, and breakpoints.
class SupportExcitation {
 public:
  SupportExcitation(const System& system, const StructureSolver& solver)
      : system_(system), solver_(solver), push_(Eigen::VectorXd::Zero(solver.size())) {}

  /// Accelerations of the grounds at `time` [m/s^2], right limits.
  void accelerations(double time, Eigen::VectorXd& ground) const {
    for (std::size_t k = 0; k < system_.grounds.size(); ++k)
      ground[static_cast<Eigen::Index>(k)] = system_.grounds[k].acceleration(time);
  }
  /// Left limits at the end of a step at `time`; merged breakpoints are evaluated at the first of them.
  void accelerations_at_end(double time, Eigen::VectorXd& ground) const {
    const double before = std::min(time, first_break_);
    for (std::size_t k = 0; k < system_.grounds.size(); ++k)
      ground[static_cast<Eigen::Index>(k)] = system_.grounds[k].acceleration_before(before);
  }

  /// True if the right limits at `time` differ from these accelerations [m/s^2].
  bool jump(double time, const Eigen::VectorXd& ground) const {
    for (std::size_t k = 0; k < system_.grounds.size(); ++k)
      if (system_.grounds[k].acceleration(time) != ground[static_cast<Eigen::Index>(k)]) return true;
    return false;
  }

  /// P ag for ground accelerations; overwritten by the next call.
  const Eigen::VectorXd& push(const Eigen::VectorXd& ground) {
    // The loops store with the width of the reads that follow: a wider read of freshly stored values would stall.
    const Eigen::MatrixXd& load = solver_.layout().load;
    const int n = solver_.size();
    double* const sum = push_.data();
    for (Eigen::Index k = 0; k < ground.size(); ++k) {
      const double* const p = load.col(k).data();
      const double a = ground[k];
      if (k == 0) {
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) sum[i] = a * p[i];
      } else if (a != 0) {
#pragma GCC ivdep
        for (int i = 0; i < n; ++i) sum[i] += a * p[i];
      }
    }
    return push_;
  }

  /// S times displacements, velocities and the given accelerations of the grounds, plus the gravity offset: [link, u v
  /// a].
  void relative_motion(double time, const Eigen::VectorXd& ground, Eigen::MatrixXd& by_ground) const {
    by_ground.setZero(system_.links(), 3);
    if (system_.gravity_offset.size() > 0) by_ground.col(Instant::u) = system_.gravity_offset;
    if (system_.gap_by_ground.size() == 0) return;
    for (std::size_t k = 0; k < system_.grounds.size(); ++k) {
      const auto column = system_.gap_by_ground.col(static_cast<Eigen::Index>(k));
      by_ground.col(Instant::u) += system_.grounds[k].displacement(time) * column;
      by_ground.col(Instant::v) += system_.grounds[k].velocity(time) * column;
      by_ground.col(Instant::a) += ground[static_cast<Eigen::Index>(k)] * column;
    }
  }

  /// Next time at which an acceleration has a corner or a jump [s]; infinity if there is none.
  double next_break() const { return next_break_; }
  /// Finds the next breakpoint. Breakpoints that differ only by round-off (of delayed motions) are merged: a step ends
  /// at the last of them, and left limits are evaluated at the first.
  void find_break_after(double time) {
    first_break_ = std::numeric_limits<double>::infinity();
    for (const GroundMotion& motion : system_.grounds) first_break_ = std::min(first_break_, motion.next_break(time));
    next_break_ = first_break_;
    if (!std::isfinite(first_break_)) return;
    const double same = first_break_ + rounding * std::max(1.0, std::abs(first_break_));
    for (const GroundMotion& motion : system_.grounds)
      for (double t = motion.next_break(time); t <= same; t = motion.next_break(t))
        next_break_ = std::max(next_break_, t);
  }

  /// Maximum step from `time` to the next breakpoint that resolves the motions, see GroundMotion::longest_step [s].
  double longest_step(double time) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const GroundMotion& motion : system_.grounds) shortest = std::min(shortest, motion.longest_step(time));
    return shortest;
  }

  /// Writes the next breakpoint, or reads it back.
  void archive(Archive& archive) { archive(first_break_, next_break_); }

 private:
  const System& system_;
  const StructureSolver& solver_;
  Eigen::VectorXd push_;
  double first_break_ = 0, next_break_ = 0;  // equal up to round-off
};

}  // namespace pounding
