#pragma once
/// Keeps the rows of a link's impacts from its kept steps.

#include <span>
#include <vector>

#include <pounding/links/contact.hpp>

namespace pounding {

/// The rows of the impacts of one link, filled step by step while an impact lasts.
class ImpactLog {
 public:
  /// `link` is the index that the rows carry.
  explicit ImpactLog(int link) : link_(link) {}

  /// An impact begins at this time [s] and closing speed [m/s].
  void begin(double time, double closing_speed);
  /// Adds a kept step inside the impact: impulse, work and the peaks at its ends. Integrals by Simpson's rule.
  void add(const LinkStep& step);
  /// The force was this large at a time inside a step.
  void follow_peak(double time, double force);
  /// The force fell to zero and may come back.
  void release(double time);
  /// The force is back.
  void engage();
  /// The impact is over; `rate` is that of the separation, negative when the bodies part [m/s].
  void end(double time, double rate);
  /// Adds an impulse without duration and the work that it took.
  void push(double impulse, double work);

  /// Whether an impact lasts, and its row.
  bool open() const { return open_; }
  const ImpactRow& current() const { return rows_.back(); }
  /// All impacts so far, the one that lasts included.
  std::span<const ImpactRow> rows() const { return rows_; }
  /// Work done on the link by all impacts [J].
  double work() const { return work_; }
  /// All that goes on from one step to the next.
  void archive(Archive& archive);

 private:
  int link_;
  bool open_ = false;
  std::vector<ImpactRow> rows_;
  double work_ = 0;
};

}  // namespace pounding
