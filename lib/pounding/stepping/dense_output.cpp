#include <pounding/stepping/dense_output.hpp>

namespace pounding {

DenseOutput::DenseOutput(const Equations& equations, const StepHistory& history)
    : equations_(equations),
      history_(history),
      needs_whole_state_(equations.pseudo_forces.any() && equations.pseudo_forces.corrects(equations.system.outputs)) {
  const SparseMatrix& way = equations.solver.layout().relief.way();
  if (way.size() > 0 && SparseMatrix(equations.system.outputs.transpose() * way).nonZeros() > 0)
    needs_whole_state_ = true;
}

Eigen::VectorXd DenseOutput::springs_of(const Eigen::VectorXd& of_links) const {
  return of_links.segment(equations_.links.contacts(), equations_.links.springs());
}

void DenseOutput::step_accepted() {
  states_.step_accepted();
  outputs_.step_accepted();
  has_outputs_middle_ = has_middle_ = false;
}

void DenseOutput::forget() {
  states_.forget();
  outputs_.forget();
  has_outputs_middle_ = has_middle_ = false;
}

void DenseOutput::show(const Instant& instant, State& state) const {
  state.time = instant.time;
  state.u = equations_.solver.physical(instant.motion.col(Instant::u));
  state.v = equations_.solver.physical(instant.motion.col(Instant::v));
  state.a = equations_.solver.physical(instant.motion.col(Instant::a));
  if (equations_.pseudo_forces.any()) equations_.pseudo_forces.complete(state.u, state.v, state.a);
  if (const SpringRelief& relief = equations_.solver.layout().relief; equations_.springs.any()) {
    relief.add_way(-1, springs_of(instant.force), state.u);
    relief.add_way(-1, instant.force_rates.col(0), state.v);
    relief.add_way(-1, instant.force_rates.col(1), state.a);
  }
  state.force = instant.force;
}

// `shown`: the state at this instant if it has been computed already; otherwise null.
void DenseOutput::show(const Instant& instant, const State* shown, Eigen::VectorXd& u, Eigen::VectorXd& v) const {
  if (shown) {
    u = shown->u;
    v = shown->v;
    return;
  }
  u = equations_.solver.physical(instant.motion.col(Instant::u));
  v = equations_.solver.physical(instant.motion.col(Instant::v));
  if (equations_.pseudo_forces.any()) equations_.pseudo_forces.complete(u, v);
  if (const SpringRelief& relief = equations_.solver.layout().relief; equations_.springs.any()) {
    relief.add_way(-1, springs_of(instant.force), u);
    relief.add_way(-1, instant.force_rates.col(0), v);
  }
}

void DenseOutput::begin(Eigen::VectorXd& u, Eigen::VectorXd& v) const {
  show(history_.begin(), states_.has_begin ? &states_.begin : nullptr, u, v);
}

void DenseOutput::end_minus(Eigen::VectorXd& u, Eigen::VectorXd& v) const {
  if (history_.changed_at_end())
    return show(history_.kept().end, states_.has_end_minus ? &states_.end_minus : nullptr, u, v);
  show(history_.now(), states_.has_now ? &states_.now : nullptr, u, v);
}

void DenseOutput::show(const Instant& instant, OutputQuantities& outputs) const {
  outputs.time = instant.time;
  if (needs_whole_state_) {
    State whole;
    show(instant, whole);
    outputs.motion.resize(equations_.system.outputs.cols(), 3);
    outputs.motion << equations_.system.outputs.transpose() * whole.u, equations_.system.outputs.transpose() * whole.v,
        equations_.system.outputs.transpose() * whole.a;
    return;
  }
  equations_.solver.observe(instant.motion.leftCols(3), outputs.motion);
}

template <class View>
const View& DenseOutput::now_in(Views<View>& views) const {
  if (!std::exchange(views.has_now, true)) show(history_.now(), views.now);
  return views.now;
}

template <class View>
const View& DenseOutput::begin_in(Views<View>& views) const {
  if (!std::exchange(views.has_begin, true)) show(history_.begin(), views.begin);
  return views.begin;
}

template <class View>
const View& DenseOutput::end_minus_in(Views<View>& views) const {
  if (!history_.changed_at_end()) return now_in(views);
  if (!std::exchange(views.has_end_minus, true)) show(history_.kept().end, views.end_minus);
  return views.end_minus;
}

template const State& DenseOutput::now_in(Views<State>&) const;
template const State& DenseOutput::begin_in(Views<State>&) const;
template const State& DenseOutput::end_minus_in(Views<State>&) const;
template const OutputQuantities& DenseOutput::now_in(Views<OutputQuantities>&) const;
template const OutputQuantities& DenseOutput::begin_in(Views<OutputQuantities>&) const;
template const OutputQuantities& DenseOutput::end_minus_in(Views<OutputQuantities>&) const;

void DenseOutput::interpolate(double time, Eigen::VectorXd& u_out, Eigen::VectorXd& v_out) const {
  const State &x = begin(), &y = end_minus();
  const double h = y.time - x.time;
  if (!(h > 0)) {
    u_out = now().u;
    v_out = now().v;
    return;
  }
  const Cubic cubic((time - x.time) / h, h);
  u_out = cubic.begin * x.u + cubic.end * y.u + cubic.slope_begin * x.v + cubic.slope_end * y.v;
  v_out = cubic.begin * x.v + cubic.end * y.v + cubic.slope_begin * x.a + cubic.slope_end * y.a;
  if (const SpringRelief& relief = equations_.solver.layout().relief; equations_.springs.any() && !keeps_rates()) {
    const Eigen::MatrixXd change = change_at_begin();
    relief.add_way(-1, cubic.slope_begin * change.col(0), u_out);
    relief.add_way(-1, cubic.begin * change.col(0) + cubic.slope_begin * change.col(1), v_out);
  }
  if (equations_.pseudo_forces.any()) equations_.pseudo_forces.complete(u_out, v_out);
}

void DenseOutput::interpolate_acceleration(double time, Eigen::VectorXd& out) const {
  const State &x = begin(), &y = end_minus();
  const double h = y.time - x.time;
  if (!(h > 0)) {
    out = now().a;
    return;
  }
  const Parabola parabola((time - x.time) / h);
  out = parabola.begin * x.a + parabola.middle * middle() + parabola.end * y.a;
  if (const SpringRelief& relief = equations_.solver.layout().relief; equations_.springs.any() && !keeps_rates())
    relief.add_way(-1, parabola.begin * change_at_begin().col(1), out);
}

const Eigen::VectorXd& DenseOutput::middle() const {
  if (std::exchange(has_middle_, true)) return middle_;
  equations_.solver.recover(history_.kept().a_middle);
  middle_ = equations_.solver.physical(history_.kept().a_middle);
  if (const SpringRelief& relief = equations_.solver.layout().relief;
      equations_.springs.any() && !history_.kept().springs_stay)
    relief.add_way(-0.5, history_.kept().force_rates_begin.col(1) + history_.kept().end.force_rates.col(1), middle_);
  if (equations_.pseudo_forces.any()) {
    Eigen::VectorXd u_middle, v_middle;
    interpolate(0.5 * (begin().time + end_minus().time), u_middle, v_middle);
    equations_.pseudo_forces.complete(u_middle, v_middle, middle_);
  }
  return middle_;
}

const Eigen::MatrixXd& DenseOutput::outputs_middle() const {
  if (std::exchange(has_outputs_middle_, true)) return outputs_middle_;
  if (needs_whole_state_) {
    outputs_middle_ = equations_.system.outputs.transpose() * middle();
  } else {
    equations_.solver.recover(history_.kept().a_middle);
    equations_.solver.observe(history_.kept().a_middle, outputs_middle_);
  }
  return outputs_middle_;
}

void DenseOutput::interpolate_springs(double time, Eigen::VectorXd& forces) const {
  const Instant &x = history_.begin(), &y = history_.kept().end;
  const double h = y.time - x.time;
  if (!(h > 0)) {
    forces = springs_of(history_.now().force);
    return;
  }
  if (history_.kept().springs_stay && keeps_rates() && springs_of(y.force).isZero(0)) {
    forces.setZero(equations_.links.springs());
    return;
  }
  const double s = (time - x.time) / h;
  const Parabola parabola(s);
  forces = parabola.begin * springs_of(x.force) + parabola.middle * springs_of(history_.kept().force_middle) +
           parabola.end * springs_of(y.force);
  if (!equations_.springs.any()) return;
  const Cubic cubic(s, h);
  const Eigen::VectorXd by_slopes = cubic.begin * springs_of(x.force) + cubic.end * springs_of(y.force) +
                                    cubic.slope_begin * history_.kept().force_rates_begin.col(0) +
                                    cubic.slope_end * y.force_rates.col(0);
  // The states use the cubic for every spring with relief; massless degrees of freedom stay in equilibrium with these
  // forces.
  const SparseMatrix& flexibility = equations_.solver.layout().relief.flexibility();
  for (int i = 0; i < by_slopes.size(); ++i)
    if (flexibility.innerVector(i).nonZeros() > 0) forces[i] = by_slopes[i];
}

namespace {

// Interpolates from [row, u v a] at the ends of a step and the accelerations at its middle.
void interpolate_motion(double s, double h, const Eigen::Ref<const Eigen::MatrixXd>& x,
                        const Eigen::Ref<const Eigen::MatrixXd>& middle, const Eigen::Ref<const Eigen::MatrixXd>& y,
                        Eigen::MatrixXd& out) {
  const Cubic cubic(s, h);
  const Parabola parabola(s);
  out.resize(x.rows(), 3);
  out.leftCols(2) = cubic.begin * x.leftCols(2) + cubic.end * y.leftCols(2) + cubic.slope_begin * x.rightCols(2) +
                    cubic.slope_end * y.rightCols(2);
  out.col(2) = parabola.begin * x.col(2) + parabola.middle * middle.col(0) + parabola.end * y.col(2);
}

}  // namespace

void DenseOutput::interpolate_outputs(double time, Eigen::MatrixXd& out) const {
  const OutputQuantities &x = outputs_begin(), &y = outputs_end_minus();
  const double h = y.time - x.time;
  if (!(h > 0)) {
    out = outputs().motion;
    return;
  }
  interpolate_motion((time - x.time) / h, h, x.motion, outputs_middle(), y.motion, out);
}

void DenseOutput::interpolate_coordinates(double time, Eigen::MatrixXd& out) const {
  const Instant &x = history_.begin(), &y = history_.kept().end;
  const double h = y.time - x.time;
  if (!(h > 0)) {
    out = history_.now().motion.leftCols(3);
    return;
  }
  equations_.solver.recover(history_.kept().a_middle);
  interpolate_motion((time - x.time) / h, h, x.motion.leftCols(3), history_.kept().a_middle, y.motion.leftCols(3), out);
}

}  // namespace pounding
