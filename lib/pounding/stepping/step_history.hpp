#pragma once
/// The present instant, the last kept step and the trial that may follow it.

#include <array>
#include <memory>

#include <pounding/stepping/equations.hpp>

namespace pounding {

/// Keeping a trial swaps pointers and copies nothing. The present instant is the end of the last kept step until
/// something changes there; then it is a copy of it.
class StepHistory {
 public:
  explicit StepHistory(const Equations& equations);
  StepHistory(const StepHistory&) = delete;
  StepHistory& operator=(const StepHistory&) = delete;

  /// The present trial step.
  Trial& trial() { return *trial_; }
  const Trial& trial() const { return *trial_; }
  /// The last kept step; its length is zero before the first one.
  const Trial& kept() const { return *kept_; }
  /// The instant at its beginning.
  const Instant& begin() const { return *begin_; }
  /// The present instant, just after any events.
  const Instant& now() const { return *now_; }
  /// Whether the present instant is another one than the end of the kept step.
  bool changed_at_end() const { return changed_at_end_; }

  /// The present instant, to be changed.
  Instant& change_now();
  /// The trial becomes the last kept step.
  void keep_trial();
  /// The present instant becomes both ends of the last kept step: it is as if that step had led here.
  void collapse();
  /// Restarts with a last step of zero length and constant acceleration.
  void restart();

  /// Writes the instants and the last kept step, or reads them back.
  void archive(Archive& archive);

 private:
  // The trial, the last kept step and the one before it take turns.
  std::unique_ptr<Trial> trial_, kept_, previous_;
  // Two, so that the beginning of the kept step may be one while the present instant is the other.
  std::array<Instant, 2> changed_;
  Instant *now_ = nullptr, *begin_ = nullptr;
  bool changed_at_end_ = false;
};

}  // namespace pounding
