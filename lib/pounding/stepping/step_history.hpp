#pragma once
/// The present instant, the last accepted step and the next trial.

#include <array>
#include <memory>

#include <pounding/stepping/equations.hpp>

namespace pounding {

/// Accepting a trial swaps pointers without copying. The present instant is the end of the last accepted step; it is
/// copied when it is first changed.
class StepHistory {
 public:
  explicit StepHistory(const Equations& equations);
  StepHistory(const StepHistory&) = delete;
  StepHistory& operator=(const StepHistory&) = delete;

  /// The present trial step.
  Trial& trial() { return *trial_; }
  const Trial& trial() const { return *trial_; }
  /// The last accepted step; its length is zero before the first one.
  const Trial& kept() const { return *kept_; }
  /// The instant at its beginning.
  const Instant& begin() const { return *begin_; }
  /// The present instant, just after any events.
  const Instant& now() const { return *now_; }
  /// True if the present instant differs from the end of the accepted step.
  bool changed_at_end() const { return changed_at_end_; }

  /// The present instant, for modification.
  Instant& change_now();
  /// Makes the trial the last accepted step.
  void keep_trial();
  /// Makes the present instant both ends of the last accepted step.
  void collapse();
  /// Restarts with a last step of zero length and constant acceleration.
  void restart();

  /// Writes or reads the instants and the last accepted step.
  void archive(Archive& archive);

 private:
  // The trial, the last accepted step and the one before it, used in rotation.
  std::unique_ptr<Trial> trial_, kept_, previous_;
  // Two, so that the beginning of the accepted step and the present instant can both be changed copies.
  std::array<Instant, 2> changed_;
  Instant *now_ = nullptr, *begin_ = nullptr;
  bool changed_at_end_ = false;
};

}  // namespace pounding
