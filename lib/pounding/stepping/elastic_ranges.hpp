#pragma once
/// Springs that stay elastic in a whole step: nothing of them need be evaluated, nor their history moved but to where they stand.

#include <Eigen/Core>

#include <pounding/stepping/link_set.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// The ranges of deformation in which springs keep their force (Spring::elastic), side by side. A step in which every spring keeps to its
/// range, as most do before anything yields, costs a few comparisons a spring, with the bits of the long way.
class ElasticRanges {
 public:
  /// `links` must outlive it.
  explicit ElasticRanges(const LinkSet& links);

  /// Reads the range of every spring: after the run began, and after the history of any spring moved otherwise than within its range.
  void read();
  /// Changes when a range does.
  long version() const { return version_; }
  /// Force of every spring in its range [N]; zero for those that have none.
  const Eigen::VectorXd& forces() const { return forces_; }

  /// Whether all springs are in their ranges, and are still so long after `now` at their present rates [s].
  bool hold(const Instant& now, double ahead) const;
  /// Whether all springs have the forces of their ranges at both ends of a trial and stay inside, wherever the cubics through their
  /// motions go between. Then Trial::spring_paths holds those cubics.
  bool stay(const Instant& begin, Trial& trial) const;

 private:
  const double* of_springs(const Eigen::MatrixXd& by_link, Instant::Column column) const { return by_link.col(column).data() + links_.contacts(); }
  auto springs(const Eigen::VectorXd& by_link) const { return by_link.segment(links_.contacts(), links_.springs()); }
  void deformations(const Instant& x, double* d) const;

  const LinkSet& links_;
  bool all_ = false;  // whether every spring has a range
  long version_ = 0;
  Eigen::VectorXd low_, high_, forces_;
  mutable Eigen::VectorXd room_;  // to work in
};

}  // namespace pounding
