#pragma once
/// The present state, the last accepted step and the trial of a stepper.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include <pounding/core/archive_eigen.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/model/scheme.hpp>
#include <pounding/stepping/dense_output.hpp>
#include <pounding/stepping/dyadic_steps.hpp>
#include <pounding/stepping/energy_budget.hpp>
#include <pounding/stepping/energy_ledger.hpp>
#include <pounding/stepping/error_norm.hpp>
#include <pounding/stepping/event_locator.hpp>
#include <pounding/stepping/held_forces.hpp>
#include <pounding/stepping/links/contact_events.hpp>
#include <pounding/stepping/stage_solver.hpp>
#include <pounding/stepping/step_history.hpp>
#include <pounding/stepping/time_scheme.hpp>

namespace pounding {

/// Accuracy and time-stepping scheme.
struct StepperOptions {
  double tolerance = 1e-4;  ///< relative, on displacements and forces; between 0 and 1
  Scheme scheme = {};
  double max_step = 0;  ///< maximum step [s]; shorter during ground motion, see Stepper::longest_step()
};

/// What a stepper shows of its present state, the last accepted step and the trial: read only.
class StepView {
 public:
  StepView(const StepView&) = delete;
  StepView& operator=(const StepView&) = delete;

  /// Error of the trial divided by the allowed error; acceptable if at most 1.
  double error_ratio() const { return history_.trial().error; }
  /// The error of the trial is proportional to this power of its length. During contact, the Simpson estimate dominates
  /// in ESDIRK4.
  int error_order() const {
    return options_.scheme.error_order() + (options_.scheme.kind == Scheme::Kind::esdirk4 && stages_.presses() ? 1 : 0);
  }
  /// Whether the trial may hold an event; where not, locate_event() would find none.
  bool may_hold_event() const { return locator_.may_find(history_.now(), history_.trial()); }
  /// About where the first phase of a contact that presses ends inside the trial [s after its beginning]; nothing if
  /// none does.
  std::optional<double> expected_end_of_phase() const {
    return locator_.expected_end(history_.now(), history_.trial());
  }
  /// True if steps should end at corners of spring laws; false if a step of arbitrary length needs its own
  /// factorization.
  bool locates_corners() const { return equations_.solver.layout().step_lengths != StepLengths::needs_dyadic; }
  /// Time of the present state [s].
  double time() const { return history_.now().time; }
  /// Next breakpoint (corner or jump) of any ground motion [s]; infinity if there is none.
  double next_break() const { return equations_.supports.next_break(); }
  /// Maximum step until then: max_step of the options, or the step that resolves the ground motions [s].
  double longest_step() const { return longest_step_; }
  /// The present state after any events, the beginning of the last accepted step, and the end of that step before
  /// events. The last one is the same object as state() if no event changed the state.
  const State& state() const { return output_.now(); }
  const State& begin() const { return output_.begin(); }
  const State& end_minus() const { return output_.end_minus(); }
  /// Displacements and velocities only at the last two instants, cheaper than a full state.
  void begin(Eigen::VectorXd& u, Eigen::VectorXd& v) const { output_.begin(u, v); }
  void end_minus(Eigen::VectorXd& u, Eigen::VectorXd& v) const { output_.end_minus(u, v); }
  /// The present instant, and those at the beginning and end (before events) of the last accepted step, in the
  /// coordinates of base().
  const Instant& instant() const { return history_.now(); }
  const Instant& instant_begin() const { return history_.begin(); }
  const Instant& instant_end_minus() const { return history_.kept().end; }
  /// Output quantities at the same instants; cheaper than full states.
  const OutputQuantities& outputs() const { return output_.outputs(); }
  const OutputQuantities& outputs_begin() const { return output_.outputs_begin(); }
  const OutputQuantities& outputs_end_minus() const { return output_.outputs_end_minus(); }
  /// Output accelerations at mid-step, from dynamic equilibrium: [quantity, 1].
  const Eigen::MatrixXd& outputs_middle() const { return output_.outputs_middle(); }
  /// Ground accelerations at the same instants [m/s^2].
  const Eigen::VectorXd& ground() const { return history_.now().ground; }
  const Eigen::VectorXd& ground_begin() const { return history_.begin().ground; }
  const Eigen::VectorXd& ground_middle() const { return history_.kept().ground_middle; }
  const Eigen::VectorXd& ground_end_minus() const { return history_.kept().end.ground; }
  /// The last accepted step of every link, or of one link, which is cheaper unless it is a spring.
  const std::vector<LinkStep>& link_steps() const {
    describe_springs();
    return described_.steps;
  }
  const LinkStep& link_step(int link) const {
    if (!described_.with_springs && equations_.links.is_spring(link)) describe(link, described_.steps[link]);
    return described_.steps[link];
  }
  /// Deformations of all springs at a fraction s (0 to 1) of the last accepted step; requires springs_stayed().
  void deformations(double s, Eigen::VectorXd& d) const;
  /// True if no spring changed its force in the last accepted step; spring_paths() then has their deformations, see
  /// Trial::spring_paths.
  bool springs_stayed() const { return history_.kept().springs_stay; }
  const Eigen::MatrixXd& spring_paths() const { return history_.kept().spring_paths; }
  /// Forces of all links at the present state [N].
  const Eigen::VectorXd& link_forces() const { return history_.now().force; }
  /// Memories of contacts and elements at the present state.
  const LinkMemory& memory() const { return equations_.links.memory(); }
  /// Links, with the memory of each.
  const LinkSet& links() const { return equations_.links; }
  /// Motion of a link at the present state.
  LinkMotion link_motion(int link) const { return equations_.links.motion(link, history_.now()); }
  Energies energies() const { return ledger_.energies(equations_, history_.now()); }
  /// Work done on each friction element of the system, lost and stored [J].
  const std::vector<double>& friction_work() const { return ledger_.friction(); }
  /// Energy that the tangential springs of each friction element store at the present state [J].
  std::vector<double> friction_stored() const;
  bool in_contact() const;
  /// Link with the largest error in the last trial, or at which it could not be solved; -1 if none.
  int troublesome_link() const { return troublesome_link_; }

  /// Displacement and velocity inside the last accepted step: cubic Hermite interpolation.
  void interpolate(double time, Eigen::VectorXd& u, Eigen::VectorXd& v) const { output_.interpolate(time, u, v); }
  /// Acceleration inside the last accepted step: parabola through both ends and the middle.
  void interpolate_acceleration(double time, Eigen::VectorXd& a) const { output_.interpolate_acceleration(time, a); }
  /// Forces of all springs inside the last accepted step [N].
  void interpolate_springs(double time, Eigen::VectorXd& forces) const { output_.interpolate_springs(time, forces); }
  /// Forces in the members of a structure with a memory (TangentForces::member_forces), by its first degree of freedom,
  /// inside the last accepted step; empty for other structures.
  Eigen::VectorXd member_forces(int first_dof, double time) const {
    const double h = history_.kept().end.time - history_.begin().time;
    return equations_.tangents.member_forces(first_dof, h > 0 ? (time - history_.begin().time) / h : 1);
  }
  /// Output quantities inside the last accepted step: [quantity, u v a].
  void interpolate_outputs(double time, Eigen::MatrixXd& motion) const { output_.interpolate_outputs(time, motion); }

  /// Coordinates of base() inside the last accepted step; requires is_linear(): [coordinate, u v a].
  void interpolate_coordinates(double time, Eigen::MatrixXd& motion) const {
    output_.interpolate_coordinates(time, motion);
  }

  /// Step to try if `wanted` is acceptable and `left` remains until a breakpoint or the end [s]: a dyadic step if the
  /// solver prefers them, otherwise an equal fraction of `left`.
  double step_towards(double wanted, double left) const;
  const StepperOptions& options() const { return options_; }
  const System& system() const { return equations_.system; }
  const StructureSolver& base() const { return equations_.solver; }
  /// True if all degrees of freedom follow from the coordinates of base() alone: no part of the structures yields or
  /// rotates.
  bool is_linear() const { return !equations_.springs.any() && !equations_.has_pseudo_forces(); }
  /// Number of iterations for link forces and pseudo-forces, and of contact events, since the start.
  long iterations() const { return stages_.iterations(); }
  long events() const { return contact_events_.count(); }

 protected:
  // The last accepted step of every link.
  struct DescribedLinks {
    std::vector<LinkStep> steps;
    bool with_springs = true;  // if false, no spring changed its force, and their entries are stale
  };

  StepView(const System& system, StructureSolver& solver, const StepperOptions& options);
  ~StepView() = default;

  void describe(int link, const Instant& begin, const Trial& solved, LinkStep& step) const;
  void describe(int link, LinkStep& step) const { describe(link, history_.begin(), history_.kept(), step); }
  void describe_springs() const;
  std::optional<int> step_level(double h) const {
    return equations_.solver.layout().step_lengths == StepLengths::any ? std::nullopt : dyadic_.level(h);
  }

  StepperOptions options_;
  Equations equations_;
  const DyadicSteps dyadic_;
  ErrorNorm norm_;
  StageSolver stages_;
  std::unique_ptr<TimeScheme> scheme_;
  StepHistory history_;
  StepError error_;
  double longest_step_;
  EventFunctions functions_;
  EventLocator locator_;
  EnergyLedger ledger_;
  EnergyBudget budget_;
  ContactEvents contact_events_;
  HeldForces held_forces_;
  DenseOutput output_;
  mutable DescribedLinks described_;
  std::vector<EventId> located_;  // events at the end of the trial
  int troublesome_link_ = -1;
  bool started_ = false;
};

}  // namespace pounding
