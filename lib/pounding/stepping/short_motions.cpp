#include <pounding/stepping/short_motions.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pounding {
namespace {

using enum Instant::Column;

// A motion is short if its frequency is at least this multiple of that of the structure.
constexpr double short_ratio = 4;
// Period assumed for a free body, which has none [s].
constexpr double longest_period = 1;

}  // namespace

ShortMotions::ShortMotions(const System& system, const StructureSolver& solver) : system_(system), solver_(solver) {
  const int n = solver.size();
  const std::size_t groups = system.groups.size();
  Eigen::VectorXd shift(n), stiffness(n);
  for (int k = 0; k < static_cast<int>(system.grounds.size()); ++k) {
    const double period = system.grounds[k].shortest_period();
    if (!std::isfinite(period)) continue;
    shift = solver.layout().load.col(k);
    solver.accelerate(shift);
    solver.recover(shift);
    solver.stiffness_times(shift, stiffness);
    std::vector<double> sums(2 * groups, 0.0);
    for (const StructureSolver::Segment& s : solver.layout().segments) {
      sums[2 * s.group] += shift.segment(s.first, s.count).dot(stiffness.segment(s.first, s.count));
      sums[2 * s.group + 1] +=
          shift.segment(s.first, s.count).dot(solver.layout().load.col(k).segment(s.first, s.count));
    }
    solver.combine(sums);
    const auto is_short = [&](int group) {
      const double mass = sums[2 * group + 1];
      if (!(mass > 0)) return false;
      const double w =
          std::max(std::sqrt(std::max(0.0, sums[2 * group] / mass)), 2 * std::numbers::pi / longest_period);
      return 2 * std::numbers::pi / period > short_ratio * w;
    };
    bool any = false;
    for (int group = 0; group < static_cast<int>(groups); ++group) any = any || is_short(group);
    if (!any) continue;
    if (index_.empty()) other_load_ = solver.layout().load;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(n);
    for (const StructureSolver::Segment& s : solver.layout().segments) {
      if (is_short(s.group))
        load.segment(s.first, s.count) = other_load_.col(k).segment(s.first, s.count);
      else
        shift.segment(s.first, s.count).setZero();
    }
    other_load_.col(k) -= load;
    index_.push_back(k);
    const auto count = static_cast<Eigen::Index>(index_.size());
    load_.conservativeResize(n, count);
    shift_.conservativeResize(n, count);
    load_.col(count - 1) = load;
    shift_.col(count - 1) = shift;
  }
  if (!any()) return;
  stiffness_.resize(n, shift_.cols());
  damping_.resize(n, shift_.cols());
  solver.stiffness_times(shift_, stiffness_);
  solver.damping_times(shift_, stiffness_, damping_);
  solver.gather(shift_, closing_);
  coupling_ = load_.transpose() * shift_;
  springs_ = dashpots_ = Eigen::MatrixXd::Zero(shift_.cols(), shift_.cols());
  for (const StructureSolver::Segment& s : solver.layout().segments) {
    const Eigen::MatrixXd own = shift_.middleRows(s.first, s.count).transpose();
    springs_ += own * stiffness_.middleRows(s.first, s.count);
    dashpots_ += own * damping_.middleRows(s.first, s.count);
  }
}

Eigen::MatrixXd ShortMotions::at(double time, const Eigen::VectorXd& ground, const Instant& begin) const {
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(index_.size()), 3);
  for (std::size_t i = 0; i < index_.size(); ++i) {
    if (!acts(i, begin.time)) continue;
    const GroundMotion& of = system_.grounds[index_[i]];
    motion.row(static_cast<Eigen::Index>(i)) << of.displacement(time), of.velocity(time), ground[index_[i]];
  }
  return motion;
}

void ShortMotions::follow(const Instant& begin, Trial& trial) const {
  trial.short_motions.reset();
  bool any = false;
  for (std::size_t i = 0; i < index_.size(); ++i) any = any || acts(i, begin.time);
  if (!any) return;
  trial.short_motions = {at(begin.time, begin.ground, begin),
                         at(begin.time + 0.5 * trial.h, trial.ground_middle, begin),
                         at(trial.end.time, trial.end.ground, begin)};
}

GroundDefect ShortMotions::of_cubic(const ShortMotionStep& step, double h) {
  const Eigen::MatrixXd &x = step.begin, &y = step.end;
  return {0.5 * (x.col(u) + y.col(u)) + h / 8 * (x.col(v) - y.col(v)) - step.middle.col(u),
          0.5 * (x.col(v) + y.col(v)) + h / 8 * (x.col(a) - y.col(a)) - step.middle.col(v)};
}

Eigen::VectorXd ShortMotions::velocity_at_end(const Trial& trial) const {
  Eigen::VectorXd velocity = trial.short_motions->end.col(v);
  for (std::size_t i = 0; i < index_.size(); ++i)
    if (trial.end.time >= system_.grounds[index_[i]].duration()) velocity[static_cast<Eigen::Index>(i)] = 0;
  return shift(velocity);
}

// With z = v + R g', the work is the integral of -ag P^T z + ag P^T R g'. The second term is exact; the first is
// integrated by parts to that of g' P^T z'. In P^T z', the spring forces due to the ground motion in the step are
// integrated exactly, as is their work. The dashpot forces due to the ground motion are summed like the dissipation in
// the ledger. All other forces, `slow`, hardly change in the step.
double ShortMotions::work(const Instant& begin, const Trial& kept) const {
  const Eigen::MatrixXd &x = kept.short_motions->begin, &m = kept.short_motions->middle, &y = kept.short_motions->end;
  const auto loads = [&](const Eigen::MatrixXd& ground, const double* rates, Instant::Column order) -> Eigen::VectorXd {
    return load_.transpose() * Eigen::Map<const Eigen::VectorXd>(rates, load_.rows()) + coupling_ * ground.col(order);
  };
  const auto exact = [&](const Eigen::MatrixXd& ground, const Instant& at) {
    return 0.5 * ground.col(v).dot(coupling_ * ground.col(v)) - ground.col(v).dot(loads(ground, at.at(v), v));
  };
  const auto slow = [&](const Eigen::MatrixXd& ground, const double* acceleration) -> Eigen::VectorXd {
    return loads(ground, acceleration, a) - springs_ * (ground.col(u) - x.col(u)) - dashpots_ * ground.col(v);
  };
  const auto dissipated = [&](const Eigen::MatrixXd& ground) { return ground.col(v).dot(dashpots_ * ground.col(v)); };
  const Eigen::VectorXd way = y.col(u) - x.col(u), middle = slow(m, kept.a_middle.data());
  return exact(y, kept.end) - exact(x, begin) + 0.5 * way.dot(springs_ * way) + middle.dot(way) +
         kept.h / 6 *
             (x.col(v).dot(slow(x, begin.at(a)) - middle) + y.col(v).dot(slow(y, kept.end.at(a)) - middle) +
              dissipated(x) + 4 * dissipated(m) + dissipated(y));
}

}  // namespace pounding
