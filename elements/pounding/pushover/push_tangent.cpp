#include <pounding/pushover/push_tangent.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace pounding {
namespace {

// A matrix with a smaller reciprocal condition number is singular.
constexpr double singular = 1e-12;
// Rates below this fraction of the maximum are zero.
constexpr double still = 1e-10;
// Offset from an accepted state at which a slope is evaluated, relative to the yield deformation.
constexpr double beside = 1e-9;

// Slopes of each part in both directions.
struct Sides {
  Eigen::VectorXd up, down;

  Eigen::VectorXd slopes(const Eigen::VectorXd& sides) const { return (sides.array() > 0).select(up, down); }
};

Sides sides_at(const std::vector<LoadedSpring>& springs, const Eigen::VectorXd& deformations,
               const Eigen::VectorXd& scales) {
  const auto count = deformations.size();
  Sides sides{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Eigen::Index j = 0; j < count; ++j) {
    const LoadedSpring& spring = springs[static_cast<std::size_t>(j)];
    sides.up[j] = spring.evaluate_slowly(deformations[j] + beside * scales[j]).by_penetration;
    sides.down[j] = spring.evaluate_slowly(deformations[j] - beside * scales[j]).by_penetration;
  }
  return sides;
}

// The fastest part moving against the direction of its chosen slope; -1 for none.
Eigen::Index most_wrong(const Sides& sides, const Eigen::VectorXd& chosen, const Eigen::VectorXd& scaled,
                        const std::vector<bool>& refused) {
  const double largest = scaled.cwiseAbs().maxCoeff();
  Eigen::Index found = -1;
  double worst = still * largest;
  for (Eigen::Index j = 0; j < chosen.size(); ++j)
    if (sides.up[j] != sides.down[j] && !refused[static_cast<std::size_t>(j)] && -scaled[j] * chosen[j] > worst) {
      worst = -scaled[j] * chosen[j];
      found = j;
    }
  return found;
}

}  // namespace

double deformation_scale(const Spring& spring, double deformation) {
  const double yield = spring.yield_deformation();
  return std::isfinite(yield) ? yield : std::max(std::abs(deformation), 1e-6);
}

PushTangent rates_of(const StaticYielding& statics, const Eigen::VectorXd& scales, Eigen::VectorXd slopes, double way) {
  PushTangent tangent;
  std::vector<Eigen::Index> active;
  for (Eigen::Index j = 0; j < slopes.size(); ++j)
    if (slopes[j] != 0) active.push_back(j);
  const Eigen::VectorXd elastic = way * statics.by_displacement();
  tangent.rates = elastic;
  Eigen::VectorXd force_rates = Eigen::VectorXd::Zero(slopes.size());
  if (!active.empty()) {
    // Relative to the scales, so that metres and radians have equal weight.
    const Eigen::VectorXd scale = scales(active), slope = slopes(active);
    const Eigen::MatrixXd soft = scale.cwiseInverse().asDiagonal() * statics.flexibility()(active, active) *
                                 slope.cwiseProduct(scale).asDiagonal();
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(Eigen::MatrixXd::Identity(soft.rows(), soft.cols()) + soft);
    tangent.exists = factors.rcond() > singular;
    if (!tangent.exists) return tangent;
    const Eigen::VectorXd rates = scale.cwiseProduct(factors.solve(elastic(active).cwiseQuotient(scale)));
    force_rates(active) = slope.cwiseProduct(rates);
    tangent.rates -= statics.flexibility() * force_rates;
    tangent.rates(active) = rates;
  }
  tangent.exists = tangent.rates.allFinite();
  tangent.load_rate = statics.factor(way, force_rates);
  tangent.slopes = std::move(slopes);
  return tangent;
}

PushTangent tangent_at(const StaticYielding& statics, const std::vector<LoadedSpring>& springs,
                       const Eigen::VectorXd& deformations, double way) {
  const auto count = deformations.size();
  Eigen::VectorXd scales(count);
  for (Eigen::Index j = 0; j < count; ++j)
    scales[j] = deformation_scale(springs[static_cast<std::size_t>(j)].spring(), deformations[j]);
  const Sides sides = sides_at(springs, deformations, scales);
  const std::vector<bool> none(static_cast<std::size_t>(count), false);

  Eigen::VectorXd chosen = (way * statics.by_displacement()).array().sign();
  for (int round = 0; round < 10; ++round) {
    PushTangent tangent = rates_of(statics, scales, sides.slopes(chosen), way);
    if (!tangent.exists) break;
    const Eigen::VectorXd scaled = tangent.rates.cwiseQuotient(scales);
    if (most_wrong(sides, chosen, scaled, none) < 0) return tangent;
    for (Eigen::Index j = 0; j < count; ++j)
      if (std::abs(scaled[j]) > still * scaled.cwiseAbs().maxCoeff()) chosen[j] = scaled[j] > 0 ? 1 : -1;
  }

  // Starts from the stiffer sides. A part without hardening that would make the tangent singular is unchanged if the
  // yielding parts already take its motion.
  for (Eigen::Index j = 0; j < count; ++j) chosen[j] = sides.up[j] > sides.down[j] ? 1 : -1;
  std::vector<bool> refused = none;
  PushTangent tangent = rates_of(statics, scales, sides.slopes(chosen), way);
  for (Eigen::Index round = 0; tangent.exists && round < 20 * (count + 1); ++round) {
    const Eigen::VectorXd scaled = tangent.rates.cwiseQuotient(scales);
    const Eigen::Index wrong = most_wrong(sides, chosen, scaled, refused);
    if (wrong < 0) {
      tangent.exists = most_wrong(sides, chosen, scaled, none) < 0;
      return tangent;
    }
    chosen[wrong] = -chosen[wrong];
    const PushTangent next = rates_of(statics, scales, sides.slopes(chosen), way);
    if (next.exists) {
      tangent = next;
    } else {
      chosen[wrong] = -chosen[wrong];
      refused[static_cast<std::size_t>(wrong)] = true;
    }
  }
  tangent.exists = false;
  return tangent;
}

}  // namespace pounding
