#pragma once
/// Events of contacts at one instant: ends of phases, impacts of rigid bodies.

#include <vector>

#include <pounding/stepping/energy_ledger.hpp>
#include <pounding/stepping/equations.hpp>
#include <pounding/stepping/error_norm.hpp>
#include <pounding/stepping/event_functions.hpp>

namespace pounding {

/// Contacts enter their next phases; rigid ones that touch bounce, which makes velocities jump.
class ContactEvents {
 public:
  /// All must outlive it. `tolerance`: bounces below this part of the velocity scale are not resolved.
  ContactEvents(const Equations& equations, const EventFunctions& functions, ErrorNorm& norm, EnergyLedger& ledger,
                double tolerance)
      : equations_(equations),
        links_(equations.links),
        functions_(functions),
        norm_(norm),
        ledger_(ledger),
        tolerance_(tolerance) {}

  /// Applies the events located at `now` and changes its velocities and relative motion; the rest of `now` is out of
  /// balance afterwards. `in_place`: the events were there already at the beginning of a step.
  void apply(const std::vector<EventId>& events, bool in_place, Instant& now);
  /// How many so far.
  long count() const { return count_; }
  void archive(Archive& archive) { archive(count_); }

 private:
  void strike(const std::vector<int>& touching, bool in_place, Instant& now);
  void settle(const Instant& now);

  const Equations& equations_;
  const LinkSet& links_;
  const EventFunctions& functions_;
  ErrorNorm& norm_;
  EnergyLedger& ledger_;
  double tolerance_;
  long count_ = 0;
};

}  // namespace pounding
