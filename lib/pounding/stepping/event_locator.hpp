#pragma once
/// Locates the first event inside a trial step by re-integrated steps.

#include <functional>
#include <optional>
#include <vector>

#include <pounding/core/error.hpp>
#include <pounding/stepping/event_functions.hpp>
#include <pounding/stepping/springs/spring_corners.hpp>

namespace pounding {

/// Events that end a trial, and where.
struct LocatedEvents {
  double step = 0;  ///< from the beginning to the events [s]; zero if they are there already
  std::vector<EventId> events;
};

/// A step that could not be solved while an event was located in it; a shorter one may be.
class LostTrial : public SolverError {
 public:
  using SolverError::SolverError;
};

/// Shortest trial step that ends where an event function is zero. Each guess is a step integrated anew, so the end of
/// the trial is as exact there as at the end of any step. Springs have no event functions: a trial is shortened to the
/// first corner of a spring's force that the cubic through its ends shows.
///
/// Example: a touch between two steps of 10 ms is found after some five trials of 0 to 10 ms.
class EventLocator {
 public:
  /// Makes the trial a step of length h from the present instant; `end` is its exact end time if that is known. False
  /// if it could not be solved.
  using TryStep = std::function<bool(double h, std::optional<double> end)>;

  /// Both must outlive it.
  EventLocator(const EventFunctions& functions, const SpringForces& springs)
      : functions_(functions), corners_(springs, functions.links()), links_(functions.links()) {}

  /// Whether there can be anything to locate in the solved step `trial` from `now`; where not, locate() would find
  /// nothing.
  bool may_find(const Instant& now, const Trial& trial) const;
  /// About where the first phase of a contact that presses ends inside a solved step [s after its beginning]; nothing
  /// if none does.
  std::optional<double> expected_end(const Instant& now, const Trial& trial) const;

  /// `trial` is a solved step from `now` that `try_step` replaces; `at_corners`: corners of springs end it too. Nothing
  /// if no phase ends inside it; the trial may still have become shorter, because of a corner. Nearly simultaneous
  /// events are grouped. Throws LostTrial if a step cannot be solved while an event is located; the trial must then be
  /// made anew.
  std::optional<LocatedEvents> locate(const Instant& now, const Trial& trial, bool at_corners,
                                      const TryStep& try_step) const;

 private:
  struct Search;

  const EventFunctions& functions_;
  const SpringCorners corners_;
  const LinkSet& links_;
};

}  // namespace pounding
