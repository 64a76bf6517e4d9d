#pragma once
/// The equations of motion of a system as every part of a step sees them.

#include <Eigen/Core>
#include <span>
#include <vector>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/links/rigid_impacts.hpp>
#include <pounding/stepping/pseudo_forces.hpp>
#include <pounding/stepping/short_motions.hpp>
#include <pounding/stepping/springs/elastic_ranges.hpp>
#include <pounding/stepping/springs/spring_forces.hpp>
#include <pounding/stepping/springs/spring_slips.hpp>
#include <pounding/stepping/step_state.hpp>
#include <pounding/stepping/support_excitation.hpp>

namespace pounding {

/// M a + C v + K u + e(u) + B F = -P ag(t), with pseudo-forces e and link forces F; see System.
struct Equations {
  /// Both must outlive it. Throws std::invalid_argument where parts of the system do not fit (System::check).
  /// `carries`: the scheme has an acceleration of its own, Instant::carried.
  Equations(const System& system, StructureSolver& solver, bool carries);
  Equations(const Equations&) = delete;
  Equations& operator=(const Equations&) = delete;

  const System& system;
  StructureSolver& solver;
  const LinkSet links;
  const SpringForces springs;
  ElasticRanges ranges;
  const SpringSlips slips;
  SupportExcitation supports;
  const ShortMotions short_motions;
  const PseudoForces pseudo_forces;
  const RigidContacts rigid;
  const int width;  ///< columns of Instant::motion that have products: u v a, and carried where the scheme has it

  /// An Instant and a Trial of the right sizes, all zero.
  Instant zero_instant() const;
  Trial zero_trial() const;

  /// Products of `count` columns of the motion from `first` on: K times each, C times all but the displacement.
  void multiply(Instant& x, int first, int count) const;
  /// Relative motion of all links from the motion, and relief of the springs from their forces.
  void gather(Instant& x) const {
    solver.gather(x.motion.leftCols(width), x.relative);
    if (springs.any()) springs.relieve(x);
  }
  /// e at a displacement.
  void pseudo_force(Eigen::Ref<const Eigen::VectorXd> displacement, Eigen::VectorXd& force) const;

  /// Dynamic equilibrium: link forces from the motions of the links, and `r`, the forces of everything else, becomes
  /// the acceleration. Held contacts take the forces that leave no closing acceleration; those that hold the same
  /// bodies share them. `inside_step`: forces that dip below zero there are zero unless the law may pull.
  /// `springs_stay`: those of springs are in `force` already.
  void balance(std::span<const LinkMotion> motions, const Eigen::MatrixXd& by_ground, bool inside_step,
               bool springs_stay, Eigen::VectorXd& force, Eigen::Ref<Eigen::VectorXd> r) const;
  /// Everything of an instant but displacement, velocity, K u and pseudo-forces, which are given: dynamic equilibrium
  /// just after it.
  void balance(Instant& x) const;
  /// Mid-step motions, forces and accelerations of a trial: cubic interpolation of the motion, then dynamic
  /// equilibrium. Then the rates of its springs. False if these find no equilibrium.
  bool balance_middle(const Instant& begin, Trial& trial) const;
  /// Cubic interpolation at mid-step of a link's relative motion, before ground and gravity.
  static LinkMotion middle_of(int link, const Instant& begin, const Trial& trial);
  /// Corrects displacements and velocities at the end of a step, see hold_contacts().
  void hold_end(const Instant& begin, Trial& trial) const {
    if (moves_ends_apart(trial)) hold_moved_end(begin, trial);
  }

 private:
  // Whether the rule of integration may take the two ends of a link apart that has no closing acceleration: where the
  // ground moves them differently, or is integrated exactly for one of them (ShortMotions) and by the rule for the
  // other.
  bool moves_ends_apart(const Trial& trial) const { return links.moved() || trial.short_motions; }
  void hold_moved_end(const Instant& begin, Trial& trial) const;

  std::vector<int> own_groups_;  // with coordinates on this process
  // Room to work in.
  mutable Eigen::VectorXd whole_, whole_force_;  // at all degrees of freedom
  mutable Eigen::VectorXd displacement_, force_;
  mutable Eigen::MatrixXd relative_;
  mutable std::vector<LinkMotion> motions_;
};

}  // namespace pounding
