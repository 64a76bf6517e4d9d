/// A trial step by ESDIRK4.

#include <pounding/stepping/time_scheme.hpp>

#include <algorithm>
#include <array>

namespace pounding {
namespace {

using enum Instant::Column;
using esdirk4::shift, esdirk4::squared;
constexpr int stage_count = esdirk4::stages;

// Weight of the Simpson error relative to that of the embedded scheme, if any link is active.
constexpr double simpson_part = 3;

// Forces for the acceleration of a stage at t + c h: r = -push - K (u0 + c h v0) - C v0, minus K and C times the
// contributions of the `earlier` stage accelerations to displacement and velocity. `products` has three columns of
// length n per stage: acceleration, K times it and C times it. A single pass with the number of stages known at compile
// time. `r` is the acceleration column of the current stage, which is not read.
template <int earlier>
void forces_of_stage(int n, double h, double c, const Instant& x, const double* push, const double* __restrict products,
                     double* __restrict r) {
  const double *ku0 = x.at(ku), *kv0 = x.at(kv), *cv0 = x.at(cv);
  const double ch = c * h;
  double by_k[earlier], by_c[earlier];
  for (int j = 0; j < earlier; ++j) {
    by_k[j] = h * h * squared[earlier][j];
    by_c[j] = h * esdirk4::a[earlier][j];
  }
  for (int k = 0; k < n; ++k) {
    double sum = -push[k] - ku0[k] - cv0[k] - ch * kv0[k];
    for (int j = 0; j < earlier; ++j)
      sum -= by_k[j] * products[(3 * j + 1) * n + k] + by_c[j] * products[(3 * j + 2) * n + k];
    r[k] = sum;
  }
}

constexpr std::array forces_of{forces_of_stage<1>, forces_of_stage<2>, forces_of_stage<3>, forces_of_stage<4>,
                               forces_of_stage<5>};

// Computes the end of a step and its errors from the accelerations of all stages.
void sum_stages(int n, double h, const Instant& x, const double* __restrict products, Instant& end, StepError& error) {
  double by_u[stage_count], by_v[stage_count], error_by_u[stage_count], error_by_v[stage_count];
  for (int j = 0; j < stage_count; ++j) {
    by_u[j] = h * h * squared[stage_count - 1][j];
    by_v[j] = h * esdirk4::a[stage_count - 1][j];
    error_by_u[j] = h * h * esdirk4::error.displacement[j];
    error_by_v[j] = h * esdirk4::error.velocity[j];
  }
  const double *u0 = x.at(u), *v0 = x.at(v);
  double *__restrict u1 = end.at(u), *__restrict v1 = end.at(v), *__restrict error_u = error.u.data(), *__restrict error_v = error.v.data();
  for (int k = 0; k < n; ++k) {
    double du = u0[k] + h * v0[k], dv = v0[k], eu = 0, ev = 0;
    for (int j = 0; j < stage_count; ++j) {
      const double aj = products[3 * j * n + k];
      du += by_u[j] * aj;
      dv += by_v[j] * aj;
      eu += error_by_u[j] * aj;
      ev += error_by_v[j] * aj;
    }
    u1[k] = du;
    v1[k] = dv;
    error_u[k] = eu;
    error_v[k] = ev;
  }
}

// Each of the five implicit stages solves for its acceleration, from dynamic equilibrium at t + c h.
class Esdirk4Scheme final : public TimeScheme {
 public:
  Esdirk4Scheme(Equations& equations, StageSolver& stages)
      : eq_(equations),
        solver_(stages),
        ground_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(equations.system.grounds.size()))),
        stages_(Eigen::MatrixXd::Zero(equations.solver.size(), 3 * stage_count)) {}

  EffectiveMatrix matrix(double h) const override { return {1, shift * h, shift * shift * h * h}; }

  bool try_step(const Instant& x, double /*last_step*/, Trial& t, StepError& error) override {
    const int n = eq_.solver.size();
    std::copy_n(x.at(a), n, stages_.col(0).data());
    std::copy_n(x.at(ka), n, stages_.col(1).data());
    std::copy_n(x.at(ca), n, stages_.col(2).data());
    if (t.short_motions) short_accelerations_ = t.short_motions->begin.col(a);
    link_accelerations_.resize(eq_.links.size(), stage_count);
    if (eq_.links.size() > 0) link_accelerations_.col(0) = x.relative.col(a);
    if (eq_.slips.any()) {
      slip_rates_.resize(eq_.slips.size(), stage_count);
      slip_rates_.col(0) = eq_.slips.rates(x);
    }
    t.end.force = x.force;
    for (int i = 1; i < stage_count; ++i)
      if (!solve_stage(i, x, t)) return false;
    return finish(x, t, error);
  }

 private:
  auto acceleration(int j) { return stages_.col(3 * j); }

  // Inlined: five function calls per step cost 2 % of a step with two oscillators.
  [[gnu::always_inline]] inline bool solve_stage(int i, const Instant& x, Trial& t) {
    const int n = eq_.solver.size();
    const double h = t.h, ci = esdirk4::c[i];
    const bool last = i + 1 == stage_count, middle = ci == 0.5;
    if (!last && !middle) eq_.supports.accelerations(x.time + ci * h, ground_);
    const Eigen::VectorXd& ground = last ? t.end.ground : middle ? t.ground_middle : ground_;
    const bool own = eq_.links.driven() && !last && !middle;
    if (own) eq_.supports.relative_motion(x.time + ci * h, ground, by_ground_);
    const Eigen::MatrixXd& by_ground = own ? by_ground_ : middle ? t.by_ground_middle : t.end.by_ground;
    const double* push = eq_.supports.push(ground).data();
    forces_of[i - 1](n, h, ci, x, push, stages_.data(), acceleration(i).data());
    if (t.short_motions) {
      const ShortMotionStep& step = *t.short_motions;
      missed_ = defect(i, h, step.begin,
                       last     ? step.end
                       : middle ? step.middle
                                : eq_.short_motions.at(x.time + ci * h, ground, x));
      acceleration(i) -= eq_.short_motions.forces(missed_);
    }
    const Stage stage{shift * shift * h * h, shift * h, 1};
    const auto free_motion = [&](int link, double g, LinkMotion& motion) {
      double relative_displacement = x.relative(link, u) + ci * h * x.relative(link, v) + shift * shift * h * h * g;
      double rate = x.relative(link, v) + shift * h * g;
      for (int j = 0; j < i; ++j) {
        relative_displacement += h * h * squared[i][j] * link_accelerations_(link, j);
        rate += h * esdirk4::a[i][j] * link_accelerations_(link, j);
      }
      if (t.short_motions) {
        relative_displacement += eq_.short_motions.closing(link, missed_.u);
        rate += eq_.short_motions.closing(link, missed_.v);
      }
      motion.penetration =
          eq_.links.deformation(link, relative_displacement + eq_.links.ground_part(by_ground, link, u));
      motion.rate = rate + eq_.links.ground_part(by_ground, link, v);
      motion.slip = motion.lag = 0;
      if (eq_.slips.any() && eq_.slips.slips(link)) {
        const int spring = link - eq_.links.contacts();
        motion.slip = x.slip[spring];
        for (int j = 0; j < i; ++j) motion.slip += h * esdirk4::a[i][j] * slip_rates_(spring, j);
        motion.lag = shift * h;
      }
      return g + eq_.links.ground_part(by_ground, link, a);
    };
    if (eq_.has_pseudo_forces()) {
      free_displacement_ = x.motion.col(u) + ci * h * x.motion.col(v);
      for (int j = 0; j < i; ++j) free_displacement_ += h * h * squared[i][j] * acceleration(j);
      if (t.short_motions) free_displacement_ += eq_.short_motions.shift(missed_.u);
      if (eq_.tangents.any()) {
        if (!solver_.solve_with_tangents(stage, free_displacement_, free_motion, acceleration(i), t.end.force))
          return false;
        eq_.tangents.record_stage(free_displacement_ + stage.by_u * acceleration(i), ci * h, middle);
      } else {
        guess_ = acceleration(i - 1);
        if (!solver_.solve_with_pseudo_forces(stage, free_displacement_, guess_, free_motion, acceleration(i),
                                              t.end.force))
          return false;
      }
    } else if (!solver_.solve(stage, free_motion, acceleration(i), t.end.force)) {
      return false;
    }
    for (std::size_t k = 0; k < solver_.active().size(); ++k)
      link_accelerations_(solver_.active()[k], i) = solver_.link_acceleration(k);
    if (eq_.slips.any()) find_slip_rates(i, stage);
    if (last) return true;
    eq_.solver.stiffness_times(acceleration(i), stages_.col(3 * i + 1));
    eq_.solver.damping_times(acceleration(i), stages_.col(3 * i + 1), stages_.col(3 * i + 2));
    return true;
  }

  void find_slip_rates(int i, const Stage& stage) {
    eq_.slips.rates_of_stage(
        solver_.active(), [&](std::size_t k) { return solver_.link_motion(stage, k); }, slip_rates_.col(i));
  }

  // Slips at the end of the step and their errors.
  void finish_slips(const Instant& x, Trial& t, StepError& error) const {
    t.end.slip = x.slip;
    error.slip.setZero(x.slip.size());
    for (int j = 0; j < stage_count; ++j) {
      t.end.slip += t.h * esdirk4::a[stage_count - 1][j] * slip_rates_.col(j);
      error.slip += t.h * esdirk4::error.velocity[j] * slip_rates_.col(j);
    }
    eq_.slips.keep_friction_rates(slip_rates_.col(stage_count - 1), t.end);
  }

  // Defect of stage i relative to the short ground motions, whose values at the stage are `motion`. Stores their
  // accelerations.
  GroundDefect defect(int i, double h, const Eigen::MatrixXd& begin, const Eigen::MatrixXd& motion) {
    short_accelerations_.conservativeResize(Eigen::NoChange, i + 1);
    short_accelerations_.col(i) = motion.col(a);
    GroundDefect missed{begin.col(u) + esdirk4::c[i] * h * begin.col(v) - motion.col(u), begin.col(v) - motion.col(v)};
    for (int j = 0; j <= i; ++j) {
      missed.u += h * h * squared[i][j] * short_accelerations_.col(j);
      missed.v += h * esdirk4::a[i][j] * short_accelerations_.col(j);
    }
    return missed;
  }

  // Adds the contribution of short ground motions to the end of the step and to its errors, after the sums over the
  // stages.
  void correct_end(Trial& t, StepError& error) const {
    t.end.motion.col(u) += eq_.short_motions.shift(missed_.u);
    t.end.motion.col(v) += eq_.short_motions.shift(missed_.v);
    Eigen::VectorXd by_u = Eigen::VectorXd::Zero(missed_.u.size()), by_v = by_u;
    for (int j = 0; j < stage_count; ++j) {
      by_u += t.h * t.h * esdirk4::error.displacement[j] * short_accelerations_.col(j);
      by_v += t.h * esdirk4::error.velocity[j] * short_accelerations_.col(j);
    }
    error.u += eq_.short_motions.shift(by_u);
    error.v += eq_.short_motions.shift(by_v);
  }

  // Computes the end of the step, its middle and its errors from the accelerations of all stages. False if the springs
  // have no equilibrium.
  bool finish(const Instant& x, Trial& t, StepError& error) {
    const int n = eq_.solver.size();
    const double h = t.h;
    sum_stages(n, h, x, stages_.data(), t.end, error);
    if (t.short_motions) correct_end(t, error);
    eq_.hold_end(x, t);
    if (eq_.has_pseudo_forces()) eq_.pseudo_force(t.end.motion.col(u), t.end.pseudo_force);
    std::copy_n(acceleration(stage_count - 1).data(), n, t.end.at(a));
    eq_.tangents.recover(t.end.motion.col(v));
    eq_.tangents.recover(t.end.motion.col(a));
    eq_.multiply(t.end, u, 3);
    eq_.gather(t.end);
    if (eq_.slips.any()) finish_slips(x, t, error);
    if (!eq_.balance_middle(x, t)) return false;
    if (eq_.slips.any()) eq_.slips.add_simpson_error(x, t, simpson_part, error);
    if (solver_.linked()) add_simpson_error(eq_.short_motions, x, t, simpson_part, error);
    return true;
  }

  Equations& eq_;
  StageSolver& solver_;
  Eigen::VectorXd ground_;
  Eigen::MatrixXd by_ground_;
  Eigen::MatrixXd stages_;               // three columns per stage: acceleration, K times it and C times it
  Eigen::MatrixXd link_accelerations_;   // closing accelerations, [link, stage]
  Eigen::MatrixXd slip_rates_;           // [slip, stage]; empty if none slips
  Eigen::MatrixXd short_accelerations_;  // of the short ground motions, [motion, stage]
  GroundDefect missed_;                  // of the current stage
  Eigen::VectorXd guess_, free_displacement_;
};

}  // namespace

std::unique_ptr<TimeScheme> make_esdirk4(Equations& equations, StageSolver& stages) {
  return std::make_unique<Esdirk4Scheme>(equations, stages);
}

}  // namespace pounding
