#pragma once
/// Equations of motion of a whole model.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <string>
#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/links/contact.hpp>
#include <pounding/links/friction.hpp>
#include <pounding/structures/elastic_forces.hpp>
#include <pounding/structures/massless.hpp>
#include <pounding/structures/spring.hpp>
#include <pounding/structures/tangent_forces.hpp>

namespace pounding {

/// Degrees of freedom first .. first + count - 1 of one structure, with a common scale of displacement and velocity. No
/// matrix entry couples two groups.
struct Group {
  int first = 0;
  int count = 0;
  double displacement_floor = 0;  ///< lower bound on the scale for relative errors [m]
  double velocity_floor = 0;      ///< [m/s]
  double by_mass = 0;             ///< Rayleigh damping of this structure: by_mass M + by_stiffness K [1/s]
  double by_stiffness = 0;        ///< [s]
  double modal_ratio =
      0;  ///< modal damping of this structure: fraction of critical damping in each mode of its M and K [-]
  int rigid_motions = 0;  ///< number of modes with zero stiffness
  /// Nonlinear elastic forces that replace K u; K is their tangent at rest and defines Rayleigh damping. Null if
  /// linear.
  const ElasticForces* elastic = nullptr;
  /// Forces with a memory that replace K u; K defines Rayleigh damping. Null if there are none.
  const TangentForces* tangent = nullptr;
};

/// M a + C v + K u + B F = -P ag(t), with accelerations of the ground and forces over time in ag. Displacements are
/// relative to the ground. The relative displacements of the links are B^T u + S dg(t) + c, with S for links whose two
/// sides have different ground motions.
///
/// A massless unknown has an empty row in M. Contacts, friction and dashpots may not act on it, springs may. In a group
/// with its own elastic forces, Rayleigh damping acts on the motion in which such unknowns follow statically by K.
///
/// Link i closes by column i of B times u: +1 at the left body, -1 at the right one. A positive link force pushes the
/// bodies apart. The columns of the springs follow those of the contacts, -1 at the left end and +1 at the right one,
/// so that B^T u is their elongation and a positive force is tension: first yielding parts of structures, then devices.
/// Their deformation is B^T u - R F + c, with the spring forces F. The columns of friction come last. Contacts,
/// elements and elastic forces are owned by the model and outlive the system; no run changes them.
struct System {
  SparseMatrix mass;           ///< M, symmetric [kg]
  SparseMatrix damping;        ///< C without Rayleigh and modal damping of the groups [N s/m]
  SparseMatrix modal_damping;  ///< of the groups whose modal damping has a matrix; empty for none [N s/m]
  SparseMatrix stiffness;      ///< K, symmetric [N/m]
  Eigen::MatrixXd
      load;  ///< P, one column per ground motion [kg], then one per force: minus its conjugate displacement [-]
  SparseMatrix gap_jacobian;  ///< B, one column per contact, then one per spring, then one or two per friction
  std::vector<const Contact*> contacts;
  /// Memory of each contact before the first step; may be empty if all are as in Contact::initial().
  std::vector<ContactMemory> initial_contacts;
  std::vector<std::string> names;  ///< of the contacts, then of the springs, for messages; may be empty
  /// Elements in the order of their columns, one column per deformation; called springs where they have one.
  std::vector<const Element*> elements;
  std::vector<bool> is_part;  ///< per spring: true if K contains its stiffness (storey, hinge, isolator), false for a
                              ///< device; empty for none
  /// Deformations of the springs at rest under gravity, from which an initial displacement of a structure loads them
  /// slowly before the run. Empty without such displacements: the run starts from its initial state.
  Eigen::VectorXd loaded_from;
  SparseMatrix spring_flexibility;  ///< R, springs x springs, symmetric; empty for none
  std::vector<Friction> frictions;
  std::vector<Group> groups;
  std::vector<GroundMotion> grounds;  ///< components of the support motions, then forces [N]: together ag(t)
  Eigen::MatrixXd gap_by_ground;   ///< S, links x grounds; empty if both sides of each link have the same ground motion
  Eigen::VectorXd gravity_offset;  ///< c, due to gravity [m]; empty for none
  SparseMatrix outputs;            ///< n x k: the reported displacements are outputs^T u

  /// Number of unknowns, of contacts, and of links, i.e. columns of B.
  int size() const { return static_cast<int>(mass.rows()); }
  int contact_count() const { return static_cast<int>(contacts.size()); }
  /// Number of deformations of all elements.
  int spring_count() const;
  int links() const { return static_cast<int>(gap_jacobian.cols()); }

  /// True if any group has forces with a memory.
  bool has_tangents() const {
    return std::ranges::any_of(groups, [](const Group& group) { return group.tangent; });
  }
  /// True if the modal damping of this group has a matrix.
  bool has_modal_matrix(const Group& group) const;
  /// C without Rayleigh damping and without modal damping that has no matrix.
  SparseMatrix formed_damping() const {
    return modal_damping.size() > 0 ? SparseMatrix(damping + modal_damping) : damping;
  }

  /// Throws std::invalid_argument for inconsistent numbers of columns, and for a friction without a suitable contact.
  void check() const;
};

}  // namespace pounding
