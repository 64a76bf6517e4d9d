#pragma once
/// Everything about a contact that changes during a run.

#include <pounding/core/archive.hpp>
#include <pounding/links/contact_state.hpp>
#include <pounding/links/impact_log.hpp>

namespace pounding {

/// Phase, current impact and past impacts of one contact: a plain value. Contact::initial() returns that of an open
/// contact; only functions of the contact change it, at accepted states. To undo steps, restore a copy.
struct ContactMemory {
  ContactState state{};
  double drift = 0;  ///< of a rigid contact: overlap by round-off at the end of the last rest [m]
  ImpactLog log{0};

  /// Current phase, from the last accepted state.
  ContactPhase phase() const noexcept { return state.phase; }
  /// One row per impact, in the order of the touches. During an impact the last row is unfinished (t_end NaN) and
  /// splits its work into lost and stored energy.
  std::span<const ImpactRow> impacts() const noexcept { return log.rows(); }
  void archive(Archive& archive) { archive(state, drift, log); }
};

}  // namespace pounding
