#pragma once
/// The equations of motion of a whole model.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/links/contact.hpp>
#include <pounding/links/friction.hpp>
#include <pounding/structures/elastic_forces.hpp>
#include <pounding/structures/massless.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// Degrees of freedom first .. first + count - 1 that share one scale of displacement and velocity: one structure.
/// No entry of a matrix joins two groups.
struct Group {
  int first = 0;
  int count = 0;
  double displacement_floor = 0;  ///< smallest scale that errors are compared with [m]
  double velocity_floor = 0;      ///< [m/s]
  double by_mass = 0;             ///< Rayleigh damping of this structure: by_mass M + by_stiffness K [1/s]
  double by_stiffness = 0;        ///< [s]
  double modal_ratio =
      0;  ///< modal damping of this structure: part of critical damping in every mode of its M and K [-]
  int rigid_motions = 0;  ///< modes that meet no stiffness at all
  /// Instead of K u, which stays their part that is linear at rest, and what the damping goes by; nothing for K u
  /// alone.
  const ElasticForces* elastic = nullptr;
};

/// M a + C v + K u + B F = -P ag(t), with accelerations of the ground and forces over time in ag; displacements
/// relative to the ground; the links feel the relative displacements B^T u + S dg(t) + c, where the ground itself takes
/// the two sides of a link differently.
///
/// An unknown without mass has an empty row in M; no contact, no friction and no dashpot may act on it, springs may. In
/// a group with elastic forces of its own the Rayleigh damping acts on the motion in which such unknowns follow as K
/// says.
///
/// Link i closes by column i of B times u: +1 at the left body, -1 at the right one. A positive link force pushes
/// the bodies apart. The columns of the springs follow those of the contacts, -1 at the left end and +1 at the right
/// one, so that B^T u is their elongation and a positive force pulls: first parts of structures that yield, then
/// devices. Their deformation is B^T u - R F + c, with the forces F of the springs. Those of friction follow these.
/// Contacts, springs and elastic forces are owned by the model and outlive the system.
struct System {
  SparseMatrix mass;           ///< M, symmetric [kg]
  SparseMatrix damping;        ///< C without the Rayleigh and the modal damping of the groups [N s/m]
  SparseMatrix modal_damping;  ///< that of the groups whose modal damping has a matrix; empty for none [N s/m]
  SparseMatrix stiffness;      ///< K, symmetric [N/m]
  Eigen::MatrixXd
      load;  ///< P, one column a ground motion [kg], then one a force: minus the displacement on which it works [-]
  SparseMatrix gap_jacobian;  ///< B, one column a contact, then one a spring, then one or two a friction
  std::vector<Contact*> contacts;
  std::vector<std::string> names;  ///< of the contacts and then of the springs, for messages; may be empty
  std::vector<Spring*> springs;
  std::vector<bool> is_part;  ///< by spring, whether K holds what it stands for: a storey, a hinge, an isolator; no
                              ///< device. Empty for none
  SparseMatrix spring_flexibility;  ///< R, springs x springs, symmetric; empty for none
  std::vector<Friction> frictions;
  std::vector<Group> groups;
  std::vector<GroundMotion> grounds;  ///< components of the motions of the supports, then forces [N]: ag(t) together
  Eigen::MatrixXd gap_by_ground;   ///< S, links x grounds; empty where the ground takes both sides of every link alike
  Eigen::VectorXd gravity_offset;  ///< c, by gravity [m]; empty for none
  SparseMatrix outputs;            ///< n x k: what a report follows is outputs^T u

  /// Number of unknowns, of contacts, and of links, which are the columns of B.
  int size() const { return static_cast<int>(mass.rows()); }
  int contact_count() const { return static_cast<int>(contacts.size()); }
  int links() const { return static_cast<int>(gap_jacobian.cols()); }

  /// Whether the modal damping of this group has a matrix.
  bool has_modal_matrix(const Group& group) const;
  /// C without the Rayleigh damping, and without modal damping that has no matrix.
  SparseMatrix formed_damping() const {
    return modal_damping.size() > 0 ? SparseMatrix(damping + modal_damping) : damping;
  }

  /// Throws std::invalid_argument where the numbers of columns do not fit, or a friction has no contact that can take
  /// it.
  void check() const;
};

}  // namespace pounding
