#include <pounding/stepping/step_controller.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/stepping/event_functions.hpp>
#include <pounding/stepping/event_locator.hpp>

namespace pounding {
namespace {

// Maximum number of successive events without time advancing; more indicate a fault.
constexpr int max_events_in_place = 10000;
// First step in contact, as a fraction of the last one before it.
constexpr double first_contact_part = 0.1;
// A step may be stretched by this fraction to reach a breakpoint, to avoid a very short next step.
constexpr double max_stretch = 1e-3;
// Minimum step, as a fraction of the time at its beginning (at least one second).
constexpr double shortest_part = 1e-16;

// A rejected step that passed the end of a phase is retried up to this multiple of the time to that end, but at most
// this fraction of its previous length.
constexpr double behind_end = 1.01, max_aim = 0.9;

constexpr double safety = 0.9, safety_after_rejection = 0.5;
constexpr double max_shrink = 0.1, max_growth = 10;
constexpr double max_last_growth = 1.01;

}  // namespace

StepSizePolicy::Verdict ErrorControl::judge(const StepView& stepper, double step) {
  const double error = stepper.error_ratio();
  const bool accepted = error <= 1;
  const double share = accepted ? safety : safety * safety_after_rejection;
  const double factor =
      error > 0 ? share * std::pow(error, -1.0 / stepper.error_order()) : std::numeric_limits<double>::infinity();
  const double next = std::min(step * std::clamp(factor, max_shrink, max_growth), max_step_);
  const double left = end_ - (stepper.time() + step);
  if (!accepted || left <= 0 || 2 * next <= left) return {accepted, next};
  return {accepted, max_last_growth * next > left ? left : left / 2};
}

StepController::Aim StepController::aim(double wanted, double end, bool fixed) const {
  const double target = std::min(stepper_.view().next_break(), end);
  const double left = target - stepper_.view().time();
  const double step = fixed ? wanted : stepper_.view().step_towards(wanted, left);
  if (left > wanted * (1 + max_stretch) && left > step * (1 + 1e-9)) return {step, std::nullopt};
  return {std::abs(left - step) <= 1e-9 * step ? step : left, target};
}

void StepController::give_up(double step, const std::string& reason) const {
  const int link = stepper_.view().troublesome_link();
  const std::vector<std::string>& names = stepper_.view().system().names;
  std::string at;
  if (link >= 0 && link < static_cast<int>(names.size()))
    at = (link < stepper_.view().system().contact_count() ? " at link " : " at ") + names[link];
  else if (link >= 0)
    at = fmt::format(" at link {}", link + 1);
  throw SolverError(fmt::format("the solve stopped at t = {:.9g} s{} with a step of {:.3g} s: {}",
                                stepper_.view().time(), at, step, reason));
}

void StepController::give_up_too_short(double step) const {
  give_up(step,
          fmt::format("even the shortest step exceeds the tolerance {:g}. {}, or type a larger analysis.tolerance",
                      stepper_.view().options().tolerance,
                      stepper_.view().troublesome_link() < stepper_.view().system().contact_count()
                          ? "Check the unit of the stiffness of the link"
                          : "Type some hardening for the yielding parts"));
}

void StepController::reject(double step, StepSizePolicy& policy) const {
  if (const std::string reason = policy.on_reject(); !reason.empty()) give_up(step, reason);
}

void StepController::count_event_in_place(double step) {
  if (++events_in_place_ > max_events_in_place)
    give_up(step,
            "a contact opens and closes repeatedly without time advancing. Type another analysis.tolerance, or a gap "
            "that is not closed at rest");
}

double StepController::advance(double wanted, double end, StepSizePolicy& policy) {
  const bool fixed = policy.fixed();
  bool aimed = false;  // at the end of a phase that the step passed
  for (;;) {
    const double longest = stepper_.view().longest_step();
    const Aim goal = aim(fixed ? wanted : std::min(wanted, longest), end, fixed);
    if (!(goal.step > shortest_part * std::max(1.0, std::abs(stepper_.view().time())))) give_up_too_short(goal.step);
    ++trials_;
    if (!stepper_.try_step(goal.step, goal.end)) {
      reject(goal.step, policy);
      wanted = goal.step / 4;
      continue;
    }
    const StepSizePolicy::Verdict verdict = policy.judge(stepper_.view(), goal.step);
    if (!verdict.accepted) {
      reject(goal.step, policy);
      wanted = shortened(goal.step, verdict.next, aimed);
      continue;
    }
    // A short step to a breakpoint does not reduce the wanted length. Lengths beyond the limit of the ground motion are
    // not remembered.
    const double good = std::min(goal.end ? std::max(verdict.next, wanted) : verdict.next, longest);
    const bool was_in_contact = stepper_.view().in_contact();
    std::optional<double> located;
    try {
      if (stepper_.view().may_hold_event()) located = stepper_.locate_event(fixed || stepper_.view().locates_corners());
    } catch (const LostTrial&) {
      if (fixed) throw;
      reject(goal.step, policy);
      wanted = goal.step / 4;
      continue;
    }
    if (located && *located == 0) {
      count_event_in_place(goal.step);
      stepper_.apply_event();
      continue;
    }
    // A long trial may step over a whole contact undetected, and end inside it once it is shortened.
    if (located && !fixed && !(stepper_.view().error_ratio() <= 1)) {
      reject(*located, policy);
      wanted = *located / 2;
      continue;
    }
    if (located && *located < no_time(stepper_.view().time()))
      count_event_in_place(*located);
    else
      events_in_place_ = 0;
    try {
      stepper_.accept();
    } catch (const laws::BeyondDesign& error) {
      give_up(goal.step, error.what());
    }
    const bool is_in_contact = located ? stepper_.view().in_contact() : was_in_contact;  // phases change only at events
    const double next = next_step(good, was_in_contact, is_in_contact);
    touched_ = is_in_contact && !was_in_contact;
    return fixed ? wanted : next;
  }
}

// After the end of its phase, the force of a law bends sharply, so the error is not representative of the step up to
// that point.
double StepController::shortened(double step, double next, bool& aimed) const {
  const double usual = std::min(next, step / 2);
  const std::optional<double> end = aimed ? std::nullopt : stepper_.view().expected_end_of_phase();
  if (!end) return usual;
  aimed = true;
  return std::clamp(behind_end * *end, usual, max_aim * step);
}

double StepController::next_step(double good, bool was_in_contact, bool is_in_contact) {
  if (!was_in_contact) step_apart_ = good;
  if (touched_) step_at_touch_ = good;
  if (was_in_contact == is_in_contact) return good;
  const double remembered = is_in_contact ? step_at_touch_ : step_apart_;
  if (remembered != 0) return remembered;
  return is_in_contact ? good * first_contact_part : good;
}

void StepController::archive(Archive& archive) {
  archive(step_apart_, step_at_touch_, touched_, events_in_place_);
  StepState state = archive.reading() ? StepState{} : stepper_.save();
  archive(state);
  if (archive.reading()) stepper_.restore(state);
}

}  // namespace pounding
