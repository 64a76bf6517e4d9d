#pragma once
/// Damping of adams_impact for a target restitution, at every touch.

#include <pounding/laws/table.hpp>

namespace pounding::study {

/// Approximates laws::exact_adams_impact, which integrates impacts for milliseconds, to a relative error of 1e-8. It
/// uses a polynomial in the logarithm of the depth of full damping, which is created when a history first requires it.
/// Its pieces do not depend on the order of requests, so the function is pure; each thread has its own pieces.
double tabled_adams_impact(const laws::CalibrationTarget& requested);

}  // namespace pounding::study
