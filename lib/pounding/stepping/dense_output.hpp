#pragma once
/// States and output quantities at the ends of accepted steps and between them.

#include <utility>

#include <pounding/stepping/interpolation.hpp>
#include <pounding/stepping/step_history.hpp>

namespace pounding {

/// Lazily evaluated states and outputs of the instants in StepHistory. end_minus is the end of the last accepted step
/// before events; it is the same object as now if no event changed the state.
class DenseOutput {
 public:
  /// Both arguments must outlive this object.
  DenseOutput(const Equations& equations, const StepHistory& history);

  /// State at the present instant, at the beginning of the last accepted step, and at its end before events; see
  /// Stepper::state().
  const State& now() const { return now_in(states_); }
  const State& begin() const { return begin_in(states_); }
  const State& end_minus() const { return end_minus_in(states_); }
  /// Displacements and velocities only at the last two instants, cheaper than a full state.
  void begin(Eigen::VectorXd& u, Eigen::VectorXd& v) const;
  void end_minus(Eigen::VectorXd& u, Eigen::VectorXd& v) const;
  /// Output quantities at the same three instants.
  const OutputQuantities& outputs() const { return now_in(outputs_); }
  const OutputQuantities& outputs_begin() const { return begin_in(outputs_); }
  const OutputQuantities& outputs_end_minus() const { return end_minus_in(outputs_); }
  /// Output accelerations at mid-step, from dynamic equilibrium: [quantity, 1].
  const Eigen::MatrixXd& outputs_middle() const;

  /// Inside the last accepted step: cubic interpolation of displacement and velocity, parabola of acceleration.
  void interpolate(double time, Eigen::VectorXd& u, Eigen::VectorXd& v) const;
  void interpolate_acceleration(double time, Eigen::VectorXd& a) const;
  void interpolate_outputs(double time, Eigen::MatrixXd& motion) const;
  /// Coordinates inside the last accepted step, for linear systems (Stepper::is_linear): [coordinate, u v a].
  void interpolate_coordinates(double time, Eigen::MatrixXd& motion) const;
  /// Forces of all springs inside the last accepted step [N]. Springs with relief (SpringRelief) use the cubic from
  /// their force rates in the step; all others use the parabola.
  void interpolate_springs(double time, Eigen::VectorXd& forces) const;

  /// Called when a step is accepted: views of the present become those of its beginning.
  void step_accepted();
  /// The present instant changed.
  void now_changed() { states_.has_now = outputs_.has_now = false; }
  /// All instants changed.
  void forget();

 private:
  template <class View>
  struct Views {
    View now, begin, end_minus;
    bool has_now = false, has_begin = false, has_end_minus = false;
    void forget() { has_now = has_begin = has_end_minus = false; }
    void step_accepted() {
      if (has_now) std::swap(begin, now);
      has_begin = has_now;
      has_now = has_end_minus = false;
    }
  };

  // Accelerations of all degrees of freedom at the middle of the last accepted step, whose length may not be zero.
  const Eigen::VectorXd& middle() const;
  void show(const Instant& instant, State& state) const;
  void show(const Instant& instant, const State* shown, Eigen::VectorXd& u, Eigen::VectorXd& v) const;
  // Force rates of the springs at the beginning of the last accepted step, minus those used for its state.
  // True if the springs have zero force rates at the beginning of the last accepted step and throughout it.
  bool keeps_rates() const { return history_.kept().springs_stay && history_.begin().force_rates.isZero(0); }
  Eigen::MatrixXd change_at_begin() const { return history_.kept().force_rates_begin - history_.begin().force_rates; }
  Eigen::VectorXd springs_of(const Eigen::VectorXd& of_links) const;
  void show(const Instant& instant, OutputQuantities& outputs) const;
  template <class View>
  const View& now_in(Views<View>& views) const;
  template <class View>
  const View& begin_in(Views<View>& views) const;
  template <class View>
  const View& end_minus_in(Views<View>& views) const;

  const Equations& equations_;
  const StepHistory& history_;
  bool needs_whole_state_ =
      false;  // an output depends on massless degrees of freedom corrected by pseudo-forces or springs
  mutable Views<State> states_;
  mutable Views<OutputQuantities> outputs_;
  mutable Eigen::VectorXd middle_;
  mutable bool has_middle_ = false;
  mutable Eigen::MatrixXd outputs_middle_;
  mutable bool has_outputs_middle_ = false;
};

}  // namespace pounding
