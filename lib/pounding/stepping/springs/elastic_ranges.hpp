#pragma once
/// Fast path for springs that stay elastic during a step: only their deformation is updated.

#include <Eigen/Core>

#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// The ranges of deformation in which springs keep their force (Spring::elastic), stored contiguously. A step in which
/// every spring stays in its range costs a few comparisons per spring; the results are bitwise those of the full
/// evaluation.
class ElasticRanges {
 public:
  /// `links` must outlive it.
  explicit ElasticRanges(const LinkSet& links);

  /// Reads the range of every spring. Call it at the start and after the history of any spring has left its range.
  void read();
  /// Number of calls of read().
  long version() const { return version_; }
  /// Force of every spring in its range [N]; zero for those that have none.
  const Eigen::VectorXd& forces() const { return forces_; }

  /// True if all springs are in their ranges at `now` and, at their present rates, `ahead` seconds later.
  bool hold(const Instant& now, double ahead);
  /// True if all springs have the forces of their ranges at both ends of a trial and the cubics through their motions
  /// stay inside the ranges. Sets Trial::spring_paths.
  bool stay(const Instant& begin, Trial& trial) const;

 private:
  const double* of_springs(const Eigen::MatrixXd& by_link, Instant::Column column) const {
    return by_link.col(column).data() + links_.contacts();
  }
  auto springs(const Eigen::VectorXd& by_link) const { return by_link.segment(links_.contacts(), links_.springs()); }
  void deformations(const Instant& x, double* d) const;

  const LinkSet& links_;
  bool all_ = false;  // every spring has a range
  long version_ = 0;
  Eigen::VectorXd low_, high_, forces_;
  Eigen::VectorXd room_;  // workspace
};

}  // namespace pounding
