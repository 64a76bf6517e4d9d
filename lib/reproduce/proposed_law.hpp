#pragma once
/// The paper's Eq. 16 with its Table 2, as functions of the target restitution and of the number k/v.

#include <cmath>

#include <pounding/laws/damping_formulas.hpp>
#include <pounding/laws/exact_damping.hpp>

namespace pounding::reproduce {

/// a = c_imp v/k of Eq. 16; k/v is a number that depends on the units chosen.
inline double proposed_factor(double restitution, double k_over_v) {
  return laws::naderpour_2015({.restitution = restitution, .closing_speed = 1, .stiffness = 1e3 * k_over_v});
}

/// Restitution of a free impact with this damping.
inline double proposed_restitution(double restitution, double k_over_v) {
  return laws::restitution_of_factor(proposed_factor(restitution, k_over_v));
}

/// N - 1 of Table 2 at this restitution.
inline double excess_exponent(double restitution) {
  return std::log10(proposed_factor(restitution, 10) / proposed_factor(restitution, 1));
}

/// The number k/v for which Eq. 16 gives exactly the target restitution.
inline double fitting_k_over_v(double restitution) {
  const double needed = laws::exact_factor({.restitution = restitution}) / proposed_factor(restitution, 1);
  return std::pow(needed, 1 / excess_exponent(restitution));
}

}  // namespace pounding::reproduce
