#pragma once
/// The sign of a contact force near the separation, where the force itself vanishes.

#include <algorithm>
#include <cmath>

#include <pounding/laws/law.hpp>

namespace pounding {

/// Penetration [m] at which the sign of a force is asked for: no less than a trace of the peak penetration. So a
/// release shortly before the separation is not missed, and a law whose formula continues to negative penetrations does
/// not seem to press again.
inline double at_least_a_trace(double penetration, const laws::Impact& impact) noexcept {
  return std::max(penetration, 1e-9 * impact.largest_penetration);
}

/// Sum of the magnitudes of a force's terms [N], at a penetration that is at least a trace, see above.
inline double sum_of_terms(const laws::Response& r, double penetration, double rate) noexcept {
  return std::abs(r.by_penetration * penetration) + std::abs(r.by_rate * rate);
}

/// The law's force, negative where it would pull, over the sum of the magnitudes of its terms [-]: near the separation
/// all terms vanish, but this ratio stays as sharp as elsewhere.
template <class Law>
double signed_force(const Law& law, double penetration, double rate, const laws::Impact& impact) noexcept {
  const double d = at_least_a_trace(penetration, impact);
  const laws::Response r = law.contact(d, rate, impact);
  const double all = sum_of_terms(r, d, rate);
  return all > 0 ? r.force / all : 0;
}

}  // namespace pounding
