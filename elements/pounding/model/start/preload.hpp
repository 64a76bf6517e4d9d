#pragma once
/// Contacts that press from the start.

#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Static equilibrium of the structures under the contacts that are preloaded, which is where the run begins. A link
/// with a gap of -p presses by p where its structures are undeformed; they give way until the forces balance:
///
///     K u + B F(p + B^T u) = 0,
///
/// with the law's force F of a first slow loading. Sets the structures' preload_displacement and presses the contacts.
/// Throws ModelError for a structure that nothing holds, that starts displaced, yields, or has elastic forces beyond K
/// u, for a law that has no force at rest, and where a preloaded link would start open or another one closed.
void press_preloaded(std::vector<Structure>& structures, std::vector<Link>& links);

}  // namespace pounding
