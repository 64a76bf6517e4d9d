/// What is asked of the steps that were kept: states, what reports follow, motions in between, energies.

#include <algorithm>
#include <utility>

#include <pounding/stepping/stepper.hpp>

namespace pounding {
namespace {

// Factors of values and slopes at the ends of a step of length h, at s in [0, 1].
struct Cubic {
  double begin, end, slope_begin, slope_end;
  Cubic(double place, double h) {
    const double s = std::clamp(place, 0.0, 1.0), r = 1 - s;
    begin = r * r * (1 + 2 * s);
    end = s * s * (1 + 2 * r);
    slope_begin = h * s * r * r;
    slope_end = -h * s * s * r;
  }
};

// Factors of values at both ends and the middle.
struct Parabola {
  double begin, middle, end;
  explicit Parabola(double place) {
    const double s = std::clamp(place, 0.0, 1.0);
    begin = (1 - s) * (1 - 2 * s);
    middle = 4 * s * (1 - s);
    end = s * (2 * s - 1);
  }
};

}  // namespace

Energies Stepper::energies() const {
  const Eigen::MatrixXd& x = now_->motion;
  base_.mass_times(x.col(v), work_);
  std::vector<double> sums{input_work_, damping_work_, 0.5 * work_.dot(x.col(v)), 0.5 * x.col(u).dot(x.col(ku))};
  base_.combine(sums);
  Energies e;
  e.input = given_ + carried_work_ + sums[0];
  e.damping = sums[1];
  e.kinetic = sums[2];
  e.strain = sums[3];
  if (excess_.any()) {
    base_.physical(x.col(u), whole_);
    e.strain += excess_.energy(whole_);
  }
  for (const Spring* spring : system_.springs) {
    e.hysteretic += spring->lost();
    e.strain += spring->stored_correction();
  }
  for (const Contact* contact : system_.contacts) e.impact += contact->work();
  for (const double work : friction_work_) e.impact += work;
  return e;
}

void Stepper::show(const Instant& instant, State& state) const {
  state.time = instant.time;
  base_.physical(instant.motion.col(u), state.u);
  base_.physical(instant.motion.col(v), state.v);
  base_.physical(instant.motion.col(a), state.a);
  if (excess_.any()) excess_.complete(state.u, state.v, state.a);
  state.force = instant.force;
}

void Stepper::show(const Instant& instant, OutputQuantities& outputs) const {
  outputs.time = instant.time;
  if (outputs_need_recovery_) {
    State whole;
    show(instant, whole);
    outputs.motion.resize(system_.outputs.cols(), 3);
    outputs.motion << system_.outputs.transpose() * whole.u, system_.outputs.transpose() * whole.v,
        system_.outputs.transpose() * whole.a;
    return;
  }
  base_.observe(instant.motion.leftCols(3), outputs.motion);
}

void Stepper::forget_views() {
  states_.forget();
  outputs_.forget();
  has_outputs_middle_ = false;
}

template <class View>
const View& Stepper::now_in(Views<View>& views) const {
  if (!std::exchange(views.has_now, true)) show(*now_, views.now);
  return views.now;
}

template <class View>
const View& Stepper::before_in(Views<View>& views) const {
  if (!std::exchange(views.has_before, true)) show(*before_, views.before);
  return views.before;
}

template <class View>
const View& Stepper::arrived_in(Views<View>& views) const {
  if (!changed_at_end_) return now_in(views);
  if (!std::exchange(views.has_arrived, true)) show(kept_->end, views.arrived);
  return views.arrived;
}

const State& Stepper::state() const { return now_in(states_); }
const State& Stepper::begin() const { return before_in(states_); }
const State& Stepper::end_minus() const { return arrived_in(states_); }
const OutputQuantities& Stepper::outputs() const { return now_in(outputs_); }
const OutputQuantities& Stepper::outputs_begin() const { return before_in(outputs_); }
const OutputQuantities& Stepper::outputs_end_minus() const { return arrived_in(outputs_); }

void Stepper::interpolate(double time, Eigen::VectorXd& u_out, Eigen::VectorXd& v_out) const {
  const State &x = begin(), &y = end_minus();
  const double h = y.time - x.time;
  if (!(h > 0)) {
    u_out = state().u;
    v_out = state().v;
    return;
  }
  const Cubic cubic((time - x.time) / h, h);
  u_out = cubic.begin * x.u + cubic.end * y.u + cubic.slope_begin * x.v + cubic.slope_end * y.v;
  v_out = cubic.begin * x.v + cubic.end * y.v + cubic.slope_begin * x.a + cubic.slope_end * y.a;
  if (excess_.any()) excess_.complete(u_out, v_out);
}

void Stepper::interpolate_acceleration(double time, Eigen::VectorXd& out) const {
  const State &x = begin(), &y = end_minus();
  const double h = y.time - x.time;
  if (!(h > 0)) {
    out = state().a;
    return;
  }
  const Parabola parabola((time - x.time) / h);
  Eigen::VectorXd middle;
  base_.recover(kept_->a_middle);
  base_.physical(kept_->a_middle, middle);
  if (excess_.any()) {
    Eigen::VectorXd u_middle, v_middle;
    interpolate(0.5 * (x.time + y.time), u_middle, v_middle);
    excess_.complete(u_middle, v_middle, middle);
  }
  out = parabola.begin * x.a + parabola.middle * middle + parabola.end * y.a;
}

const Eigen::MatrixXd& Stepper::outputs_middle() const {
  if (std::exchange(has_outputs_middle_, true)) return outputs_middle_;
  if (outputs_need_recovery_) {
    Eigen::VectorXd middle;
    interpolate_acceleration(0.5 * (begin().time + end_minus().time), middle);
    outputs_middle_ = system_.outputs.transpose() * middle;
  } else {
    base_.recover(kept_->a_middle);
    base_.observe(kept_->a_middle, outputs_middle_);
  }
  return outputs_middle_;
}

void Stepper::interpolate_outputs(double time, Eigen::MatrixXd& out) const {
  const OutputQuantities &x = outputs_begin(), &y = outputs_end_minus();
  const double h = y.time - x.time;
  if (!(h > 0)) {
    out = outputs().motion;
    return;
  }
  const double s = (time - x.time) / h;
  const Cubic cubic(s, h);
  const Parabola parabola(s);
  out.resize(x.motion.rows(), 3);
  out.leftCols(2) = cubic.begin * x.motion.leftCols(2) + cubic.end * y.motion.leftCols(2) +
                    cubic.slope_begin * x.motion.rightCols(2) + cubic.slope_end * y.motion.rightCols(2);
  out.col(2) = parabola.begin * x.motion.col(2) + parabola.middle * outputs_middle() + parabola.end * y.motion.col(2);
}

}  // namespace pounding
