#pragma once
/// Contacts that are closed at the start.

#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Static equilibrium of the structures with preloaded contacts, the initial state of the run. A link with a gap of -p
/// is pressed by p in the undeformed state; the structures deform until the forces balance:
///
///     K u + B F(p + B^T u) = 0,
///
/// with the law's force F of a first slow loading. Sets preload_displacement of the structures and presses the
/// contacts. Throws ModelError for a structure without supports, that starts displaced, yields, or has elastic forces
/// beyond K u, for a law without a force at rest, and if a preloaded link would start open or another link closed.
void press_preloaded(std::vector<Structure>& structures, std::vector<Link>& links);

}  // namespace pounding
