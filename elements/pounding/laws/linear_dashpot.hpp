#pragma once
/// Dashpot parallel to a linear spring, given by a restitution, a damping ratio or a coefficient. For laws with the
/// members stiffness k [N/m], restitution, damping_ratio zeta [-], damping_coefficient c [N s/m], reduced_mass m [kg]
/// and formula; c = 2 zeta sqrt(k m).

#include <cmath>

#include <pounding/laws/checks.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// zeta [-].
template <class L>
double ratio_of_dashpot(const L& law) {
  if (law.damping_coefficient) return *law.damping_coefficient / (2 * std::sqrt(law.stiffness * law.reduced_mass));
  return law.restitution ? law.formula({.restitution = *law.restitution}) : *law.damping_ratio;
}

/// c [N s/m].
template <class L>
double coefficient_of_dashpot(const L& law) {
  if (law.damping_coefficient) return *law.damping_coefficient;
  return 2 * ratio_of_dashpot(law) * std::sqrt(law.stiffness * law.reduced_mass);
}

/// Throws std::invalid_argument for members out of range, and unless the dashpot is given exactly once. With a given
/// coefficient, the mass may be 0.
template <class L>
void check_dashpot(const L& law) {
  require_positive("stiffness", law.stiffness);
  require_restitution(law.restitution, sticks_at_zero<L>);
  require_not_negative("damping_ratio", law.damping_ratio);
  require_not_negative("damping_coefficient", law.damping_coefficient);
  require_one_damping(L::name, law.restitution,
                      {{"damping_ratio", &law.damping_ratio}, {"damping_coefficient", &law.damping_coefficient}});
  if (law.damping_coefficient)
    require_not_negative("reduced_mass", law.reduced_mass);
  else
    require_positive("reduced_mass", law.reduced_mass);
}

}  // namespace pounding::laws
