#pragma once
/// Springs with a dashpot inside, whose length is integrated along the steps (Spring::slips).

#include <Eigen/Core>
#include <vector>

#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// The slip w of such a spring follows dw/dt = g(d - w): a scheme advances it by its own stages, as it does velocities.
/// In a stage w = slip + lag g(d - w), which the spring solves by itself with the slip and the lag of its LinkMotion.
/// At instants the lag is zero.
class SpringSlips {
 public:
  /// `links` must outlive it.
  explicit SpringSlips(const LinkSet& links);

  /// Whether any spring slips; without, nothing below need be called.
  bool any() const { return !slipping_.empty(); }
  /// Springs that slip, counted from the first spring.
  const std::vector<int>& slipping() const { return slipping_; }
  /// Whether this link is one of them.
  bool slips(int link) const { return links_.is_spring(link) && is_slipping_[link - links_.contacts()]; }

  /// Slips where a run begins.
  void start(Instant& x) const;
  /// Rates of the slips at an instant with its motion, zero for all other springs [m/s].
  Eigen::VectorXd rates(const Instant& x) const;
  /// Slips in the middle of a trial, on the cubics through both ends.
  void find_middle(const Instant& x, Trial& trial) const;
  /// Adds the error by Simpson's rule, as add_simpson_error() does.
  void add_simpson_error(const Instant& x, const Trial& trial, double part, StepError& error) const;

 private:
  const LinkSet& links_;
  std::vector<bool> is_slipping_;
  std::vector<int> slipping_;
};

}  // namespace pounding
