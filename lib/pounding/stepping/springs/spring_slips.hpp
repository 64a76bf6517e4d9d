#pragma once
/// Springs with a series dashpot, whose elongation is integrated with the steps (Spring::slips).

#include <Eigen/Core>
#include <vector>

#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// The slip w of such a spring satisfies dw/dt = g(d - w). The schemes integrate it by their own stages, like
/// velocities. In a stage, w = slip + lag g(d - w), which the spring solves internally from the slip and lag of its
/// LinkMotion. At instants the lag is zero.
class SpringSlips {
 public:
  /// `links` must outlive this object.
  explicit SpringSlips(const LinkSet& links);

  /// True if any spring slips; otherwise the functions below need not be called.
  bool any() const { return !slipping_.empty(); }
  /// Indices of the slipping springs, counted from the first spring.
  const std::vector<int>& slipping() const { return slipping_; }
  /// True if this link is a slipping spring.
  bool slips(int link) const { return links_.is_spring(link) && is_slipping_[link - links_.contacts()]; }

  /// Sets the slips at the start of a run.
  void start(Instant& x) const;
  /// Rates of the slips at an instant from its motion; zero for all other springs [m/s].
  Eigen::VectorXd rates(const Instant& x) const;
  /// Sets the slips at mid-step of a trial from the cubics through both ends.
  void find_middle(const Instant& x, Trial& trial) const;
  /// Adds the error estimate of Simpson's rule; see add_simpson_error().
  void add_simpson_error(const Instant& x, const Trial& trial, double part, StepError& error) const;

 private:
  const LinkSet& links_;
  std::vector<bool> is_slipping_;
  std::vector<int> slipping_;
};

}  // namespace pounding
