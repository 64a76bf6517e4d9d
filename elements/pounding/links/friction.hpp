#pragma once
/// Friction along a closed contact: force and slopes.

#include <array>
#include <cmath>

#include <pounding/laws/law.hpp>

namespace pounding {

/// Regularised Coulomb friction of one contact: F_t = coefficient max(F_n, 0) v_t / sqrt(|v_t|^2 + sliding^2), with the
/// contact force F_n and the sliding velocities v_t of the columns `first` .. `first + count - 1` of B.
struct Friction {
  int contact = 0;           ///< link whose force is F_n
  int first = 0, count = 1;  ///< columns of B: one in a plane model, two in space
  double coefficient = 0;    ///< Coulomb friction coefficient [-]
  double sliding = 0;        ///< velocity at which the force is 0.71 of coefficient * F_n [m/s]
};

/// Vector in the plane of a contact; the second component is zero if sliding has a single direction.
using Sliding = std::array<double, 2>;

/// Friction force and its slopes.
struct FrictionForce {
  Sliding force{};                      ///< [N]
  Sliding by_penetration{};             ///< slope by the penetration of the contact [N/m]
  Sliding by_rate{};                    ///< slope by the rate of the contact [N s/m]
  std::array<Sliding, 2> by_sliding{};  ///< [i][j]: slope of component i by sliding velocity j [N s/m]
};

/// Regularised Coulomb force for the response of a contact and its sliding velocities v_t [m/s]; zero for a contact in
/// tension.
inline FrictionForce friction_force(const Friction& friction, const laws::Response& contact,
                                    const Sliding& rates) noexcept {
  FrictionForce f;
  if (!(contact.force > 0)) return f;
  const double size = std::sqrt(rates[0] * rates[0] + rates[1] * rates[1] + friction.sliding * friction.sliding);
  const Sliding direction{rates[0] / size, rates[1] / size};
  for (int i = 0; i < 2; ++i) {
    f.force[i] = friction.coefficient * contact.force * direction[i];
    f.by_penetration[i] = friction.coefficient * contact.by_penetration * direction[i];
    f.by_rate[i] = friction.coefficient * contact.by_rate * direction[i];
    for (int j = 0; j < 2; ++j)
      f.by_sliding[i][j] =
          friction.coefficient * contact.force / size * ((i == j ? 1 : 0) - direction[i] * direction[j]);
  }
  return f;
}

}  // namespace pounding
