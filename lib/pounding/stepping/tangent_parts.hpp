#pragma once
/// Structures whose forces have a memory (TangentForces), in a step.

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <memory>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/model/system.hpp>

namespace pounding {

/// Their pseudo-forces e = f - K u at an iterate of a step, with the tangent of f. The coordinates of these structures
/// are their degrees of freedom, massless ones included.
class TangentParts {
 public:
  /// Both arguments must outlive this object.
  TangentParts(const System& system, StructureSolver& solver);

  /// True if there are any.
  bool any() const { return !parts_.empty(); }

  /// Moves the massless degrees of freedom of displacements u to static equilibrium at the accepted state, with all
  /// others fixed. Throws SolverError if there is none.
  void settle(Eigen::Ref<Eigen::VectorXd> u);
  /// Returns all iterates to the accepted state.
  void begin_step();
  /// One iteration at displacements u; returns the largest relative change of strain (TangentForces::linearize).
  double linearize(Eigen::Ref<const Eigen::VectorXd> u);
  /// Sets the tangents of the last linearize() in the matrix of the step.
  void set_tangents();
  /// Adds e at displacements u by the last linearization, or by that of the stage at mid-step.
  void add_pseudo_force(Eigen::Ref<const Eigen::VectorXd> u, Eigen::VectorXd& e) const;
  void add_middle(Eigen::Ref<const Eigen::VectorXd> u, Eigen::VectorXd& e) const;
  /// Sets a velocity or acceleration of the massless degrees of freedom to that of the others by the last tangent. In
  /// an acceleration, the change of the tangent is neglected.
  void recover(Eigen::Ref<Eigen::VectorXd> rate) const;
  /// Records the stage at displacements u and a time from the beginning of the step [s].
  void record_stage(Eigen::Ref<const Eigen::VectorXd> u, double time, bool is_middle);
  /// Accepts the iterates as the end of the step, at displacements u; true if the forces there change, see
  /// TangentForces::accept.
  bool accept(Eigen::Ref<const Eigen::VectorXd> u, double min_reversal);

  /// TangentForces::member_forces of the structure with this first degree of freedom; empty for others.
  Eigen::VectorXd member_forces(int first_dof, double s) const;
  /// Stored energy beyond u.K u/2, and dissipated energy, at the accepted state with displacements u [J].
  TangentForces::Energy energy(Eigen::Ref<const Eigen::VectorXd> u) const;
  void archive(Archive& archive);

 private:
  // Force and tangent at displacements u.
  struct Linearization {
    Eigen::VectorXd u, force;
    SparseMatrix tangent;

    Eigen::VectorXd at(const Eigen::VectorXd& there) const { return force + tangent * (there - u); }
  };
  struct Part {
    int group, first_dof, first, size;  // first coordinate
    const TangentForces& forces;
    SparseMatrix stiffness;
    std::vector<int> massless;
    std::unique_ptr<TangentForces::Motion> motion;
    Linearization accepted, last, middle;
    mutable std::unique_ptr<Eigen::SimplicialLDLT<SparseMatrix>> massless_factor;

    // Factor of the block of a tangent at the massless degrees of freedom.
    const Eigen::SimplicialLDLT<SparseMatrix>& factor_of_massless(const SparseMatrix& tangent) const;
  };

  double linearize(Part& part, const Eigen::VectorXd& u);

  StructureSolver& solver_;
  std::vector<Part> parts_;
};

}  // namespace pounding
