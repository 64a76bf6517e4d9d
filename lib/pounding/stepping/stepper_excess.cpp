/// A stage of a step where elastic forces are more than K u.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <pounding/stepping/stepper.hpp>

namespace pounding {
namespace {

// Changes of the displacement, of its size: as small as rounding lets them be; where stiff members make rounding larger they
// stop shrinking at it.
constexpr double solved = 1e-14;
constexpr double nearly_solved = 1e-11;
constexpr int max_iterations = 100;
// Differences of two iterations that are kept.
constexpr std::size_t max_secants = 30;
// Part of a difference that those before it leave; less is rounding.
constexpr double something_new = 1e-8;

}  // namespace

void Stepper::excess_at(Eigen::Ref<const Eigen::VectorXd> displacement, Eigen::VectorXd& excess) const {
  base_.physical(displacement, whole_);
  excess_.evaluate(own_groups_, whole_, whole_excess_);
  excess.setZero(base_.size());
  base_.add_physical_forces(whole_excess_, excess);
}

double Stepper::weighted_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  double sum = (base_.weights().array() * a.array() * b.array()).sum();
  base_.combine({&sum, 1});
  return sum;
}

// The largest of all groups, both as root mean squares weighed by the masses.
double Stepper::relative_size(const Eigen::VectorXd& change, const Eigen::VectorXd& displacement) const {
  std::vector<double> sums(2 * system_.groups.size(), 0.0);
  const Eigen::VectorXd& w = base_.weights();
  for (const StructureSolver::Segment& s : base_.segments())
    for (int i = s.first; i < s.first + s.count; ++i) {
      sums[2 * s.group] += w[i] * change[i] * change[i];
      sums[2 * s.group + 1] += w[i] * displacement[i] * displacement[i];
    }
  base_.combine(sums);
  double worst = 0;
  for (std::size_t k = 0; k < system_.groups.size(); ++k) {
    const double size = std::max({displacement_scale_[k], rest_size_[k], std::sqrt(sums[2 * k + 1] / base_.group_masses()[k])});
    const double ratio = std::sqrt(sums[2 * k] / base_.group_masses()[k]) / size;
    if (!(ratio <= worst)) worst = ratio;
  }
  return worst;
}

// x = R(x), where R is what the stage answers to the excess forces at x, by Anderson's method: of all combinations of the
// iterations so far the one whose residual R(x) - x would be least if R were linear. (Plain repetition does not converge where
// a stiff member has turned so far that the matrix of the step knows nothing of its stiffness.)
bool Stepper::solve_turning(const Eigen::VectorXd& free, double by_u, double weight, const Eigen::VectorXd& guess,
                            const std::function<bool()>& respond) {
  struct Secant {
    Eigen::VectorXd step, change;  // of x and of the residual; the changes are orthonormal
  };
  std::vector<Secant> secants;
  const Eigen::VectorXd forces = r_;
  Eigen::VectorXd x = guess, displacement, residual, last_x, last_residual;
  double least = std::numeric_limits<double>::infinity(), slope = 0;
  int since_least = 0;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    displacement = free + by_u * x;
    excess_at(displacement, excess_forces_);
    r_ = forces - weight * excess_forces_;
    if (!respond()) return false;
    ++iterations_;
    residual = r_ - x;
    const double size = relative_size(by_u * residual, displacement);
    if (!std::isfinite(size)) return false;
    // r_ is nearer than x by what R makes of a difference.
    if (iteration > 0) {
      const Eigen::VectorXd step = x - last_x, answer = step + residual - last_residual;
      slope = std::max(slope, std::sqrt(weighted_product(answer, answer) / weighted_product(step, step)));
    }
    if (size * (iteration > 0 ? slope : 1) <= solved) return true;
    since_least = size < 0.5 * least ? 0 : since_least + 1;
    least = std::min(least, size);
    if (since_least >= 3 && size <= nearly_solved) return true;
    if (iteration > 0) {
      Secant next{x - last_x, residual - last_residual};
      const double whole = std::sqrt(weighted_product(next.change, next.change));
      for (const Secant& s : secants) {
        const double part = weighted_product(s.change, next.change);
        next.step -= part * s.step;
        next.change -= part * s.change;
      }
      const double left = std::sqrt(weighted_product(next.change, next.change));
      if (left > something_new * whole) {
        next.step /= left;
        next.change /= left;
        if (secants.size() == max_secants) secants.erase(secants.begin());
        secants.push_back(std::move(next));
      }
    }
    last_x = x;
    last_residual = residual;
    for (const Secant& s : secants) {
      const double part = weighted_product(s.change, residual);
      x -= part * s.step;
      residual -= part * s.change;
    }
    x += residual;
  }
  return false;
}

}  // namespace pounding
