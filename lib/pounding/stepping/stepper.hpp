#pragma once
/// One step of the equations of motion: tried, measured, shortened to the first event inside it, accepted. Independent
/// of PETSc; see StepController for the order of these calls.

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Everything that moves, between two steps: a value that can be copied, compared and archived. It belongs to steppers
/// of the same system, solver and options.
struct StepState {
  std::vector<std::byte> bytes;

  bool operator==(const StepState&) const = default;
  void archive(Archive& archive) { archive(bytes); }
};

/// Integrates the equations of motion with condensed link forces. Each stage solves the structures once with a constant
/// matrix; Newton's method then finds the few link forces. Pseudo-forces are iterated to convergence around both.
///
/// A trial step is pure: if it is not accepted, contacts, springs and state are unchanged. Collective over the
/// processes that share the solver.
class Stepper final : private StepView {
 public:
  /// `solver` describes the same system; both must outlive the stepper. Throws std::invalid_argument if options are out
  /// of range or the system is inconsistent (System::check).
  Stepper(const System& system, StructureSolver& solver, const StepperOptions& options);

  /// Starts from displacements [m] and velocities [m/s] of all degrees of freedom, with the acceleration of dynamic
  /// equilibrium; massless degrees of freedom are set to static equilibrium. If called again after steps, it continues
  /// from a motion modified by the caller; the energy that this adds counts as input.
  void start(double time, const Eigen::VectorXd& u, const Eigen::VectorXd& v);

  /// Sets and factorizes the matrix of steps of length h > 0 [s] without making a step. The PETSc options of the
  /// factorization are read here.
  void prepare(double h) { equations_.solver.set_matrix(scheme_->matrix(h), step_level(h)); }

  /// Solves a trial step of length h > 0 [s]. `end`: exact end time if known (next breakpoint of the ground motion, end
  /// of the run); default time() + h. False if link forces or pseudo-forces cannot be solved.
  bool try_step(double h, std::optional<double> end = std::nullopt);
  /// Shortens the trial to the first event inside it, by re-integrated steps. Returns its length [s]: zero if the event
  /// is at the beginning, `nullopt` if there is none. `at_corners`: corners of spring forces also end the trial. Throws
  /// SolverError if such a step cannot be solved.
  std::optional<double> locate_event(bool at_corners = true);
  /// Accepts the trial and applies the events at its end.
  void accept();
  /// Applies the events at the present state without a step, after locate_event() returned zero.
  void apply_event();

  /// The present state, the last accepted step and the trial.
  const StepView& view() const { return *this; }

  /// The whole state between two steps, including contacts and elements. A stepper that restores it makes the same
  /// steps to the bit. Throws std::runtime_error for a state of another system.
  StepState save();
  void restore(const StepState& state);

 private:
  void look_ahead();
  bool solve_trial();
  void add_path_error(const Trial& trial);
  template <class Visit>
  void visit_elements(Visit&& visit);
  void start_elements(const std::function<LinkMotion(int)>& motion_of);
  void load_elements(const Eigen::VectorXd& rest, const std::function<LinkMotion(int)>& motion_of);
  void apply_located(bool in_place);
  void balance_now();
  void archive(Archive& archive);
};

}  // namespace pounding
