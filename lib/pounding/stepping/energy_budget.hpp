#pragma once
/// How closely the energies of a run have balanced so far, and how much shorter its steps must be for them to balance
/// at its end.

#include <pounding/core/archive.hpp>
#include <pounding/stepping/energy_ledger.hpp>

namespace pounding {

/// Errors of many small steps may all have one sign: bounces of a body in a rest gain or lose a part of the tolerance
/// each. While the imbalance is at most half of the tolerance, steps are as long as their own errors allow. Beyond it
/// their length falls in proportion to what is left of the tolerance, down to `shortest_part`.
class EnergyBudget {
 public:
  static constexpr double shortest_part = 0.1;

  /// `tolerance`: of the run. `error_order`: an error in one step falls with this power of its length. `minimum`:
  /// energy that errors are compared with at first, when there is hardly any [J]. It counts less with every audit: the
  /// errors of many small vibrations add up.
  EnergyBudget(double tolerance, int error_order, double minimum)
      : tolerance_(tolerance), error_order_(error_order), minimum_(minimum) {}

  /// A step was kept. Whether the energies are wanted now: seldom, since they cost a sum over all processes.
  bool is_due();
  void audit(const Energies& now);
  /// The error that is allowed in a step, as part of the one that the tolerance allows.
  double share() const { return share_; }

  /// Writes what it knows, or reads it back.
  void archive(Archive& archive);

 private:
  double tolerance_;
  int error_order_;
  double minimum_;
  double largest_ = 0;  // energy put in so far [J]
  double share_ = 1;
  double audits_ = 0;
  int steps_ = 0;  // since the last audit
};

}  // namespace pounding
