#pragma once
/// The equations of motion of a whole model.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include <pounding/contact.hpp>
#include <pounding/ground_motion.hpp>
#include <pounding/spring.hpp>

namespace pounding {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Degrees of freedom first .. first + count - 1 that share one scale of displacement and velocity: one structure.
/// No entry of a matrix joins two groups.
struct Group {
  int first = 0;
  int count = 0;
  double displacement_floor = 0;  ///< smallest scale that errors are compared with [m]
  double velocity_floor = 0;      ///< [m/s]
  double by_mass = 0;             ///< Rayleigh damping of this structure: by_mass M + by_stiffness K [1/s]
  double by_stiffness = 0;        ///< [s]
};

/// M a + C v + K u + B F(B^T u, B^T v) = -p ag(t), displacements relative to the ground.
///
/// An unknown without mass has an empty row in M; no link and no dashpot may act on it.
///
/// Link i closes by column i of B times u: +1 at the left body, -1 at the right one. A positive link force pushes
/// the bodies apart. The columns of the springs that yield follow those of the contacts. Both are owned by the model
/// and outlive the system.
struct System {
  SparseMatrix mass;       ///< M, symmetric [kg]
  SparseMatrix damping;    ///< C without the Rayleigh damping of the groups [N s/m]
  SparseMatrix stiffness;  ///< K, symmetric [N/m]
  Eigen::VectorXd load;    ///< p = M r [kg]
  SparseMatrix closing;    ///< B, one column a contact, then one a spring
  std::vector<Contact*> contacts;
  std::vector<std::string> names;  ///< of the contacts, for messages; may be empty
  std::vector<Spring*> springs;
  std::vector<Group> groups;
  GroundMotion ground;

  int size() const { return static_cast<int>(mass.rows()); }
  int contact_count() const { return static_cast<int>(contacts.size()); }
  int links() const { return static_cast<int>(contacts.size() + springs.size()); }
};

}  // namespace pounding
