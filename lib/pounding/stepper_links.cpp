/// The link forces of a trial step: Newton on the few equations that condensation leaves.

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include <pounding/stepper.hpp>

namespace pounding {

bool Stepper::solve_links(const Eigen::MatrixXd& flexibility, double h, const Eigen::VectorXd& u,
                          const Eigen::VectorXd& v, const Eigen::VectorXd& a, Eigen::VectorXd& force) {
  active_.clear();
  for (int i = 0; i < system_.links(); ++i) {
    if (!presses(system_.contacts[i]->phase())) continue;
    active_.push_back(i);
    free_[i] = motion(i, u, v);
    free_closing_[i] = closing(i, a);
    force[i] = now_.force[i];
  }
  if (active_.empty()) return true;
  if (active_.size() == 1) {
    const int i = active_.front();
    return solve_one_link(i, flexibility(i, i), h, 0.0, force[i]);
  }
  return solve_many_links(flexibility, h, force);
}

// A held contact takes the force that leaves no closing acceleration: from a rate of zero it stays at zero. Else the
// force lies between zero and what the law would answer to the free motion; Newton inside that bracket.
// `others` is what the other links take off, G F without this one.
bool Stepper::solve_one_link(int link, double flexibility, double h, double others, double& force) {
  const double by_u = alpha_f_ * beta_ * h * h * flexibility;
  const double by_v = alpha_f_ * gamma_ * h * flexibility;
  const double scale = others / flexibility;
  const LinkMotion free{free_[link].penetration - by_u * scale, free_[link].rate - by_v * scale};
  const Contact& contact = *system_.contacts[link];
  if (contact.phase() == ContactPhase::resting) {
    force = (free_closing_[link] / alpha_f_ - others) / flexibility;
    return true;
  }
  const double unrelieved = contact.evaluate(free).force;
  double low = std::min(0.0, unrelieved), high = std::max(0.0, unrelieved);
  if (low == high) {
    force = low;
    return true;
  }
  double trial = std::clamp(force, low, high);
  for (int iteration = 0; iteration < 200; ++iteration) {
    ++iterations_;
    const LinkForce law = contact.evaluate({free.penetration - by_u * trial, free.rate - by_v * trial});
    const double residual = law.force - trial;
    if (std::abs(residual) <= 1e-14 * std::max(std::abs(trial), std::abs(law.force)) || residual == 0) {
      force = trial;
      return true;
    }
    (residual > 0 ? low : high) = trial;
    if (high - low <= 4e-16 * std::max(std::abs(low), std::abs(high))) {
      force = trial;
      return true;
    }
    const double slope = 1 + by_u * law.by_penetration + by_v * law.by_rate;
    double next = trial + residual / slope;
    if (!(slope > 0) || !(next > low && next < high)) next = 0.5 * (low + high);
    if (next == trial) {
      force = trial;
      return true;
    }
    trial = next;
  }
  return false;
}

bool Stepper::solve_many_links(const Eigen::MatrixXd& flexibility, double h, Eigen::VectorXd& force) {
  const int count = static_cast<int>(active_.size());
  const double by_u = alpha_f_ * beta_ * h * h;
  const double by_v = alpha_f_ * gamma_ * h;
  Eigen::MatrixXd g(count, count);
  Eigen::VectorXd f(count);
  for (int i = 0; i < count; ++i) {
    f[i] = force[active_[i]];
    for (int j = 0; j < count; ++j) g(i, j) = flexibility(active_[i], active_[j]);
  }
  Eigen::VectorXd residual(count), relief(count), trial(count);
  Eigen::MatrixXd slopes(count, count);
  const auto held = [&](int i) { return system_.contacts[active_[i]]->phase() == ContactPhase::resting; };
  // Held contacts between the same bodies leave their shares open.
  int held_count = 0;
  for (int i = 0; i < count; ++i) held_count += held(i);
  const bool several_held = held_count > 1;
  const auto evaluate = [&](const Eigen::VectorXd& x, bool with_slopes) {
    ++iterations_;
    relief.noalias() = g * x;
    for (int i = 0; i < count; ++i) {
      const LinkMotion& free = free_[active_[i]];
      const LinkMotion now{free.penetration - by_u * relief[i], free.rate - by_v * relief[i]};
      if (held(i)) {
        residual[i] = (free_closing_[active_[i]] / alpha_f_ - relief[i]) / g(i, i);
        if (with_slopes) slopes.row(i) = g.row(i) / g(i, i);
        continue;
      }
      const LinkForce law = system_.contacts[active_[i]]->evaluate(now);
      residual[i] = law.force - x[i];
      if (!with_slopes) continue;
      slopes.row(i) = (by_u * law.by_penetration + by_v * law.by_rate) * g.row(i);
      slopes(i, i) += 1;
    }
    return residual.norm();
  };
  // Gauss-Seidel with the bracketed scalar solve: slower, but it cannot fail on laws that grow with penetration and rate.
  const auto sweep = [&](Eigen::VectorXd& x) {
    for (int i = 0; i < count; ++i) {
      const double others = g.row(i).dot(x) - g(i, i) * x[i];
      if (!solve_one_link(active_[i], g(i, i), h, others, x[i])) return false;
    }
    return true;
  };
  for (int iteration = 0; iteration < 500; ++iteration) {
    const double size = evaluate(f, true);
    if (!std::isfinite(size)) return false;
    if (size <= 1e-14 * f.norm() || size == 0) {
      for (int i = 0; i < count; ++i) force[active_[i]] = f[i];
      return true;
    }
    const Eigen::VectorXd direction =
        several_held ? Eigen::VectorXd(slopes.completeOrthogonalDecomposition().solve(residual))
                     : Eigen::VectorXd(slopes.partialPivLu().solve(residual));
    double length = 1;
    bool better = false;
    for (int halving = 0; halving < 8 && !better; ++halving, length /= 2) {
      trial = f + length * direction;
      better = evaluate(trial, false) < size;
    }
    if (better) {
      f = trial;
    } else if (size <= 1e-12 * f.norm()) {  // rounding: Newton cannot do better
      for (int i = 0; i < count; ++i) force[active_[i]] = f[i];
      return true;
    } else if (!sweep(f)) {
      return false;
    }
  }
  return false;
}

}  // namespace pounding
