#pragma once
/// Error control by the energy balance of a run: shortens the steps if the imbalance grows too large.

#include <pounding/core/archive.hpp>
#include <pounding/stepping/energy_ledger.hpp>

namespace pounding {

/// The errors of many small steps may all have the same sign: each bounce of a body at rest gains or loses a fraction
/// of the tolerance. While the imbalance is at most half of the tolerance, only the local errors limit the steps.
/// Beyond that, the step length decreases in proportion to the remaining tolerance, down to `shortest_part`.
class EnergyBudget {
 public:
  static constexpr double shortest_part = 0.1;

  /// `tolerance`: of the run. `error_order`: the error of a step is proportional to this power of its length.
  /// `minimum`: initial lower bound on the reference energy [J]. It decreases with every audit, since the errors of
  /// many small vibrations add up.
  EnergyBudget(double tolerance, int error_order, double minimum)
      : tolerance_(tolerance), error_order_(error_order), minimum_(minimum) {}

  /// Call once per accepted step. True if an audit is due; audits are infrequent since they need a global sum.
  bool is_due();
  void audit(const Energies& now);
  /// Allowed error of a step, as a fraction of the error that the tolerance allows.
  double share() const { return share_; }

  /// Writes or reads the state.
  void archive(Archive& archive);

 private:
  double tolerance_;
  int error_order_;
  double minimum_;
  double largest_ = 0;  // maximum energy input [J]
  double share_ = 1;
  double audits_ = 0;
  int steps_ = 0;  // since the last audit
};

}  // namespace pounding
