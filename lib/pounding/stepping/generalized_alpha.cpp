/// A trial step by generalized-alpha.

#include <pounding/stepping/time_scheme.hpp>

#include <algorithm>

namespace pounding {
namespace {

using enum Instant::Column;

// Balances inertia at t + (1 - alpha_m) h and all other forces at t + (1 - alpha_f) h; here alpha_m and alpha_f are the
// weights of the end of the step. The stage solves for the acceleration at the end.
class GeneralizedAlphaScheme final : public TimeScheme {
 public:
  GeneralizedAlphaScheme(Equations& equations, StageSolver& stages, const GeneralizedAlpha& coefficients)
      : eq_(equations),
        stages_(stages),
        k_(coefficients),
        r_(Eigen::VectorXd::Zero(equations.solver.size())),
        ground_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(equations.system.grounds.size()))) {}

  EffectiveMatrix matrix(double h) const override {
    return {k_.alpha_m, k_.alpha_f * k_.gamma * h, k_.alpha_f * k_.beta * h * h};
  }

  bool try_step(const Instant& x, double last_step, Trial& t, StepError& error) override {
    const int n = eq_.solver.size();
    const double h = t.h;
    const auto [alpha_m, alpha_f, beta, gamma] = k_;
    const bool carries = eq_.width == 4;
    // With a spectral radius below one, the scheme carries the acceleration of (alpha_m - alpha_f) h earlier. That time
    // offset changes with the step length; the carried acceleration is adjusted, since otherwise each change would
    // reduce the order.
    const double part = carries && last_step > 0 ? h / last_step : 1;
    const Instant::Column own = carries ? carried : a;

    const double *u0 = x.at(u), *v0 = x.at(v), *ku0 = x.at(ku), *kv0 = x.at(kv), *cv0 = x.at(cv);
    // Acceleration at the beginning of the step, and its products with K and C.
    const double *a0 = x.at(a), *ka0 = x.at(ka), *ca0 = x.at(ca);
    if (carries) {
      begin_.resize(n, 3);
      begin_.col(0) = x.motion.col(a) + part * (x.motion.col(carried) - x.motion.col(a));
      begin_.col(1) = x.motion.col(ka) + part * (x.motion.col(k_carried) - x.motion.col(ka));
      begin_.col(2) = x.motion.col(ca) + part * (x.motion.col(c_carried) - x.motion.col(ca));
      a0 = begin_.col(0).data(), ka0 = begin_.col(1).data(), ca0 = begin_.col(2).data();
    }
    const double by_c_in_u = h * h * (0.5 - beta), by_c_in_v = h * (1 - gamma);
    ground_ = alpha_f * t.end.ground + (1 - alpha_f) * x.ground;
    if (eq_.short_motions.any()) {
      // Ground accelerations that correspond to the accelerations of the scheme at the beginning and the end of the
      // step.
      ground_begin_ = x.ground;
      if (carries) ground_begin_ += part * (x.ground_carried - x.ground);
      t.end.ground_carried = (ground_ - (1 - alpha_m) * ground_begin_) / alpha_m;
    }
    if (t.short_motions) {
      const Eigen::MatrixXd &begin = t.short_motions->begin, &end = t.short_motions->end;
      const Eigen::VectorXd first = eq_.short_motions.at(x.time, ground_begin_, x).col(a);
      const Eigen::VectorXd last = eq_.short_motions.at(t.end.time, t.end.ground_carried, x).col(a);
      missed_ = {begin.col(u) + h * begin.col(v) + by_c_in_u * first + beta * h * h * last - end.col(u),
                 begin.col(v) + by_c_in_v * first + gamma * h * last - end.col(v)};
    }

    eq_.solver.mass_times(Eigen::Map<const Eigen::VectorXd>(a0, n), r_);
    const double* push = eq_.supports.push(ground_).data();
    // The arrays do not overlap; without the pragma GCC would check that in every step.
    double* r = r_.data();
#pragma GCC ivdep
    for (int i = 0; i < n; ++i)
      r[i] = (alpha_m - 1) * r[i] - push[i] - ku0[i] - cv0[i] -
             alpha_f * (h * kv0[i] + by_c_in_u * ka0[i] + by_c_in_v * ca0[i]);
    if (t.short_motions) r_ -= alpha_f * eq_.short_motions.forces(missed_);
    if (stages_.forced()) eq_.solver.add_forces(alpha_f - 1, x.force, r_);

    if (stages_.forced())
      t.end.force = x.force;
    else
      std::fill_n(t.end.force.data(), t.end.force.size(), 0.0);
    const Stage stage{beta * h * h, gamma * h, alpha_f};
    if (eq_.slips.any()) slip_free_ = x.slip + 0.5 * h * eq_.slips.smooth_rates(x);
    const auto free_motion = [&, beta = beta, gamma = gamma, alpha_m = alpha_m, alpha_f = alpha_f](int i, double g,
                                                                                                   LinkMotion& motion) {
      const double sa = x.relative(i, a), s = carries ? sa + part * (x.relative(i, carried) - sa) : sa;
      double relative_displacement = x.relative(i, u) + h * x.relative(i, v) + by_c_in_u * s + beta * h * h * g;
      double rate = x.relative(i, v) + by_c_in_v * s + gamma * h * g;
      if (t.short_motions) {
        relative_displacement += eq_.short_motions.closing(i, missed_.u);
        rate += eq_.short_motions.closing(i, missed_.v);
      }
      motion.penetration =
          eq_.links.deformation(i, relative_displacement + eq_.links.ground_part(t.end.by_ground, i, u));
      motion.rate = rate + eq_.links.ground_part(t.end.by_ground, i, v);
      motion.slip = motion.lag = 0;
      if (eq_.slips.any() && eq_.slips.slips(i)) {
        motion.slip = slip_free_[i - eq_.links.contacts()];
        motion.lag = 0.5 * h;
      }
      if (!eq_.links.moved()) return g;
      // At the time of the acceleration of the scheme.
      const double begin = x.by_ground(i, a), end = t.end.by_ground(i, a);
      return g + (end + (alpha_m - alpha_f) * (begin - end));
    };
    if (eq_.pseudo_forces.any()) {
      r_ -= (1 - alpha_f) * x.pseudo_force;
      guess_ = Eigen::Map<const Eigen::VectorXd>(a0, n);
      free_displacement_ = x.motion.col(u) + h * x.motion.col(v) + by_c_in_u * guess_;
      if (t.short_motions) free_displacement_ += eq_.short_motions.shift(missed_.u);
      if (!stages_.solve_with_pseudo_forces(stage, free_displacement_, guess_, free_motion, r_, t.end.force))
        return false;
    } else if (!stages_.solve(stage, free_motion, r_, t.end.force)) {
      return false;
    }

    // After a step that ends at a corner, the acceleration is extrapolated by a large factor, which also amplifies the
    // round-off at massless degrees of freedom.
    if (carries && eq_.springs.any()) eq_.solver.recover(r_);

    double *u1 = t.end.at(u), *v1 = t.end.at(v), *a1 = t.end.at(own);
#pragma GCC ivdep
    for (int i = 0; i < n; ++i) {
      const double acceleration = r[i];
      u1[i] = u0[i] + h * v0[i] + by_c_in_u * a0[i] + beta * h * h * acceleration;
      v1[i] = v0[i] + by_c_in_v * a0[i] + gamma * h * acceleration;
      a1[i] = acceleration;
    }
    if (t.short_motions) {
      t.end.motion.col(u) += eq_.short_motions.shift(missed_.u);
      t.end.motion.col(v) += eq_.short_motions.shift(missed_.v);
    }
    eq_.hold_end(x, t);
    if (eq_.pseudo_forces.any()) eq_.pseudo_force(t.end.motion.col(u), t.end.pseudo_force);
    if (carries)
      balance_end(t.end);
    else
      eq_.multiply(t.end, u, 3);
    eq_.gather(t.end);
    if (eq_.slips.any()) finish_slips(x, stage, h, t);
    if (!eq_.balance_middle(x, t)) return false;

    error.u.setZero();
    error.v.setZero();
    if (eq_.slips.any()) {
      error.slip.setZero(x.slip.size());
      eq_.slips.add_simpson_error(x, t, 1, error);
    }
    add_simpson_error(eq_.short_motions, x, t, 1, error);
    return true;
  }

 private:
  // Trapezoidal rule, of second order like the scheme.
  void finish_slips(const Instant& x, const Stage& stage, double h, Trial& t) {
    slip_rates_.resize(eq_.slips.size());
    eq_.slips.rates_of_stage(
        stages_.active(), [&](std::size_t k) { return stages_.link_motion(stage, k); }, slip_rates_);
    t.end.slip = slip_free_ + 0.5 * h * slip_rates_;
    eq_.slips.keep_friction_rates(slip_rates_, t.end);
    eq_.slips.average_sliding_rates(x, t);
  }

  // Computes the acceleration from dynamic equilibrium with the link forces of the scheme, in addition to the carried
  // one.
  void balance_end(Instant& end) {
    eq_.multiply(end, u, 2);
    auto balanced = end.motion.col(a);
    const Eigen::VectorXd& push = eq_.supports.push(end.ground);
    balanced = -push - end.motion.col(ku) - end.motion.col(cv);
    if (eq_.pseudo_forces.any()) balanced -= end.pseudo_force;
    if (stages_.forced()) eq_.solver.add_forces(-1, end.force, balanced);
    eq_.solver.accelerate(balanced);
    eq_.solver.recover(balanced);
    eq_.multiply(end, a, 2);
  }

  Equations& eq_;
  StageSolver& stages_;
  GeneralizedAlpha k_;
  Eigen::VectorXd r_, ground_, ground_begin_;
  Eigen::MatrixXd begin_;  // if the scheme carries a separate acceleration: [coordinate, a K a C a]
  GroundDefect missed_;    // of the short ground motions
  Eigen::VectorXd guess_, free_displacement_;
  Eigen::VectorXd slip_free_, slip_rates_;  // slips without their rates at the end, and these; empty if none slips
};

}  // namespace

std::unique_ptr<TimeScheme> make_generalized_alpha(Equations& equations, StageSolver& stages,
                                                   const GeneralizedAlpha& coefficients) {
  return std::make_unique<GeneralizedAlphaScheme>(equations, stages, coefficients);
}

}  // namespace pounding
