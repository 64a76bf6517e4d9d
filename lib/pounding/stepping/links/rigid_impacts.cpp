#include <pounding/stepping/links/rigid_impacts.hpp>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include <pounding/stepping/event_functions.hpp>

namespace pounding {
namespace {

// Maximum number of rounds of impulses in a row of rigid bodies; remaining closing rates are absorbed plastically.
constexpr int max_rounds = 10000;
// Minimum height of a bounce, in units of the round-off of the motion; a lower one ends before a step can resolve it.
constexpr double min_hop_height = 4;

}  // namespace

Eigen::VectorXd plastic_impulses(const Eigen::MatrixXd& g, const Eigen::VectorXd& rate, double negligible) {
  const int count = static_cast<int>(rate.size());
  Eigen::VectorXd f = Eigen::VectorXd::Zero(count);
  std::vector<int> pressed;
  // Each pass decreases the objective, so the passes terminate; the limit guards against round-off.
  for (int pass = 0; pass < 10 * count; ++pass) {
    const Eigen::VectorXd left = rate - g * f;
    int worst = -1;
    for (int i = 0; i < count; ++i)
      if (left[i] > negligible && (worst < 0 || left[i] > left[worst]) &&
          std::find(pressed.begin(), pressed.end(), i) == pressed.end())
        worst = i;
    if (worst < 0) return f;
    pressed.push_back(worst);
    while (!pressed.empty()) {
      const Eigen::VectorXd wanted =
          Eigen::MatrixXd(g(pressed, pressed)).completeOrthogonalDecomposition().solve(rate(pressed));
      double part = 1;
      for (std::size_t k = 0; k < pressed.size(); ++k)
        if (wanted[k] < 0) part = std::min(part, f[pressed[k]] / (f[pressed[k]] - wanted[k]));
      std::vector<int> stay;
      for (std::size_t k = 0; k < pressed.size(); ++k) {
        double& own = f[pressed[k]];
        own += part * (wanted[k] - own);
        if (part < 1 && wanted[k] < 0 && own <= 1e-14 * std::abs(wanted[k]))
          own = 0;
        else
          stay.push_back(pressed[k]);
      }
      if (stay.size() == pressed.size()) break;
      pressed = stay;
    }
  }
  return f;
}

RigidBounce bounce(const Strikes& strikes) {
  const Eigen::MatrixXd& g = strikes.flexibility;
  const int count = static_cast<int>(strikes.rate.size());
  Eigen::VectorXd rate = strikes.rate, impulse = Eigen::VectorXd::Zero(count), work = impulse;
  const auto strike = [&](int k, double after) {
    const double push = (rate[k] - after) / g(k, k);
    impulse[k] += push;
    work[k] += 0.5 * push * (rate[k] + after);
    rate -= push * g.col(k);
  };
  // Touching while separating: a rebound shorter than any step.
  for (int k = 0; k < strikes.parting; ++k)
    if (rate[k] < -strikes.still) strike(k, 0);
  bool struck = true;
  for (int round = 0; round < max_rounds && struck; ++round) {
    struck = false;
    for (int k = 0; k < count; ++k) {
      if (rate[k] <= strikes.slowest[k]) continue;
      strike(k, -strikes.restitution[k] * rate[k]);
      struck = true;
    }
  }
  const Eigen::VectorXd last = plastic_impulses(g, rate, strikes.still), after = rate - g * last;
  work += 0.5 * last.cwiseProduct(rate + after);
  impulse += last;
  return {impulse, work, after};
}

double slowest_bounce(double press, double restitution, double displacement, double time) {
  if (restitution == 0) return std::numeric_limits<double>::infinity();
  if (!(press > 0)) return 0;
  const double lowest = std::sqrt(2 * press * min_hop_height * motion_noise * displacement);
  const double briefest = 0.5 * press * no_time(time);
  return std::max(lowest / restitution, briefest / restitution);
}

void hold_contacts(const RigidContacts& rigid, const LinkSet& links, const Instant& begin,
                   const Eigen::MatrixXd& relative, const std::vector<int>& held, Instant& end) {
  using enum Instant::Column;
  Eigen::MatrixXd drift(static_cast<Eigen::Index>(held.size()), 2);
  for (std::size_t k = 0; k < held.size(); ++k) {
    const int i = held[k];
    const double before = begin.relative(i, u) + links.ground_part(begin.by_ground, i, u);
    drift.row(static_cast<Eigen::Index>(k)) << relative(i, u) + links.ground_part(end.by_ground, i, u) - before,
        relative(i, v) + links.ground_part(end.by_ground, i, v);
  }
  const Eigen::MatrixXd back =
      Eigen::MatrixXd(rigid.flexibility(held, held)).completeOrthogonalDecomposition().solve(drift);
  for (std::size_t k = 0; k < held.size(); ++k)
    end.motion.leftCols(2) -= rigid.response.col(held[k]) * back.row(static_cast<Eigen::Index>(k));
}

}  // namespace pounding
