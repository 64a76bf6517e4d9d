#pragma once
/// The damping that gives adams_impact a restitution, at every touch.

#include <pounding/laws/table.hpp>

namespace pounding::study {

/// As laws::exact_adams_impact, which integrates impacts for milliseconds, to 1e-8 of it: from a polynomial over the
/// logarithm of the depth of full damping that is made when a history first comes there. Its pieces are the same
/// whatever was asked before, so that the answer depends on `asked` alone; each thread makes its own.
double tabled_adams_impact(const laws::CalibrationTarget& requested);

}  // namespace pounding::study
