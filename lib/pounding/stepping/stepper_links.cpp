/// The link forces of a trial step: Newton on the few equations that condensation leaves.

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include <pounding/stepping/stepper.hpp>

namespace pounding {
namespace {

// A force is the difference of terms of this size; its rounding follows them.
double terms(const laws::Response& law, const LinkMotion& at) {
  return std::abs(law.by_penetration * at.penetration) + std::abs(law.by_rate * at.rate);
}

constexpr double solved = 1e-14;  // of the terms of a force

}  // namespace

void Stepper::find_sliders() {
  sliders_.clear();
  const auto place = [&](int link) {
    return static_cast<int>(std::lower_bound(active_.begin(), active_.end(), link) - active_.begin());
  };
  for (const Friction& friction : system_.frictions)
    if (works(friction.contact)) sliders_.push_back({&friction, place(friction.contact), place(friction.first)});
}

bool Stepper::condense(double by_u, double by_v, double weight, const Eigen::VectorXd& guess,
                       Eigen::Ref<Eigen::VectorXd> x) {
  const int count = static_cast<int>(active_.size());
  active_force_.resize(count);
  for (int k = 0; k < count; ++k) active_force_[k] = guess[active_[k]];
  if (!(count == 1 ? solve_one_link(0, by_u, by_v, weight, 0.0, active_force_[0])
                   : solve_many_links(by_u, by_v, weight)))
    return false;
  for (int k = 0; k < count; ++k) trial_->end.force[active_[k]] = active_force_[k];
  base_.add_response(-weight, active_, active_force_, x);
  return true;
}

// A held contact takes the force that leaves no closing acceleration: from a rate of zero it stays at zero. Else the
// force lies between zero and what the law would answer to the free motion; a spring that softens goes beyond that.
// Newton inside the bracket. `others` is what the other links take off, G F without this one.
bool Stepper::solve_one_link(int place, double by_u, double by_v, double weight, double others, double& force) {
  const int link = active_[place];
  const double flexibility = flexibility_(place, place);
  const double relief_u = weight * by_u * flexibility, relief_v = weight * by_v * flexibility;
  if (held(link)) {
    force = (free_closing_[place] / weight - others) / flexibility;
    return true;
  }
  const double scale = others / flexibility;
  const LinkMotion free{free_[place].penetration - relief_u * scale, free_[place].rate - relief_v * scale};
  const auto residual_at = [&](double f) {
    return law(link, {free.penetration - relief_u * f, free.rate - relief_v * f}).force - f;
  };
  const double unrelieved = law(link, free).force;
  double low = std::min(0.0, unrelieved), high = std::max(0.0, unrelieved);
  if (low == high) {
    force = low;
    return true;
  }
  if (link >= system_.contact_count()) {
    double& far = unrelieved > 0 ? high : low;
    for (int doubling = 0; doubling < 60 && residual_at(far) * unrelieved > 0; ++doubling) far *= 2;
  }
  double trial = std::clamp(force, low, high);
  for (int iteration = 0; iteration < 200; ++iteration) {
    ++iterations_;
    const LinkMotion at{free.penetration - relief_u * trial, free.rate - relief_v * trial};
    const laws::Response answer = law(link, at);
    const double residual = answer.force - trial;
    if (std::abs(residual) <= solved * std::max({std::abs(trial), std::abs(answer.force), terms(answer, at)})) {
      force = trial;
      return true;
    }
    (residual > 0 ? low : high) = trial;
    if (high - low <= 4e-16 * std::max(std::abs(low), std::abs(high))) {
      force = trial;
      return true;
    }
    const double slope = 1 + relief_u * answer.by_penetration + relief_v * answer.by_rate;
    double next = trial + residual / slope;
    if (!(slope > 0) || !(next > low && next < high)) next = 0.5 * (low + high);
    if (next == trial) {
      force = trial;
      return true;
    }
    trial = next;
  }
  troublesome_ = link;
  return false;
}

// What a friction answers where the forces take `relief` off the closing accelerations; `by_u` and `by_v` of the equations of
// the links.
FrictionForce Stepper::slide(const Slider& slider, double by_u, double by_v, const Eigen::VectorXd& relief) const {
  const auto rate = [&](int place) { return free_[place].rate - by_v * relief[place]; };
  const LinkMotion contact{free_[slider.contact].penetration - by_u * relief[slider.contact], rate(slider.contact)};
  Sliding rates{};
  for (int j = 0; j < slider.friction->count; ++j) rates[j] = rate(slider.first + j);
  return friction_force(*slider.friction, law(active_[slider.contact], contact), rates);
}

// One component of a friction after the other by bisection, all other forces as they are.
bool Stepper::solve_slider(const Slider& slider, double by_u, double by_v, Eigen::VectorXd& forces) {
  Eigen::VectorXd relief = flexibility_ * forces;
  for (int j = 0; j < slider.friction->count; ++j) {
    const int place = slider.first + j;
    const Eigen::VectorXd others = relief - forces[place] * flexibility_.col(place);
    const auto residual_at = [&](double f) {
      ++iterations_;
      return slide(slider, by_u, by_v, others + f * flexibility_.col(place)).force[j] - f;
    };
    const double unrelieved = residual_at(0);
    double low = std::min(0.0, unrelieved), high = std::max(0.0, unrelieved);
    double& far = unrelieved > 0 ? high : low;
    for (int doubling = 0; doubling < 60 && residual_at(far) * unrelieved > 0; ++doubling) far *= 2;
    while (high - low > 4e-16 * std::max(std::abs(low), std::abs(high))) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (residual_at(middle) > 0 ? low : high) = middle;
    }
    forces[place] = 0.5 * (low + high);
    if (!std::isfinite(forces[place])) return false;
    relief = others + forces[place] * flexibility_.col(place);
  }
  return true;
}

bool Stepper::solve_many_links(double by_u, double by_v, double weight) {
  const int count = static_cast<int>(active_.size());
  by_u *= weight;
  by_v *= weight;
  const Eigen::MatrixXd& g = flexibility_;
  Eigen::VectorXd& f = active_force_;
  Eigen::VectorXd residual(count), relief(count), trial(count);
  Eigen::MatrixXd slopes(count, count);
  // Held contacts between the same bodies leave their shares open.
  const int plain = static_cast<int>(std::lower_bound(active_.begin(), active_.end(), frictions_from_) - active_.begin());
  int held_count = 0;
  for (const int link : active_) held_count += held(link);
  const bool several_held = held_count > 1;
  double scale = 0;
  const auto evaluate = [&](const Eigen::VectorXd& x, bool with_slopes) {
    ++iterations_;
    scale = x.norm();
    relief.noalias() = g * x;
    for (int i = 0; i < plain; ++i) {
      if (held(active_[i])) {
        residual[i] = (free_closing_[i] / weight - relief[i]) / g(i, i);
        if (with_slopes) slopes.row(i) = g.row(i) / g(i, i);
        continue;
      }
      const LinkMotion now{free_[i].penetration - by_u * relief[i], free_[i].rate - by_v * relief[i]};
      const laws::Response answer = law(active_[i], now);
      residual[i] = answer.force - x[i];
      scale = std::max(scale, terms(answer, now));
      if (!with_slopes) continue;
      slopes.row(i) = (by_u * answer.by_penetration + by_v * answer.by_rate) * g.row(i);
      slopes(i, i) += 1;
    }
    for (const Slider& slider : sliders_) {
      const FrictionForce answer = slide(slider, by_u, by_v, relief);
      for (int j = 0; j < slider.friction->count; ++j) {
        const int i = slider.first + j;
        residual[i] = answer.force[j] - x[i];
        for (int k = 0; k < slider.friction->count; ++k) {
          const int other = slider.first + k;
          scale = std::max(scale, std::abs(answer.by_sliding[j][k]) *
                                      std::max(std::abs(free_[other].rate), std::abs(by_v * relief[other])));
        }
        if (!with_slopes) continue;
        slopes.row(i) = (by_u * answer.by_penetration[j] + by_v * answer.by_rate[j]) * g.row(slider.contact);
        for (int k = 0; k < slider.friction->count; ++k) slopes.row(i) += by_v * answer.by_sliding[j][k] * g.row(slider.first + k);
        slopes(i, i) += 1;
      }
    }
    return residual.norm();
  };
  // Gauss-Seidel with the bracketed scalar solve: slower, but it cannot fail on laws that grow with penetration and rate.
  const auto sweep = [&](Eigen::VectorXd& x) {
    for (int i = 0; i < plain; ++i) {
      const double others = g.row(i).dot(x) - g(i, i) * x[i];
      if (!solve_one_link(i, by_u / weight, by_v / weight, weight, others, x[i])) return false;
    }
    for (const Slider& slider : sliders_)
      if (!solve_slider(slider, by_u, by_v, x)) return false;
    return true;
  };
  for (int iteration = 0; iteration < 500; ++iteration) {
    const double size = evaluate(f, true);
    if (!std::isfinite(size)) return false;
    if (size <= solved * scale) return true;
    const double here = scale;
    const Eigen::VectorXd direction =
        several_held ? Eigen::VectorXd(slopes.completeOrthogonalDecomposition().solve(residual))
                     : Eigen::VectorXd(slopes.partialPivLu().solve(residual));
    double length = 1;
    bool better = false;
    for (int halving = 0; halving < 8 && !better; ++halving, length /= 2) {
      trial = f + length * direction;
      better = evaluate(trial, false) < size;
    }
    if (better)
      f = trial;
    else if (size <= 100 * solved * here)  // rounding: Newton cannot do better
      return true;
    else if (!sweep(f))
      return false;
  }
  troublesome_ = active_.front();
  return false;
}

}  // namespace pounding
