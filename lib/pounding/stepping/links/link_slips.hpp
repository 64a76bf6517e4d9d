#pragma once
/// Links whose force depends on a slip that is integrated with the steps: springs with a series dashpot
/// (Spring::slips), and friction with a tangential stiffness.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// The slip w of such a spring satisfies dw/dt = g(d - w), that of friction is its p (see Friction). The schemes
/// integrate both by their own stages, like velocities. In a stage, w = slip + lag dw/dt, which the link solves
/// internally from the slip and lag of its LinkMotion. At instants the lag is zero. Slips are counted from the first
/// spring.
///
/// The slip of sliding friction follows from its motion, not from a rate. Its rate at an instant is therefore that of
/// the last stage before it, Instant::friction_slip_rate.
class LinkSlips {
 public:
  /// `links` must outlive this object.
  explicit LinkSlips(const LinkSet& links);

  /// True if any link slips; otherwise the functions below need not be called.
  bool any() const { return !slipping_.empty(); }
  /// Number of slips, including the unused ones of other springs.
  int size() const { return static_cast<int>(is_slipping_.size()); }
  /// Indices of the slips in use.
  const std::vector<int>& slipping() const { return slipping_; }
  /// True if this link is a slipping spring or a direction of such friction.
  bool slips(int link) const { return link >= links_.contacts() && is_slipping_[link - links_.contacts()]; }

  /// Sets the slips at the start of a run.
  void start(Instant& x) const;
  /// Sets the slip of friction at open contacts: without elastic displacement.
  void release(Instant& x) const;
  /// Rates of the slips at an instant; zero for all other springs [m/s].
  Eigen::VectorXd rates(const Instant& x) const;
  /// The same without the slip of sliding friction: what the trapezoidal rule may use, which does not damp it.
  Eigen::VectorXd smooth_rates(const Instant& x) const;
  /// Rates in a solved stage with these active links, whose motion is `motion_of` their number.
  void rates_of_stage(const std::vector<int>& active, const std::function<LinkMotion(std::size_t)>& motion_of,
                      Eigen::Ref<Eigen::VectorXd> rates) const;
  /// Sets the rates of friction at the end of a trial.
  void keep_friction_rates(const Eigen::VectorXd& rates, Instant& end) const;
  /// Replaces the rates of sliding friction by their mean over a step: the trapezoidal rule has twice that.
  void average_sliding_rates(const Instant& x, Trial& trial) const;
  /// Sets the slips at mid-step of a trial: from the cubics through both ends for springs, by the collocation formula
  /// with a lag for friction, so that it stays at its limit.
  void find_middle(const Instant& x, Trial& trial) const;
  /// Adds the error estimate of Simpson's rule; see add_simpson_error(). Sliding friction adds none.
  void add_simpson_error(const Instant& x, const Trial& trial, double part, StepError& error) const;

 private:
  FrictionForce friction_at(const Friction& friction, const Instant& x) const;
  bool sticks(const Friction& friction, const Instant& x) const;
  int index(const Friction& friction, int direction) const { return friction.first + direction - links_.contacts(); }

  const LinkSet& links_;
  std::vector<bool> is_slipping_;
  std::vector<int> slipping_, springs_;
  std::vector<const Friction*> frictions_;
};

}  // namespace pounding
