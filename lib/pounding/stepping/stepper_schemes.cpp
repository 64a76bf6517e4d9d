/// A trial step by each scheme, and its error.

#include <Eigen/QR>
#include <array>
#include <cmath>

#include <pounding/stepping/stepper.hpp>

namespace pounding {
namespace {

// Where a link presses, the error by Simpson's rule counts beside that of the embedded scheme.
constexpr double simpson_part = 3;

// r -= K and C times what the accelerations of `earlier` stages add to a displacement and a velocity. `products` are three
// columns of n a stage: acceleration, K and C times it. One pass, as vectors are short or long.
template <int earlier>
void subtract_stages(int n, double h, const double* __restrict products, double* __restrict r) {
  double by_k[earlier], by_c[earlier];
  for (int j = 0; j < earlier; ++j) {
    by_k[j] = h * h * esdirk4::squared[earlier][j];
    by_c[j] = h * esdirk4::a[earlier][j];
  }
  for (int k = 0; k < n; ++k) {
    double sum = r[k];
    for (int j = 0; j < earlier; ++j) sum -= by_k[j] * products[(3 * j + 1) * n + k] + by_c[j] * products[(3 * j + 2) * n + k];
    r[k] = sum;
  }
}

constexpr std::array subtract{subtract_stages<1>, subtract_stages<2>, subtract_stages<3>, subtract_stages<4>, subtract_stages<5>};

}  // namespace

bool Stepper::attempt_alpha(double h) {
  Trial& t = *trial_;
  const int n = base_.size();
  const auto [alpha_m, alpha_f, beta, gamma] = alpha_;
  // With a spectral radius below one the scheme carries the acceleration of a time (alpha_m - alpha_f) h earlier: it goes
  // along when the step changes, else each change would cost an order.
  const double part = carries_ && kept_->h > 0 ? h / kept_->h : 1;
  const Column carried = carries_ ? c : a, k_carried = carries_ ? kc : ka, c_carried = carries_ ? cc : ca;

  const double *u0 = now_->at(u), *v0 = now_->at(v), *a0 = now_->at(a), *c0 = now_->at(carried);
  const double *ku0 = now_->at(ku), *kv0 = now_->at(kv), *ka0 = now_->at(ka), *kc0 = now_->at(k_carried);
  const double *cv0 = now_->at(cv), *ca0 = now_->at(ca), *cc0 = now_->at(c_carried);
  const double by_c_in_u = h * h * (0.5 - beta), by_c_in_v = h * (1 - gamma);
  stage_ground_ = alpha_f * t.end.ground + (1 - alpha_f) * now_->ground;

  for (int i = 0; i < n; ++i) work_[i] = a0[i] + part * (c0[i] - a0[i]);
  base_.mass_times(work_, r_);
  const double* pushed = push(stage_ground_);
  for (int i = 0; i < n; ++i)
    r_[i] = (alpha_m - 1) * r_[i] - pushed[i] - ku0[i] - cv0[i] -
            alpha_f * (h * kv0[i] + by_c_in_u * (ka0[i] + part * (kc0[i] - ka0[i])) +
                       by_c_in_v * (ca0[i] + part * (cc0[i] - ca0[i])));
  if (!active_.empty()) base_.add_forces(alpha_f - 1, now_->force, r_);

  t.end.force.setZero();
  if (!active_.empty()) t.end.force = now_->force;
  const auto respond = [&] {
    if (!base_.solve(r_)) return false;
    if (active_.empty()) return true;
    link_guess_ = t.end.force;
    t.end.force.setZero();
    base_.gather(r_, gathered_);
    free_.resize(active_.size());
    free_closing_.resize(static_cast<int>(active_.size()));
    for (std::size_t k = 0; k < active_.size(); ++k) {
      const int i = active_[k];
      const double sa = now_->relative(i, a), s = carries_ ? sa + part * (now_->relative(i, c) - sa) : sa;
      const double g = gathered_(i, 0);
      const double relative_displacement = now_->relative(i, u) + h * now_->relative(i, v) + by_c_in_u * s + beta * h * h * g;
      free_[k] = {deformation(i, relative_displacement + ground_part(t.end.by_ground, i, u)),
                  now_->relative(i, v) + by_c_in_v * s + gamma * h * g + ground_part(t.end.by_ground, i, v)};
      free_closing_[static_cast<int>(k)] = g;
      if (!moving_) continue;
      // At the time that the acceleration of the scheme belongs to.
      const double begin = now_->by_ground(i, a), end = t.end.by_ground(i, a);
      free_closing_[static_cast<int>(k)] += end + (alpha_m - alpha_f) * (begin - end);
    }
    return condense(beta * h * h, gamma * h, alpha_f, link_guess_, r_);
  };
  if (excess_.any()) {
    r_ -= (1 - alpha_f) * now_->excess;
    stage_guess_ = now_->motion.col(a) + part * (now_->motion.col(carried) - now_->motion.col(a));
    stage_free_ = now_->motion.col(u) + h * now_->motion.col(v) + by_c_in_u * stage_guess_;
    if (!solve_turning(stage_free_, beta * h * h, alpha_f, stage_guess_, respond)) return false;
  } else if (!respond()) {
    return false;
  }

  double *u1 = t.end.at(u), *v1 = t.end.at(v), *a1 = t.end.at(carried);
  for (int i = 0; i < n; ++i) {
    const double s = a0[i] + part * (c0[i] - a0[i]), x = r_[i];
    u1[i] = u0[i] + h * v0[i] + by_c_in_u * s + beta * h * h * x;
    v1[i] = v0[i] + by_c_in_v * s + gamma * h * x;
    a1[i] = x;
  }
  hold_end();
  if (excess_.any()) excess_at(t.end.motion.col(u), t.end.excess);
  if (carries_) {
    products(t.end, u, 2);
    auto balanced = t.end.motion.col(a);
    push(t.end.ground);
    balanced = -push_ - t.end.motion.col(ku) - t.end.motion.col(cv);
    if (excess_.any()) balanced -= t.end.excess;
    if (!active_.empty()) base_.add_forces(-1, t.end.force, balanced);
    base_.accelerate(balanced);
    base_.recover(balanced);
    products(t.end, a, 2);
  } else {
    products(t.end, u, 3);
  }
  base_.gather(t.end.motion.leftCols(width()), t.end.relative);
  evaluate_middle();

  error_u_.setZero();
  error_v_.setZero();
  add_simpson_error(1);
  return true;
}

// A scheme keeps the rate of a held contact as long as nothing but the structures moves. Where the ground itself moves one of
// its ends the error of the step would part the bodies or press them together: rate and penetration are set back.
void Stepper::hold_end() {
  if (!moving_) return;
  std::vector<int> holding;
  for (int i = 0; i < system_.contact_count(); ++i)
    if (held(i)) holding.push_back(i);
  if (holding.empty()) return;
  Instant& end = trial_->end;
  base_.gather(end.motion.leftCols(2), gathered_);
  Eigen::MatrixXd drift(static_cast<Eigen::Index>(holding.size()), 2);
  for (std::size_t k = 0; k < holding.size(); ++k) {
    const int i = holding[k];
    const double before = now_->relative(i, u) + now_->by_ground(i, u);
    drift.row(static_cast<Eigen::Index>(k)) << gathered_(i, u) + end.by_ground(i, u) - before, gathered_(i, v) + end.by_ground(i, v);
  }
  const Eigen::MatrixXd back =
      Eigen::MatrixXd(rigid_flexibility_(holding, holding)).completeOrthogonalDecomposition().solve(drift);
  for (std::size_t k = 0; k < holding.size(); ++k)
    end.motion.leftCols(2) -= rigid_response_.col(holding[k]) * back.row(static_cast<Eigen::Index>(k));
}

// The step's own velocities and displacements against Simpson's rule on the accelerations that balance the equations at its
// ends and its middle. It sees forces that are not smooth, such as a dashpot that grows like d^(1/4) from the touch.
// The larger of this, times `part`, and the error that is there already stays.
void Stepper::add_simpson_error(double part) {
  const Trial& t = *trial_;
  const double h = t.h;
  const double *u0 = now_->at(u), *v0 = now_->at(v), *a0 = now_->at(a);
  const double *u1 = t.end.at(u), *v1 = t.end.at(v), *a1 = t.end.at(a), *am = t.a_middle.data();
  const int n = base_.size();
  for (int i = 0; i < n; ++i) {
    const double ev = part * (h / 6 * (a0[i] + 4 * am[i] + a1[i]) - (v1[i] - v0[i]));
    const double eu = part * (h * h / 6 * (a0[i] + 2 * am[i]) - (u1[i] - u0[i] - h * v0[i]));
    if (std::abs(ev) > std::abs(error_v_[i])) error_v_[i] = ev;
    if (std::abs(eu) > std::abs(error_u_[i])) error_u_[i] = eu;
  }
}

bool Stepper::attempt_esdirk(double h) {
  using namespace esdirk4;
  Trial& t = *trial_;
  const int m = system_.links();
  const double begin = now_->time;
  const auto acceleration = [this](int j) { return stages_.col(3 * j); };
  const auto k_times = [this](int j) { return stages_.col(3 * j + 1); };
  const auto c_times = [this](int j) { return stages_.col(3 * j + 2); };
  const int n = base_.size();
  const double *u0 = now_->at(u), *v0 = now_->at(v), *ku0 = now_->at(ku), *kv0 = now_->at(kv), *cv0 = now_->at(cv);
  std::copy_n(now_->at(Stepper::a), n, stages_.col(0).data());
  std::copy_n(now_->at(ka), n, stages_.col(1).data());
  std::copy_n(now_->at(ca), n, stages_.col(2).data());
  stage_closings_.resize(m, stages);
  if (m > 0) stage_closings_.col(0) = now_->relative.col(Stepper::a);
  t.end.force = now_->force;
  for (int i = 1; i < stages; ++i) {
    const double ci = esdirk4::c[i];
    const bool last = i + 1 == stages;
    const bool middle = ci == 0.5;
    if (!last && !middle) ground_at(begin + ci * h, stage_ground_);
    const Eigen::VectorXd& ground = last ? t.end.ground : middle ? t.ground_middle : stage_ground_;
    if (moving_ && !last && !middle) closings_by_ground(begin + ci * h, ground, stage_by_ground_);
    const Eigen::MatrixXd& by_ground = last ? t.end.by_ground : middle ? t.by_ground_middle : stage_by_ground_;
    const double* pushed = push(ground);
    for (int k = 0; k < n; ++k) r_[k] = -pushed[k] - ku0[k] - cv0[k] - ci * h * kv0[k];
    subtract[i - 1](n, h, stages_.data(), r_.data());
    const auto respond = [&] {
      if (!base_.solve(r_)) return false;
      if (active_.empty()) return true;
      base_.gather(r_, gathered_);
      free_.resize(active_.size());
      free_closing_.resize(static_cast<int>(active_.size()));
      for (std::size_t k = 0; k < active_.size(); ++k) {
        const int link = active_[k];
        const double g = gathered_(link, 0);
        double relative_displacement = now_->relative(link, u) + ci * h * now_->relative(link, v) + shift * shift * h * h * g;
        double rate = now_->relative(link, v) + shift * h * g;
        for (int j = 0; j < i; ++j) {
          relative_displacement += h * h * squared[i][j] * stage_closings_(link, j);
          rate += h * esdirk4::a[i][j] * stage_closings_(link, j);
        }
        free_[k] = {deformation(link, relative_displacement + ground_part(by_ground, link, u)),
                    rate + ground_part(by_ground, link, v)};
        free_closing_[static_cast<int>(k)] = g + ground_part(by_ground, link, Stepper::a);
      }
      link_guess_ = t.end.force;
      t.end.force.setZero();
      if (!condense(shift * shift * h * h, shift * h, 1, link_guess_, r_)) return false;
      for (std::size_t k = 0; k < active_.size(); ++k) {
        double relief = 0;
        for (std::size_t l = 0; l < active_.size(); ++l) relief += flexibility_(k, l) * active_force_[l];
        stage_closings_(active_[k], i) = gathered_(active_[k], 0) - relief;
      }
      return true;
    };
    if (excess_.any()) {
      stage_free_ = now_->motion.col(u) + ci * h * now_->motion.col(v);
      for (int j = 0; j < i; ++j) stage_free_ += h * h * squared[i][j] * acceleration(j);
      stage_guess_ = acceleration(i - 1);
      if (!solve_turning(stage_free_, shift * shift * h * h, 1, stage_guess_, respond)) return false;
    } else if (!respond()) {
      return false;
    }
    std::copy_n(r_.data(), n, acceleration(i).data());
    if (last) break;
    base_.stiffness_times(acceleration(i), k_times(i));
    base_.damping_times(acceleration(i), k_times(i), c_times(i));
  }
  double *u1 = t.end.at(u), *v1 = t.end.at(v);
  for (int k = 0; k < n; ++k) {
    u1[k] = u0[k] + h * v0[k];
    v1[k] = v0[k];
    error_u_[k] = error_v_[k] = 0;
  }
  for (int j = 0; j < stages; ++j) {
    const double* x = stages_.col(3 * j).data();
    const double by_u = h * h * squared[stages - 1][j], by_v = h * esdirk4::a[stages - 1][j];
    const double error_by_u = h * h * error.displacement[j], error_by_v = h * error.velocity[j];
    for (int k = 0; k < n; ++k) {
      u1[k] += by_u * x[k];
      v1[k] += by_v * x[k];
      error_u_[k] += error_by_u * x[k];
      error_v_[k] += error_by_v * x[k];
    }
  }
  hold_end();
  if (excess_.any()) excess_at(t.end.motion.col(u), t.end.excess);
  std::copy_n(acceleration(stages - 1).data(), n, t.end.at(Stepper::a));
  products(t.end, u, 3);
  base_.gather(t.end.motion.leftCols(width()), t.end.relative);
  evaluate_middle();
  if (!active_.empty()) add_simpson_error(simpson_part);
  return true;
}

}  // namespace pounding
