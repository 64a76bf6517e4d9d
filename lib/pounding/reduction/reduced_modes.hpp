#pragma once
/// A few hundred modes that represent the response of one linear structure to links and ground motion.

#include <Eigen/Core>
#include <memory>

#include <pounding/linear/group_modes.hpp>
#include <pounding/model/system.hpp>
#include <pounding/reduction/flexibility_errors.hpp>

namespace pounding::petsc {

/// Vectors that act on one structure, one per column, at all of its unknowns.
struct ReducedInputs {
  Eigen::MatrixXd links;   ///< forces of links and devices: columns of B
  Eigen::MatrixXd parts;   ///< moments or forces of yielding parts: columns of B
  Eigen::MatrixXd ground;  ///< loads of ground motions and time-dependent forces: columns of P
  Eigen::MatrixXd starts;  ///< initial displacements and velocities of the run; zero columns are omitted
  double shift = 0;        ///< square of the circular frequency of a contact [rad^2/s^2]; 0 for no block there

  /// Bitwise equality of vectors and shift.
  bool operator==(const ReducedInputs& other) const;
};

/// Number of blocks per chain; one block is the static response only.
struct ReducedDepth {
  int links = 4;
  int ground = 20;
  bool shifted = true;  ///< includes the block at the contact frequency
  int parts = 2;        ///< blocks of yielding parts

  bool operator==(const ReducedDepth&) const = default;
};

/// Ritz modes of two block-Lanczos chains and one block at the contact frequency,
///
///   K^-1 (M K^-1)^j B,  j < depth.links,     K^-1 (M K^-1)^j P,  j < depth.ground,     (K + s M)^-1 B,
///
/// and of a third chain for yielding parts, built like that of the links, with depth.parts blocks and none at the
/// contact frequency.
///
/// These are the load-dependent vectors of Wilson, Yuan and Dickens (1982) for the ground and for every link, with the
/// vectors about a frequency of Gu, Ma and Hulbert (2000). Each chain is orthogonalized separately and continues from
/// its orthonormal last block. The chains are joined at the end; orthogonalizing them against each other during the
/// recurrence would spoil the shorter one. Directions below 1e-9 of their column are dropped; at the joint, below
/// 1e-12.
///
/// The ends of the links are at least as stiff as in the structure, at every frequency below the first undamped mode
/// and at every real shift: B^T V (V^T (K + s M) V)^-1 V^T B never exceeds B^T (K + s M)^-1 B. Static responses are
/// exact. With as many directions as dynamic degrees of freedom the modes are the natural ones.
///
/// Massless degrees of freedom follow statically; a force on one of them acts through the others (see SpringRelief).
/// Deterministic: equal input gives bitwise identical output.
///
/// Options of the factors: -pounding_red_factor_...
class ReducedModes {
 public:
  /// Throws std::invalid_argument for a mass matrix that is not positive definite, for a singular or indefinite
  /// stiffness (an unsupported or buckling structure), and for an input with the wrong number of rows.
  ReducedModes(const SparseMatrix& mass, const SparseMatrix& stiffness, const ReducedInputs& inputs);
  ~ReducedModes();
  ReducedModes(ReducedModes&&) noexcept;

  /// Replaces the inputs; results are bitwise identical to those of a new object. Keeps everything that depends on the
  /// matrices only, and chains whose inputs are unchanged. Throws as the constructor for an input with the wrong number
  /// of rows.
  void drive(const ReducedInputs& inputs);

  /// Ritz modes of this depth. Existing blocks are reused, so a second depth costs little. A chain ends when it adds no
  /// new direction. Throws SolverError if a solve fails.
  GroupModes modes(const ReducedDepth& depth);
  /// Ritz modes of a smaller depth `less`, expressed in the modes of `depth`.
  ShadowModes shadow(const ReducedDepth& depth, const ReducedDepth& less);
  /// Ritz modes of this depth with the directions that one more block of the links would add; none if the chain has
  /// ended.
  FurtherDirections further(const ReducedDepth& depth);
  /// Number of modes of this depth, and of a shadow of it, without computing them.
  int count(const ReducedDepth& depth);
  int count(const ReducedDepth& depth, const ReducedDepth& less);
  /// Number of dynamic degrees of freedom: the maximum number of modes.
  int maximum() const;

 private:
  struct Structure;
  std::unique_ptr<Structure> structure_;
};

}  // namespace pounding::petsc
