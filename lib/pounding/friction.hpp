#pragma once
/// The force of friction at a contact that presses, and its slopes.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include <pounding/contact.hpp>
#include <pounding/system.hpp>

namespace pounding {

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
inline FrictionForce friction_force(const Friction& friction, const LinkForce& contact, const Sliding& rates) {
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
