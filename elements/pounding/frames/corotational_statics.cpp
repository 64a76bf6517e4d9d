// Equilibrium paths of a corotational frame: Newton's method at given loads, and arc length.

#include <pounding/frames/corotational.hpp>

#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/core/refuse.hpp>

namespace pounding {

using Eigen::VectorXd;

namespace {

// Minimum arc length, above the level of round-off.
constexpr double shortest_arc = 1e-6;  // relative to the first
constexpr int few_iterations = 4;      // maximum number after which the next step is longer
// Norm of the residual relative to the load; each row is divided by the square root of its stiffness, to make
// forces and moments comparable.
constexpr double tolerance = 1e-9;
constexpr int max_iterations = 30;  // maximum number of Newton iterations per step
constexpr int max_points = 2000;    // on a path by arc length

}  // namespace

/// A path under one load. Arc length: ds^2 = dq.W dq / w + (dfactor / first)^2, where W is the diagonal of the
/// stiffness at rest and w is dq.W dq of the linear response to the first factor, so that all terms are dimensionless.
class CorotationalFrame::Path {
 public:
  Path(const CorotationalFrame& frame, const VectorXd& load, double first)
      : frame_(frame), load_(load), first_(first), weight_(frame.linear_.diagonal()) {
    frame.require_size(load, "load");
    if (!load.allFinite() || load.isZero(0)) refuse("the load must be finite and not zero");
    points_.push_back({0, VectorXd::Zero(frame.size())});
    factor(points_.back().q);
    const VectorXd q = first * solve(load);
    if ((weight_.array() <= 0).any() || !q.allFinite()) refuse("the frame is not supported: its stiffness is singular");
    scale_ = q.dot(weight_.cwiseProduct(q));
    direction_ = {first, q};
    arc_ = std::sqrt(product(direction_, direction_));
    longest_arc_ = arc_;
  }

  const std::vector<Equilibrium>& points() const { return points_; }

  /// Newton's method at this factor from the last point; stores no point if it fails.
  bool load_step(double at) { return keep(at_factor(at, points_.back().q)); }

  /// Adds a point by arc length.
  void arc_step() {
    const Equilibrium from = points_.back();
    for (; arc_ > shortest_arc * longest_arc_; arc_ /= 2) {
      int iterations = 0;
      const auto found = beyond(from, arc_, iterations);
      if (!found) continue;
      direction_ = {found->factor - from.factor, found->q - from.q};
      keep(found);
      if (iterations <= few_iterations) arc_ = std::min(1.5 * arc_, longest_arc_);
      return;
    }
    throw SolverError("no equilibrium found beyond the load factor " + std::to_string(from.factor) +
                      "; use more members, or check whether the path ends in a mechanism");
  }

  /// Advances by arc length past the factor, then solves at the factor.
  void follow_to(double target) {
    if (points_.size() > 1) {
      direction_ = {points_.back().factor - points_.end()[-2].factor, points_.back().q - points_.end()[-2].q};
      arc_ = std::min(longest_arc_, std::sqrt(product(direction_, direction_)));
    }
    for (int count = 0; count < max_points; ++count) {
      arc_step();
      const Equilibrium &before = points_.end()[-2], &after = points_.back();
      if ((before.factor - target) * (after.factor - target) > 0) continue;
      const double share = (target - before.factor) / (after.factor - before.factor);
      const auto there = at_factor(target, before.q + share * (after.q - before.q));
      if (!there) continue;
      points_.back() = *there;
      return;
    }
    throw SolverError("the load was not reached in " + std::to_string(max_points) +
                      " points by arc length; last load factor: " + std::to_string(points_.back().factor));
  }

 private:
  double product(const Equilibrium& a, const Equilibrium& b) const {
    return a.q.dot(weight_.cwiseProduct(b.q)) / scale_ + a.factor * b.factor / (first_ * first_);
  }
  void factor(const VectorXd& q) { lu_.emplace().compute(frame_.tangent(q)); }
  VectorXd solve(const VectorXd& right) {
    if (lu_->info() != Eigen::Success) return VectorXd::Constant(right.size(), NAN);
    return lu_->solve(right);
  }
  bool small(const VectorXd& residual, double at) const {
    const VectorXd root = weight_.cwiseSqrt();
    return residual.cwiseQuotient(root).norm() <=
           tolerance * load_.cwiseQuotient(root).norm() * std::max(std::abs(at), std::abs(first_));
  }
  bool keep(const std::optional<Equilibrium>& found) {
    if (found) points_.push_back(*found);
    return found.has_value();
  }

  std::optional<Equilibrium> at_factor(double at, VectorXd q) {
    for (int i = 0; i <= max_iterations; ++i) {
      const VectorXd residual = frame_.force(q) - at * load_;
      if (!residual.allFinite()) return {};
      if (small(residual, at)) return Equilibrium{at, q};
      factor(q);
      q -= solve(residual);
    }
    return {};
  }

  std::optional<Equilibrium> beyond(const Equilibrium& from, double arc, int& iterations) {
    factor(from.q);
    Equilibrium ahead{1, solve(load_)};
    if (!ahead.q.allFinite()) ahead = direction_;  // exactly at a limit point
    const double size = std::sqrt(product(ahead, ahead));
    const double sign = product(ahead, direction_) < 0 ? -1 : 1;
    ahead = {sign / size * ahead.factor, sign / size * ahead.q};

    Equilibrium at{from.factor + arc * ahead.factor, from.q + arc * ahead.q};
    for (iterations = 0; iterations <= max_iterations; ++iterations) {
      const VectorXd residual = frame_.force(at.q) - at.factor * load_;
      if (!residual.allFinite()) return {};
      // A point far from the predicted one belongs to another part of the path.
      const Equilibrium moved{at.factor - from.factor, at.q - from.q};
      if (product(moved, moved) > 4 * arc * arc) return {};
      if (small(residual, at.factor)) return at;
      factor(at.q);
      const Equilibrium back{0, solve(residual)}, along{1, solve(load_)};
      const double change = product(ahead, back) / product(ahead, along);
      at = {at.factor + change, at.q - back.q + change * along.q};
    }
    return {};
  }

  const CorotationalFrame& frame_;
  const VectorXd& load_;
  double first_, scale_ = 1, arc_ = 0, longest_arc_ = 0;
  VectorXd weight_;
  Equilibrium direction_;
  std::vector<Equilibrium> points_;
  std::optional<Eigen::SparseLU<Eigen::SparseMatrix<double>>> lu_;
};

std::vector<CorotationalFrame::Equilibrium> CorotationalFrame::solve(const VectorXd& load, int steps) const {
  if (steps < 1) throw std::invalid_argument("the number of load steps must be at least 1");
  Path path(*this, load, 1.0 / steps);
  for (int k = 1; k <= steps; ++k)
    if (!path.load_step(static_cast<double>(k) / steps)) {
      path.follow_to(1);
      break;
    }
  return path.points();
}

std::vector<CorotationalFrame::Equilibrium> CorotationalFrame::follow(const VectorXd& load, double first_factor,
                                                                      int points) const {
  if (!(first_factor != 0) || !std::isfinite(first_factor))
    throw std::invalid_argument("the first factor must be finite and not zero");
  Path path(*this, load, first_factor);
  for (int k = 0; k < points; ++k) path.arc_step();
  return path.points();
}

}  // namespace pounding
