#pragma once
/// Springs whose force changes in a trial step; all others keep their force and cost nothing.

#include <Eigen/Core>
#include <vector>

#include <pounding/stepping/springs/elastic_ranges.hpp>

namespace pounding {

/// An elastic yielding part has a constant force, initially zero. A trial starts with the springs that yield at its
/// beginning. If another spring leaves its constant force at the middle or the end of the trial, the trial is repeated
/// with this spring as well. Springs without corners are always active, and so are all springs if none has relief. The
/// result depends on the present state and the trial only.
class ActiveSprings {
 public:
  /// Both arguments must outlive this object. Without relief, all springs are always active: such springs are the few
  /// storeys of shear buildings.
  ActiveSprings(const LinkSet& links, ElasticRanges& ranges)
      : links_(links),
        ranges_(ranges),
        is_active_(static_cast<std::size_t>(links.springs()), !links.relief().any()),
        held_(Eigen::VectorXd::Zero(links.size())) {}

  /// Starts a trial of length h from `now`.
  void begin(const Instant& now, double h);
  /// True if springs were added because they left their constant forces in this trial.
  bool grow(const Trial& trial);

  /// True if no spring is active; ElasticRanges then covers all springs.
  bool rests() const { return rests_ >= 0; }
  /// True if the force of this spring is an unknown of the current stage.
  bool is_active(int link) const { return is_active_[link - links_.contacts()]; }
  /// Link forces [N] of the springs that are not active; zero for all other links.
  const Eigen::VectorXd& held() const { return held_; }
  /// True if any of these forces is nonzero.
  bool holds() const { return holds_; }

 private:
  bool leaves(int link, double force) const { return force != constant_[link - links_.contacts()]; }
  void rest();
  void hold();

  const LinkSet& links_;
  ElasticRanges& ranges_;
  long rests_ = -1;  // version of the ranges in which all springs rest; negative if any spring is active
  std::vector<bool> is_active_;
  std::vector<double> constant_;  // force of each spring at the beginning of the trial
  Eigen::VectorXd held_;
  bool holds_ = false;
};

}  // namespace pounding
