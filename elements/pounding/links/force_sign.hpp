#pragma once
/// Sign of a contact force near separation, where the force itself vanishes.

#include <algorithm>
#include <cmath>

#include <pounding/laws/law.hpp>

namespace pounding {

/// Penetration [m] at which the sign of a force is evaluated: at least a small fraction of the peak penetration. Thus a
/// release shortly before separation is not missed, and a law whose formula continues to negative penetrations does not
/// appear to press again.
inline double at_least_a_trace(double penetration, const laws::Impact& impact) noexcept {
  return std::max(penetration, 1e-9 * impact.largest_penetration);
}

/// Sum of the magnitudes of the terms of a force [N], at a penetration from at_least_a_trace().
inline double sum_of_terms(const laws::Response& r, double penetration, double rate) noexcept {
  return std::abs(r.by_penetration * penetration) + std::abs(r.by_rate * rate);
}

/// Ratio of the law's force, negative for tension, to the sum of the magnitudes of its terms [-]: near separation all
/// terms vanish, but this ratio remains well defined.
template <class Law>
double signed_force(const Law& law, double penetration, double rate, const laws::Impact& impact) noexcept {
  const double d = at_least_a_trace(penetration, impact);
  const laws::Response r = law.contact(d, rate, impact);
  const double all = sum_of_terms(r, d, rate);
  return all > 0 ? r.force / all : 0;
}

}  // namespace pounding
