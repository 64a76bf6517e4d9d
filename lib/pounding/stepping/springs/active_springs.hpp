#pragma once
/// Springs whose force changes in a trial step; all others keep theirs and cost nothing.

#include <Eigen/Core>
#include <vector>

#include <pounding/stepping/springs/elastic_ranges.hpp>

namespace pounding {

/// A part that yields answers with a constant force, zero at first, while it stays elastic. A trial begins with the
/// springs that yield where it begins; where another one is found to leave its constant force at the middle or the end
/// of the trial, that is made anew with this one too. Springs without corners are always active, and so are all where
/// none gives way to its own force. Depends on the present state and on the trial alone.
class ActiveSprings {
 public:
  /// Both must outlive it. Where none gives way, all are active for good: these are storeys, which are few, and between
  /// their yielding steps stay as short as Simpson's rule asks for where forces act.
  ActiveSprings(const LinkSet& links, const ElasticRanges& ranges)
      : links_(links),
        ranges_(ranges),
        is_active_(static_cast<std::size_t>(links.springs()), !links.relief().any()),
        held_(Eigen::VectorXd::Zero(links.size())) {}

  /// A trial of length h from `now`.
  void begin(const Instant& now, double h);
  /// Whether springs were added because they left their forces in this trial.
  bool grow(const Trial& trial);

  /// Whether none is active, for which the ranges of all springs speak.
  bool rests() const { return rests_ >= 0; }
  /// Whether the force of this spring is sought in the present stage.
  bool is_active(int link) const { return is_active_[link - links_.contacts()]; }
  /// Forces of all links [N]: of the springs that are not active, zero for all others.
  const Eigen::VectorXd& held() const { return held_; }
  /// Whether any of these is not zero.
  bool holds() const { return holds_; }

 private:
  bool leaves(int link, double force) const { return force != constant_[link - links_.contacts()]; }
  void rest();
  void hold();

  const LinkSet& links_;
  const ElasticRanges& ranges_;
  long rests_ = -1;  // version of the ranges in which all springs rest; negative where any is active
  std::vector<bool> is_active_;
  std::vector<double> constant_;  // force of each spring where the trial begins
  Eigen::VectorXd held_;
  bool holds_ = false;
};

}  // namespace pounding
