#pragma once
/// A few hundred modes that carry all that links and ground can tell of one linear structure.

#include <Eigen/Core>
#include <memory>

#include <pounding/linear/group_modes.hpp>
#include <pounding/model/system.hpp>
#include <pounding/reduction/flexibility_errors.hpp>

namespace pounding::petsc {

/// Vectors that drive one structure, a column each, at all of its unknowns.
struct ReducedInputs {
  Eigen::MatrixXd links;   ///< forces of links and devices: columns of B
  Eigen::MatrixXd parts;   ///< moments or forces of what yields in the structure: columns of B
  Eigen::MatrixXd ground;  ///< loads of ground motions and forces over time: columns of P
  Eigen::MatrixXd starts;  ///< displacements and velocities from which the run starts; columns of zeros are left out
  double shift = 0;        ///< square of the circular frequency of a contact [rad^2/s^2]; 0 for no block there

  /// Same vectors and shift to the last bit.
  bool operator==(const ReducedInputs& other) const;
};

/// Blocks of the two chains: one is the static answer alone.
struct ReducedDepth {
  int links = 4;
  int ground = 20;
  bool shifted = true;  ///< with the block at the frequency of the contact
  int parts = 2;        ///< of what yields

  bool operator==(const ReducedDepth&) const = default;
};

/// Ritz modes on two block-Lanczos chains and one block at the frequency of the contact,
///
///   K^-1 (M K^-1)^j B,  j < depth.links,     K^-1 (M K^-1)^j P,  j < depth.ground,     (K + s M)^-1 B,
///
/// and a third chain as that of the links for what yields, with depth.parts blocks and none at the contact.
///
/// the load-dependent vectors of Wilson, Yuan and Dickens (1982) for the ground and for every link, with the vectors
/// about a frequency of Gu, Ma and Hulbert (2000). Each chain is orthogonal by itself and grows from its orthonormal
/// last block. The chains are joined at the end: made orthogonal to each other on the way, the shorter one would be
/// spoilt. Directions below 1e-9 of their column are dropped, at the joint below 1e-12.
///
/// The ends of the links are as stiff as in the structure or stiffer, at every frequency without damping below the
/// first mode and at every real shift: B^T V (V^T (K + s M) V)^-1 V^T B never exceeds B^T (K + s M)^-1 B. Static
/// answers are exact. With as many directions as unknowns with mass the modes are the natural ones.
///
/// Unknowns without mass follow statically; a force on one of them counts by what it does to the others (see
/// SpringRelief). Deterministic: the same input gives the same bits.
///
/// Options of the factors: -pounding_red_factor_...
class ReducedModes {
 public:
  /// Throws std::invalid_argument for a mass matrix that is not positive definite, for a stiffness that is singular or
  /// indefinite (a structure that nothing holds, one that buckles), and where an input has another number of rows.
  ReducedModes(const SparseMatrix& mass, const SparseMatrix& stiffness, const ReducedInputs& inputs);
  ~ReducedModes();
  ReducedModes(ReducedModes&&) noexcept;

  /// Takes other inputs from now on, with the bits of an object made with them. What depends on the matrices alone is
  /// kept, and so is a chain whose inputs are the same. Throws as the constructor for an input with another number of
  /// rows.
  void drive(const ReducedInputs& inputs);

  /// Ritz modes of this depth. Blocks that are there already are used again, so a second depth costs little. A chain
  /// ends by itself where it has nothing new to give. Throws SolverError where a solve fails.
  GroupModes modes(const ReducedDepth& depth);
  /// Ritz modes of no more blocks, in those of this depth.
  ShadowModes shadow(const ReducedDepth& depth, const ReducedDepth& less);
  /// Ritz modes of this depth with the directions that one block of the links more would bring: none where the chain
  /// has ended.
  FurtherDirections further(const ReducedDepth& depth);
  /// Number of modes of this depth, and of a shadow of it, without the modes.
  int count(const ReducedDepth& depth);
  int count(const ReducedDepth& depth, const ReducedDepth& less);
  /// Unknowns with mass: the largest number of modes.
  int maximum() const;

 private:
  struct Structure;
  std::unique_ptr<Structure> structure_;
};

}  // namespace pounding::petsc
