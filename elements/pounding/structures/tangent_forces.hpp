#pragma once
/// Forces of a structure whose members have a memory, such as fibre members, with their tangent.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include <pounding/core/archive.hpp>

namespace pounding {

/// Forces that replace K u and depend on the history of the displacements u, which are relative to the state at rest.
/// There the force is zero, loads at rest included. The members may have unknowns of their own, such as section
/// deformations. These are iterated together with u: each linearize() is one Newton iteration of them.
///
/// All functions are const. What changes is the motion of the members, a value of the caller.
class TangentForces {
 public:
  /// Accepted states of the members, and the iterate of a step from there.
  class Motion {
   public:
    virtual ~Motion() = default;
    /// Writes or reads everything.
    virtual void archive(Archive& archive) = 0;
  };
  /// Energies relative to the state at rest [J].
  struct Energy {
    double stored = 0;      ///< including the potential of the loads at rest
    double dissipated = 0;  ///< by yielding, cracking and crushing
  };

  virtual ~TangentForces() = default;

  /// Displacements of the state at rest from the undeformed state [m].
  virtual const Eigen::VectorXd& at_rest() const = 0;
  /// The motion at rest, without a step.
  virtual std::unique_ptr<Motion> start() const = 0;

  /// Returns the iterate to the accepted state.
  virtual void begin_step(Motion& motion) const = 0;
  /// One iteration at the displacements u: moves the unknowns of the members by the last linearization, then evaluates
  /// every section once. Sets the force [N], [N m] and its tangent, which is symmetric, compressed and of a constant
  /// pattern, both with the unknowns of the members eliminated. Returns the largest change of strain in this iteration,
  /// relative to the largest strain so far.
  virtual double linearize(Motion& motion, const Eigen::VectorXd& u, Eigen::VectorXd& force,
                           Eigen::SparseMatrix<double>& tangent) const = 0;
  /// Moves the unknowns of the members to the displacements u by the last linearization, without an evaluation, and
  /// records the stage of the step at this time, from 0 at its beginning [s].
  virtual void record_stage(Motion& motion, const Eigen::VectorXd& u, double time) const = 0;
  /// Accepts the iterate as the end of the step. Fibres follow reversals inside the step of at least `min_reversal`
  /// times the largest strain so far. True if any did: then the forces at the end change.
  virtual bool accept(Motion& motion, double min_reversal) const = 0;
  /// Forces in the members at a fraction s (0 to 1) of the last accepted step, from which reported forces follow
  /// together with the displacements: parabola through beginning, middle and end.
  virtual Eigen::VectorXd member_forces(const Motion& motion, double s) const = 0;
  /// Energies at the accepted state with displacements u.
  virtual Energy energy(const Motion& motion, const Eigen::VectorXd& u) const = 0;
};

}  // namespace pounding
