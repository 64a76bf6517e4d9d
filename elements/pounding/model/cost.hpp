#pragma once
/// Cost of a run before it starts: its steps and its memory.

namespace pounding {

class Model;

/// Maximum step of a run [s], from the duration, analysis: {max_step: ...}, the first periods and the sampling of the
/// record. Ground motions shorten it while they last, and error control shortens it further.
double longest_step(const Model& model);

/// Throws ModelError for a model that exceeds its maximum number of steps even with the longest steps, has more links
/// or output times than limits.hpp allows, or records histories that do not fit in memory.
void require_affordable(const Model& model);

}  // namespace pounding
