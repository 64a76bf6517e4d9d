#pragma once
/// The equations of motion of a system, shared by all parts of a step.

#include <Eigen/Core>
#include <span>
#include <vector>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/stepping/links/link_set.hpp>
#include <pounding/stepping/links/link_slips.hpp>
#include <pounding/stepping/links/rigid_impacts.hpp>
#include <pounding/stepping/pseudo_forces.hpp>
#include <pounding/stepping/short_motions.hpp>
#include <pounding/stepping/springs/elastic_ranges.hpp>
#include <pounding/stepping/springs/spring_forces.hpp>
#include <pounding/stepping/step_state.hpp>
#include <pounding/stepping/support_excitation.hpp>
#include <pounding/stepping/tangent_parts.hpp>

namespace pounding {

/// M a + C v + K u + e(u) + B F = -P ag(t), with pseudo-forces e and link forces F; see System.
struct Equations {
  /// Both arguments must outlive this object. Throws std::invalid_argument if the system is inconsistent
  /// (System::check). `carries`: the scheme carries a separate acceleration, Instant::carried.
  Equations(const System& system, StructureSolver& solver, bool carries);
  Equations(const Equations&) = delete;
  Equations& operator=(const Equations&) = delete;

  const System& system;
  StructureSolver& solver;
  LinkSet links;
  SpringForces springs;
  ElasticRanges ranges;
  const LinkSlips slips;
  SupportExcitation supports;
  const ShortMotions short_motions;
  const PseudoForces pseudo_forces;
  TangentParts tangents;
  const RigidContacts rigid;
  const int width;  ///< columns of Instant::motion with products: u v a, and carried if the scheme has it

  /// An Instant and a Trial of the right sizes, all zero.
  Instant zero_instant() const;
  Trial zero_trial() const;

  /// Multiplies `count` columns of the motion, starting at `first`: all by K, all but the displacement by C.
  void multiply(Instant& x, int first, int count) const;
  /// Sets the relative motion of all links and the relief of the springs.
  void gather(Instant& x) const {
    solver.gather(x.motion.leftCols(width), x.relative);
    if (springs.any()) springs.relieve(x);
  }
  /// True if there are any pseudo-forces e.
  bool has_pseudo_forces() const { return pseudo_forces.any() || tangents.any(); }
  /// e at a displacement; that of structures with a memory by their last linearization.
  void pseudo_force(Eigen::Ref<const Eigen::VectorXd> displacement, Eigen::VectorXd& force);
  /// e without structures with a memory.
  void elastic_pseudo_force(Eigen::Ref<const Eigen::VectorXd> displacement, Eigen::VectorXd& force);

  /// Solves dynamic equilibrium: computes the link forces from the link motions and replaces `r`, the sum of all other
  /// forces, by the acceleration. Held contacts take the forces that make their closing acceleration zero; contacts
  /// between the same bodies share them. `inside_step`: negative contact forces are set to zero unless the law can
  /// pull. `springs_stay`: `force` already contains the spring forces.
  void balance(std::span<const LinkMotion> motions, const Eigen::MatrixXd& by_ground, bool inside_step,
               bool springs_stay, Eigen::VectorXd& force, Eigen::Ref<Eigen::VectorXd> r);
  /// Completes an instant just after events from its displacement, velocity, K u and pseudo-forces, by dynamic
  /// equilibrium.
  void balance(Instant& x);
  /// Mid-step motions, forces and accelerations of a trial: cubic interpolation of the motion, then dynamic
  /// equilibrium. Then the rates of its springs. False if these find no equilibrium.
  bool balance_middle(const Instant& begin, Trial& trial);
  /// Cubic interpolation of a link's relative motion at mid-step, without ground motion and gravity.
  static LinkMotion middle_of(int link, const Instant& begin, const Trial& trial);
  /// Corrects displacements and velocities of held contacts at the end of a step; see hold_contacts().
  void hold_end(const Instant& begin, Trial& trial) {
    if (moves_ends_apart(trial)) hold_moved_end(begin, trial);
  }

 private:
  // True if the time integration may separate the ends of a link that has no closing acceleration: if ground motion
  // moves them differently, or is integrated exactly (ShortMotions) at one end only.
  bool moves_ends_apart(const Trial& trial) const { return links.moved() || trial.short_motions; }
  void hold_moved_end(const Instant& begin, Trial& trial);

  std::vector<int> own_groups_;  // groups with coordinates on this process
  // Workspace.
  Eigen::VectorXd whole_, whole_force_;  // of all degrees of freedom
  Eigen::VectorXd displacement_;
  Eigen::MatrixXd relative_;
  std::vector<LinkMotion> motions_;
};

}  // namespace pounding
