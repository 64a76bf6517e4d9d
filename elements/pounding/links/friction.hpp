#pragma once
/// The force of friction at a contact that presses, and its slopes.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include <pounding/links/contact.hpp>

namespace pounding {

/// Coulomb's friction where a contact presses, regularised: F_t = coefficient max(F_n, 0) v_t / sqrt(|v_t|^2 + sliding^2)
/// with the force F_n of the contact and the rates v_t of the columns `first` .. `first + count - 1` of B.
struct Friction {
  int contact = 0;
  int first = 0, count = 1;  ///< one column in the plane, two in space
  double coefficient = 0;
  double sliding = 0;  ///< velocity at which 0.71 of the full force is reached [m/s]
};

/// A vector in the plane of a contact; its second component is unused where only one direction slides.
using Sliding = Eigen::Vector2d;

/// Force of a friction against its sliding rates, and its slopes.
struct FrictionForce {
  Sliding force = Sliding::Zero();                      ///< [N]
  Sliding by_penetration = Sliding::Zero();             ///< of the contact [N/m]
  Sliding by_rate = Sliding::Zero();                    ///< of the contact [N s/m]
  Eigen::Matrix2d by_sliding = Eigen::Matrix2d::Zero();  ///< [force, rate] [N s/m]
};

/// The formula of Friction, of the force of its contact and of the rates v_t [m/s]. A contact that pulls has no friction.
inline FrictionForce friction_force(const Friction& friction, const laws::Response& contact, const Sliding& rates) {
  FrictionForce f;
  if (!(contact.force > 0)) return f;
  const double size = std::sqrt(rates.squaredNorm() + friction.sliding * friction.sliding);
  const Sliding direction = rates / size;
  f.force = friction.coefficient * contact.force * direction;
  f.by_penetration = friction.coefficient * contact.by_penetration * direction;
  f.by_rate = friction.coefficient * contact.by_rate * direction;
  f.by_sliding = friction.coefficient * contact.force / size *
                 (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  return f;
}

}  // namespace pounding
