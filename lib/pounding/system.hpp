#pragma once
/// The equations of motion of a whole model, as the stepper sees them.

#include <Eigen/Core>
#include <vector>

#include <pounding/contact.hpp>
#include <pounding/ground_motion.hpp>

namespace pounding {

/// Degrees of freedom first .. first + count - 1 that share one scale of displacement and velocity: one structure.
struct Group {
  int first = 0;
  int count = 0;
  double displacement_floor = 0;  ///< smallest scale that errors are compared with [m]
  double velocity_floor = 0;      ///< [m/s]
};

/// M a + C v + K u + B F(B^T u, B^T v) = -p ag(t), displacements relative to the ground.
///
/// Link i closes by column i of B times u: +1 at the left body, -1 at the right one. A positive link force pushes
/// the bodies apart. Contacts are owned by the model and outlive the system.
struct System {
  Eigen::MatrixXd mass;       ///< M, symmetric positive definite [kg]
  Eigen::MatrixXd damping;    ///< C [N s/m]
  Eigen::MatrixXd stiffness;  ///< K [N/m]
  Eigen::VectorXd load;       ///< p = M r [kg]
  Eigen::MatrixXd closing;    ///< B, one column a link
  std::vector<Contact*> contacts;
  std::vector<Group> groups;
  GroundMotion ground;

  int size() const { return static_cast<int>(mass.rows()); }
  int links() const { return static_cast<int>(contacts.size()); }
};

}  // namespace pounding
