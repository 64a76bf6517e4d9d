#pragma once
/// The driver of steps: what to try, what to reject, where to stop, what to keep.

#include <limits>
#include <string>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// Chooses the lengths of steps by their errors.
class StepSizePolicy {
 public:
  struct Verdict {
    bool accepted = false;
    double next = 0;  ///< step to try instead, or after this one [s]
  };

  virtual ~StepSizePolicy() = default;
  /// Whether all steps have the wanted length, whatever their error; shorter only at breakpoints, events and the end.
  virtual bool fixed() const { return false; }
  /// On the trial of `stepper`, a step of length `step` [s].
  virtual Verdict judge(const Stepper& stepper, double step) = 0;
  /// A trial was rejected. The run stops if this returns a reason.
  virtual std::string on_reject() { return {}; }
};

/// Steps of one length.
class FixedSteps final : public StepSizePolicy {
 public:
  bool fixed() const override { return true; }
  Verdict judge(const Stepper&, double step) override { return {true, step}; }
};

/// The next step is 0.9 times the step with the allowed error, 0.45 times after a rejection. It lies between a tenth of
/// the last step and ten times it, and is at most `max_step` [s]. The last step before `end` [s] may be 1 % longer;
/// what remains of up to two steps is divided into two equal ones. PETSc's TSADAPTBASIC follows the same rule.
class ErrorControl final : public StepSizePolicy {
 public:
  explicit ErrorControl(double max_step, double end = std::numeric_limits<double>::infinity())
      : max_step_(max_step), end_(end) {}
  Verdict judge(const Stepper& stepper, double step) override;
  /// Trials that were rejected so far.
  long rejected() const { return rejected_; }
  std::string on_reject() override {
    ++rejected_;
    return {};
  }

 private:
  double max_step_, end_;
  long rejected_ = 0;
};

/// Advances a Stepper by kept steps. With x- and x+ for the state before and after the events of an instant:
///
///     h <- wanted step, cut by Stepper::longest_step() and at the next breakpoint of the ground motion or the end
///     loop  trial <- try_step(x+, h)                 pure: scheme, link forces, pseudo-forces
///           if not solved, or error(trial) > 1:      shorten h, once to the end of a phase that it passed; continue
///           event <- first zero of an event function in the trial; each guess is a re-integrated step
///           if event at h = 0:                       apply it to x+ in place; continue
///           if event:                                trial <- the step that ends there
///                                                    if its error > 1: halve h; continue
///           accept: x- <- end of trial; histories, energies, scales; x+ <- apply events and rigid impacts to x-
///           return
///
/// Two lengths are remembered, the last good one without contact and that just behind a touch, which is shorter. A
/// first contact starts with a tenth of the step before it.
///
///     StepController controller(stepper);
///     ErrorControl policy(max_step, end);
///     double h = max_step / 64;
///     while (stepper.time() < end) h = controller.advance(h, end, policy);
class StepController {
 public:
  /// `stepper` must outlive it.
  explicit StepController(Stepper& stepper) : stepper_(stepper) {}

  /// Makes one kept step of at most about `wanted` [s] that does not pass `end` [s]; returns the step to want next.
  /// Throws SolverError, naming time, step and link, when no step is short enough, a contact opens and closes without
  /// time passing, or the policy gives up.
  double advance(double wanted, double end, StepSizePolicy& policy);

  /// Trial steps so far, without those that located events.
  long trials() const { return trials_; }
  Stepper& stepper() const { return stepper_; }

  /// With the stepper: after reading, steps have the same bits.
  void archive(Archive& archive);

 private:
  // A trial step; its exact end time if it is the next breakpoint or the end of the run.
  struct Aim {
    double step;
    std::optional<double> end;
  };

  Aim aim(double wanted, double end, bool fixed) const;
  [[noreturn]] void give_up(double step, const std::string& reason) const;
  [[noreturn]] void give_up_too_short(double step) const;
  void reject(double step, StepSizePolicy& policy) const;
  void count_event_in_place(double step);
  double shortened(double step, double next, bool& aimed) const;
  double next_step(double good, bool was_in_contact, bool is_in_contact);

  Stepper& stepper_;
  double step_apart_ = 0, step_at_touch_ = 0;  // last good steps without contact and behind a touch, zero for none [s]
  bool touched_ = false;                       // the present contact began with the last step
  int events_in_place_ = 0;                    // in a row, without time passing
  long trials_ = 0;
};

}  // namespace pounding
