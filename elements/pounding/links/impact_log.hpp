#pragma once
/// Records the impacts of one link, one row each, from its kept steps.

#include <span>
#include <vector>

#include <pounding/links/contact.hpp>

namespace pounding {

/// Rows of the impacts of one link, filled step by step while an impact lasts. Between begin() and end() a row is open;
/// only then may the other functions be called.
class ImpactLog {
 public:
  /// `link` is written into the rows.
  explicit ImpactLog(int link) : link_(link) {}

  /// An impact begins at this time [s] with this closing speed [m/s].
  void begin(double time, double closing_speed);
  /// Adds a kept step inside the impact: impulse and work by Simpson's rule, peaks at both ends.
  void add(const LinkStep& step);
  /// The part of the work in this impact that the contact can give back now [J]; the rest counts as lost.
  void store(double energy);
  /// The force [N] at a time [s] inside a step, where it may be the largest of the impact.
  void record_peak(double time, double force);
  /// The force fell to zero at this time [s]; the bodies still overlap, so it may come back.
  void release(double time);
  /// The force came back after a release.
  void engage();
  /// The impact is over at this time [s]; `rate` at the separation is negative when the bodies part [m/s].
  void end(double time, double rate);
  /// Adds an impulse without duration [N s] and the energy that it took [J].
  void push(double impulse, double work);

  /// True while an impact lasts; and the row of the last impact.
  bool open() const { return open_; }
  const ImpactRow& current() const { return rows_.back(); }
  /// All impacts so far, the one that lasts included.
  std::span<const ImpactRow> rows() const { return rows_; }
  /// Work done on the link in all impacts [J].
  double work() const { return work_; }
  /// Reads or writes all of it.
  void archive(Archive& archive);

 private:
  int link_;
  bool open_ = false;
  std::vector<ImpactRow> rows_;
  double work_ = 0, work_of_impact_ = 0;  // in all impacts, in the last one
};

}  // namespace pounding
