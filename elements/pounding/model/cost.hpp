#pragma once
/// The price of a run before it begins: its steps and its memory.

namespace pounding {

class Model;

/// The longest step that a run takes [s], from the duration, analysis: {max_step: ...}, the first periods and the
/// record's spacing. Motions of the ground shorten it while they last, and error control further.
double longest_step(const Model& model);

/// Throws ModelError for a model whose run, at its longest steps, needs more of them than it may take, has more links
/// or output times than limits.hpp allows, or keeps histories for which the machine has no memory.
void require_affordable(const Model& model);

}  // namespace pounding
