#pragma once
/// Step control: chooses, rejects, shortens and accepts trial steps.

#include <limits>
#include <string>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// Chooses step lengths from the errors of trial steps.
class StepSizePolicy {
 public:
  struct Verdict {
    bool accepted = false;
    double next = 0;  ///< step to try instead, or next step [s]
  };

  virtual ~StepSizePolicy() = default;
  /// True if all steps have the requested length regardless of their error; they are shorter only at breakpoints,
  /// events and the end.
  virtual bool fixed() const { return false; }
  /// Judges the trial of `stepper`, a step of length `step` [s].
  virtual Verdict judge(const StepView& stepper, double step) = 0;
  /// Called when a trial is rejected. The run stops if this returns a reason.
  virtual std::string on_reject() { return {}; }
};

/// Steps of constant length.
class FixedSteps final : public StepSizePolicy {
 public:
  bool fixed() const override { return true; }
  Verdict judge(const StepView&, double step) override { return {true, step}; }
};

/// The next step is 0.9 times the step with the allowed error, or 0.45 times after a rejection. It lies between 0.1 and
/// 10 times the last step and is at most `max_step` [s]. The last step before `end` [s] may be 1 % longer; a remainder
/// of up to two steps is divided into two equal ones. PETSc's TSADAPTBASIC follows the same rule.
class ErrorControl final : public StepSizePolicy {
 public:
  explicit ErrorControl(double max_step, double end = std::numeric_limits<double>::infinity())
      : max_step_(max_step), end_(end) {}
  Verdict judge(const StepView& stepper, double step) override;
  /// Number of rejected trials.
  long rejected() const { return rejected_; }
  std::string on_reject() override {
    ++rejected_;
    return {};
  }

 private:
  double max_step_, end_;
  long rejected_ = 0;
};

/// Advances a Stepper by accepted steps. x- and x+ are the states before and after the events of an instant:
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
/// Two step lengths are stored: the last good one without contact and the shorter one just after a touch. The first
/// contact starts with a tenth of the previous step.
///
///     StepController controller(stepper);
///     ErrorControl policy(max_step, end);
///     double h = max_step / 64;
///     while (stepper.time() < end) h = controller.advance(h, end, policy);
class StepController {
 public:
  /// `stepper` must outlive this object.
  explicit StepController(Stepper& stepper) : stepper_(stepper) {}

  /// Makes one accepted step of about `wanted` [s] at most that does not pass `end` [s], and returns the length to
  /// request next. Throws SolverError with time, step and link if no step is short enough, if a contact opens and
  /// closes without time advancing, or if the policy stops the run.
  double advance(double wanted, double end, StepSizePolicy& policy);

  /// Number of trial steps, without those of event location.
  long trials() const { return trials_; }
  Stepper& stepper() const { return stepper_; }

  /// Writes or reads the state, including the stepper; a resumed run is bitwise identical.
  void archive(Archive& archive);

 private:
  // A trial step; `end` is its exact end time if it ends at the next breakpoint or at the end of the run.
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
  double step_apart_ = 0, step_at_touch_ = 0;  // last good steps without contact and after a touch, zero if none [s]
  bool touched_ = false;                       // the current contact began with the last step
  int events_in_place_ = 0;                    // consecutive, without time advancing
  long trials_ = 0;
};

}  // namespace pounding
