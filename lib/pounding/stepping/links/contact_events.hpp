#pragma once
/// Events of contacts at one instant: ends of phases and impacts of rigid bodies.

#include <vector>

#include <pounding/stepping/energy_ledger.hpp>
#include <pounding/stepping/equations.hpp>
#include <pounding/stepping/error_norm.hpp>
#include <pounding/stepping/event_functions.hpp>

namespace pounding {

/// Moves contacts to their next phases and applies the velocity jumps of rigid impacts.
class ContactEvents {
 public:
  /// All arguments must outlive this object. `tolerance`: bounces below this fraction of the velocity scale are not
  /// resolved.
  ContactEvents(Equations& equations, const EventFunctions& functions, ErrorNorm& norm, EnergyLedger& ledger,
                double tolerance)
      : equations_(equations),
        links_(equations.links),
        functions_(functions),
        norm_(norm),
        ledger_(ledger),
        tolerance_(tolerance) {}

  /// Applies the events located at `now` and updates its velocities and relative motion. All other members of `now` are
  /// stale afterwards. `in_place`: the events were found at the beginning of a step.
  void apply(const std::vector<EventId>& events, bool in_place, Instant& now);
  /// Number of events.
  long count() const { return count_; }
  void archive(Archive& archive) { archive(count_); }

 private:
  void strike(const std::vector<int>& touching, bool in_place, Instant& now);
  void settle(const Instant& now);

  const Equations& equations_;
  LinkSet& links_;
  const EventFunctions& functions_;
  ErrorNorm& norm_;
  EnergyLedger& ledger_;
  double tolerance_;
  long count_ = 0;
};

}  // namespace pounding
