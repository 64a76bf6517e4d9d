#pragma once
/// Locates the first event inside a trial step by re-integration.

#include <functional>
#include <optional>
#include <vector>

#include <pounding/core/error.hpp>
#include <pounding/stepping/event_functions.hpp>
#include <pounding/stepping/springs/spring_corners.hpp>

namespace pounding {

/// Events at the end of a trial, and their time.
struct LocatedEvents {
  double step = 0;  ///< from the beginning of the step to the events [s]; zero if they are at the beginning
  std::vector<EventId> events;
};

/// Thrown if a step cannot be solved during event location; a shorter step may succeed.
class LostTrial : public SolverError {
 public:
  using SolverError::SolverError;
};

/// Finds the shortest trial step that ends at a zero of an event function. Each guess is a re-integrated step, so that
/// its end is as accurate as that of any other step. Springs have no event functions: a trial is shortened to the first
/// corner of a spring force on the cubic through its ends.
///
/// Example: locating a touch within a 10 ms step takes about five trials.
class EventLocator {
 public:
  /// Integrates a trial step of length h from the present instant; `end` is its exact end time if known. Returns false
  /// if the step cannot be solved.
  using TryStep = std::function<bool(double h, std::optional<double> end)>;

  /// Both arguments must outlive this object.
  EventLocator(const EventFunctions& functions, SpringForces& springs)
      : functions_(functions), corners_(springs, functions.links()), links_(functions.links()) {}

  /// True if the solved step `trial` from `now` may contain an event; if false, locate() would find none.
  bool may_find(const Instant& now, const Trial& trial) const;
  /// Estimated end of the first contact phase that ends inside a solved step [s after its beginning]; `nullopt` if none
  /// does.
  std::optional<double> expected_end(const Instant& now, const Trial& trial) const;

  /// Locates the first event inside `trial`, a solved step from `now` that `try_step` replaces. `at_corners`: corners
  /// of springs also end the trial. Returns `nullopt` if no phase ends inside it; a corner may still have shortened the
  /// trial. Nearly simultaneous events are grouped. Throws LostTrial if a step cannot be solved; the trial is then
  /// invalid and must be computed again.
  std::optional<LocatedEvents> locate(const Instant& now, const Trial& trial, bool at_corners,
                                      const TryStep& try_step) const;

 private:
  struct Search;

  const EventFunctions& functions_;
  const SpringCorners corners_;
  const LinkSet& links_;
};

}  // namespace pounding
