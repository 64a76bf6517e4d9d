#pragma once
/// Springs that stay elastic in a whole step: nothing of them need be evaluated, nor their history moved but to where
/// they stand.

#include <Eigen/Core>
#include <optional>

#include <pounding/stepping/deformation_bound.hpp>
#include <pounding/stepping/link_set.hpp>
#include <pounding/stepping/relative_motion.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// The ranges of deformation in which springs keep their force (Spring::elastic), side by side. A step in which every
/// spring keeps to its range, as most do before anything yields, costs a few comparisons a spring, with the bits of the
/// long way.
///
/// While springs are untouched, a DeformationBound tells of most of these steps without the motions of the springs:
/// these wait (RelativeMotion), and the springs themselves stay behind until somebody asks for them or a step may leave
/// a range.
class ElasticRanges {
 public:
  /// Both must outlive it.
  ElasticRanges(const LinkSet& links, const RelativeMotion& relative);

  /// Reads the range of every spring: after the run began, and after the history of any spring moved otherwise than
  /// within its range.
  void read();
  /// Changes when a range does.
  long version() const { return version_; }
  /// Force of every spring in its range [N]; zero for those that have none.
  const Eigen::VectorXd& forces() const { return forces_; }
  /// Whether motions of springs may wait at the end of a trial, for stay() to ask for them.
  bool let_wait() const { return let_wait_; }

  /// Whether no spring has ever had a force that read() saw, nor has lost or stored energy beside that of the
  /// structures.
  bool untouched() const { return untouched_; }

  /// Whether all springs are in their ranges, and are still so long after `now`, the present instant, at their present
  /// rates [s].
  bool hold(const Instant& now, double ahead) const;
  /// Whether all springs have the forces of their ranges at both ends of a trial and stay inside, wherever the cubics
  /// through their motions go between. If not, none of their motions waits, and they stand where the trial begins. It
  /// begins at the instant of the last hold().
  bool stay(const Instant& begin, Trial& trial) const;

  /// Deformations of all springs at an instant.
  void deformations_at(const Instant& x, Eigen::VectorXd& d) const;
  /// Makes Trial::spring_paths of a trial in which all stay, unless they are made.
  void make_paths(const Instant& begin, const Trial& trial) const;
  /// Such a trial was kept: springs that may wait stay behind, all others follow it.
  void keep(const Trial& kept) const;
  /// Springs that have stayed behind follow it now.
  void follow(const Instant& begin, const Trial& kept) const;

 private:
  const double* of_springs(const Eigen::MatrixXd& by_link, Instant::Column column) const {
    return by_link.col(column).data() + links_.contacts();
  }
  void deformations(const Instant& x, double* d) const;
  void bring(const Instant& now) const;
  bool inside(const Instant& now, double ahead) const;
  bool have_forces(const Instant& x) const;

  const LinkSet& links_;
  const RelativeMotion& relative_;
  bool all_ = false;  // whether every spring has a range
  bool untouched_ = true, let_wait_ = false;
  long version_ = 0;
  Eigen::VectorXd low_, high_, forces_;
  std::optional<DeformationBound> bound_;  // for these ranges; nothing where springs cannot wait
  mutable DeformationBound::Reach reach_;  // at the instant of the last hold(), by this bound
  mutable bool behind_ = false;            // springs have not followed the last kept steps
  mutable Eigen::VectorXd room_;           // to work in
};

}  // namespace pounding
