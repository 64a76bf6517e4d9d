#pragma once
/// Records the impacts of one link, one row each, from accepted steps.

#include <span>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/links/impact_row.hpp>
#include <pounding/links/link_step.hpp>

namespace pounding {

/// Rows of the impacts of one link, filled step by step during an impact. A row is open between begin() and end(); the
/// other functions may be called only then.
class ImpactLog {
 public:
  /// `link` is written into the rows.
  explicit ImpactLog(int link) : link_(link) {}

  /// Starts the next impact at this time [s] with this closing speed [m/s].
  void begin(double time, double closing_speed);
  /// Adds an accepted step within the impact: impulse and work by Simpson's rule, peaks at both ends.
  void add(const LinkStep& step);
  /// Recoverable energy of the contact at present [J]; the rest of the work of this impact counts as lost.
  void store(double energy);
  /// The force [N] at a time [s] within a step, which may be the maximum of the impact.
  void record_peak(double time, double force);
  /// The force fell to zero at this time [s]; the bodies still overlap, so it may return.
  void release(double time);
  /// The force returned after a release.
  void engage();
  /// Ends the impact at this time [s]; `rate` at separation is negative if the bodies separate [m/s].
  void end(double time, double rate);
  /// Adds an impulse without duration [N s] and the energy dissipated by it [J].
  void push(double impulse, double work);

  /// True during an impact; and the row of the last impact.
  bool open() const { return open_; }
  const ImpactRow& current() const { return rows_.back(); }
  /// All impacts, including an unfinished one.
  std::span<const ImpactRow> rows() const { return rows_; }
  /// Work done on the link in all impacts [J].
  double work() const { return work_; }
  /// Reads or writes the complete state.
  void archive(Archive& archive);

 private:
  int link_;
  bool open_ = false;
  std::vector<ImpactRow> rows_;
  double work_ = 0, work_of_impact_ = 0;  // in all impacts, in the last one
};

}  // namespace pounding
