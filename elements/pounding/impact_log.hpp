#pragma once
/// Keeps the rows of a link's impacts from its kept steps.

#include <span>
#include <vector>

#include <pounding/contact.hpp>

namespace pounding {

class ImpactLog {
 public:
  explicit ImpactLog(int link) : link_(link) {}

  void begin(double time, double closing_speed);
  /// Adds a kept step inside the impact: impulse, work and the peaks at its ends. Integrals by Simpson's rule.
  void add(const LinkStep& step);
  /// The force was this large at a time inside a step.
  void follow_peak(double time, double force);
  /// The force fell to zero and may come back.
  void release(double time);
  /// The force is back.
  void engage();
  void end(double time, double rate);
  /// Adds an impulse without duration and the work that it took.
  void push(double impulse, double work);

  bool open() const { return open_; }
  const ImpactRow& current() const { return rows_.back(); }
  std::span<const ImpactRow> rows() const { return rows_; }
  double work() const { return work_; }
  void archive(Archive& archive);

 private:
  int link_;
  bool open_ = false;
  std::vector<ImpactRow> rows_;
  double work_ = 0;
};

}  // namespace pounding
