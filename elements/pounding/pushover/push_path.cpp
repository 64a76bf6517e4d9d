#include <pounding/pushover/push_path.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/core/error.hpp>
#include <pounding/pushover/push_tangent.hpp>
#include <pounding/pushover/pushed_springs.hpp>
#include <pounding/pushover/static_yielding.hpp>

namespace pounding {
namespace {

using Eigen::VectorXd;

// Relative to the yield deformation: a corner that is reached, and a step over which a law is linear.
constexpr double reached = 1e-9, straight = 1e-8;
// Relative residual of the deformations: the target, and the value accepted if round-off prevents it.
constexpr double balanced = 1e-13, nearly_balanced = 1e-10;
// Fraction of the elastic rate below which the load does not rise.
constexpr double flat = 1e-6;
// Fraction of the whole path below which a step is not halved any further.
constexpr double shortest_step = 1e-10;

double sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

class Pusher {
 public:
  Pusher(const Structure& s, const PushOptions& options)
      : structure_(s),
        statics_(s, options.load, options.control, options.follow),
        springs_(s),
        yielding_(s.yielding.size(), 0),
        has_yielded_(s.yielding.size(), false),
        hit_(s.yielding.size(), false),
        slopes_(VectorXd::Zero(statics_.parts())),
        scales_(statics_.parts()) {
    for (Eigen::Index j = 0; j < scales_.size(); ++j)
      scales_[j] = deformation_scale(springs_[j].spring(), statics_.at_rest()[j]);
    for (const double target : options.targets) range_ = std::max(range_, std::abs(target));
    smooth_step_ = range_ / options.smooth_steps;
    elastic_rate_ = statics_.factor(1, VectorXd::Zero(statics_.parts()));
  }

  PushPath run(const std::vector<double>& targets) {
    rest();
    for (const double target : targets)
      while (path_.collapse.empty() && now_.displacement != target) advance(target);
    return std::move(path_);
  }

 private:
  // State under gravity, before the push. Laws without corners already soften slightly, which affects the displacement.
  void rest() {
    now_.deformations = statics_.at_rest();
    springs_.require_unyielded(now_.deformations);
    for (int iteration = 0; iteration < 100; ++iteration) {
      if (!solve(now_)) fail(0);
      const double less = now_.factor / elastic_rate_;
      if (std::abs(less) <= balanced * range_) break;
      now_.displacement -= less;
    }
    springs_.start(now_.deformations);
    path_.points.push_back(now_);
  }

  // A step towards a target: to the next corner, or a short one for smooth laws.
  void advance(double target) {
    const double way = sign(target - now_.displacement);
    const PushTangent tangent = tangent_at(statics_, springs_.all(), now_.deformations, way);
    if (!tangent.exists) return collapse("form a mechanism at constant displacement");
    tell_events(tangent, way);
    const double rise = std::abs(tangent.load_rate) > 1e-9 * elastic_rate_ ? way * tangent.load_rate : 0;
    double step = std::abs(target - now_.displacement);
    if (rise < 0) {
      const double left = -way * now_.factor / rise;
      if (left <= reached * range_) return collapse("leave no load-carrying capacity");
      step = std::min(step, left);
    }
    std::vector<double> corners(hit_.size(), std::numeric_limits<double>::infinity());
    for (Eigen::Index j = 0; j < tangent.rates.size(); ++j)
      corners[static_cast<std::size_t>(j)] = next_corner(j, tangent.rates[j], step);
    for (const double corner : corners) step = std::min(step, corner);

    PushPoint next;
    next.displacement = step == std::abs(target - now_.displacement) ? target : now_.displacement + way * step;
    next.deformations = now_.deformations + step * tangent.rates;
    const VectorXd expected = now_.forces + step * tangent.slopes.cwiseProduct(tangent.rates);
    const bool is_straight = (springs_.law(next.deformations).first - expected)
                                 .cwiseAbs()
                                 .cwiseQuotient(stiffnesses().cwiseProduct(scales_))
                                 .maxCoeff() <= straight;
    if (is_straight && solve(next)) {
      for (std::size_t j = 0; j < corners.size(); ++j)
        hit_[j] = corners[j] - step <= reached * scales_[static_cast<Eigen::Index>(j)] /
                                           std::abs(tangent.rates[static_cast<Eigen::Index>(j)]);
    } else {
      next = curved_step(tangent, way, std::min(step, smooth_step_));
      // A full step ends exactly on the target.
      if (std::abs(target - next.displacement) < shortest_step * range_ && (next.displacement = target, !solve(next)))
        fail(target);
      std::fill(hit_.begin(), hit_.end(), false);
    }
    slopes_ = tangent.slopes;
    keep(next);
  }

  VectorXd stiffnesses() const {
    VectorXd k(statics_.parts());
    for (Eigen::Index j = 0; j < k.size(); ++j)
      k[j] = std::max(springs_.stiffness(j), std::numeric_limits<double>::min());
    return k;
  }

  // True for a smooth law that has not reached its yield deformation.
  bool waits_for_yield(Eigen::Index j) const {
    return !has_yielded_[static_cast<std::size_t>(j)] && !springs_.has_corner(j) &&
           std::isfinite(springs_[j]->yield_deformation());
  }

  // Step to the next corner of a part, or to its first yield; at least the whole step if there is none.
  double next_corner(Eigen::Index j, double rate, double step) const {
    const double d = now_.deformations[j], near = reached * scales_[j];
    double found = std::numeric_limits<double>::infinity();
    if (rate == 0) return found;
    if (const std::optional<double> corner = springs_[j].corner(d + step * rate * (1 + reached));
        corner && std::abs(*corner - d) > near)
      found = (*corner - d) / rate;
    const double yields_at = sign(rate) * springs_[j]->yield_deformation();
    if (waits_for_yield(j) && (yields_at - d) * sign(rate) > near) found = std::min(found, (yields_at - d) / rate);
    return found;
  }

  // Newton's method for the deformations at the displacement of the point, starting from its deformations.
  bool solve(PushPoint& point) const {
    VectorXd d = point.deformations;
    double error = 0;
    for (int iteration = 0; iteration < 40; ++iteration) {
      const auto [forces, slopes] = springs_.law(d);
      const VectorXd rest = d - statics_.deformations(point.displacement, forces);
      error = rest.cwiseQuotient(scales_).cwiseAbs().maxCoeff() / (1 + d.cwiseQuotient(scales_).cwiseAbs().maxCoeff());
      if (!std::isfinite(error)) return false;
      if (error <= balanced || (iteration == 39 && error <= nearly_balanced)) {
        point.deformations = d;
        point.forces = forces;
        point.factor = statics_.factor(point.displacement, forces);
        point.followed = statics_.followed(point.displacement, forces);
        return true;
      }
      const Eigen::MatrixXd soft =
          scales_.cwiseInverse().asDiagonal() * statics_.flexibility() * slopes.cwiseProduct(scales_).asDiagonal();
      d -= scales_.cwiseProduct((Eigen::MatrixXd::Identity(soft.rows(), soft.cols()) + soft)
                                    .partialPivLu()
                                    .solve(rest.cwiseQuotient(scales_)));
    }
    return false;
  }

  // Maximum overshoot of a first yield, relative to the yield deformation.
  double beyond_yield(const PushPoint& point) const {
    double farthest = -1;
    for (Eigen::Index j = 0; j < scales_.size(); ++j)
      if (waits_for_yield(j))
        if (const double at = std::abs(now_.deformations[j]) / scales_[j] - 1; at < -reached)
          farthest = std::max(farthest, std::abs(point.deformations[j]) / scales_[j] - 1);
    return farthest;
  }

  // A Newton step, shortened if no equilibrium is found, and ending at the first yield of a part within it.
  PushPoint curved_step(const PushTangent& tangent, double way, double step) const {
    const auto at = [&](double part) {
      PushPoint point;
      point.displacement = now_.displacement + way * part;
      point.deformations = now_.deformations + part * tangent.rates;
      return std::pair(solve(point), point);
    };
    auto [found, point] = at(step);
    for (; !found; std::tie(found, point) = at(step /= 2))
      if (step < shortest_step * range_) fail(now_.displacement);
    double low = 0, high = step, low_value = beyond_yield(now_), high_value = beyond_yield(point);
    for (int i = 0; i < 100 && high_value > reached; ++i) {
      // Regula falsi, alternating with bisection.
      const double part = i % 2 == 0 ? low - low_value * (high - low) / (high_value - low_value) : 0.5 * (low + high);
      const auto [inside, between] = at(part);
      if (!inside) fail(now_.displacement);
      const double value = beyond_yield(between);
      if (value > -reached)
        high = part, high_value = value, point = between;
      else
        low = part, low_value = value;
    }
    return point;
  }

  void keep(const PushPoint& next) {
    springs_.follow(now_.deformations, next.deformations);
    now_ = next;
    path_.points.push_back(next);
  }

  // Records the events of the last point, from the direction of each part in the tangent there.
  void tell_events(const PushTangent& tangent, double way) {
    const double largest = tangent.rates.cwiseQuotient(scales_).cwiseAbs().maxCoeff();
    bool some_yield = false;
    const int point = static_cast<int>(path_.points.size()) - 1;
    for (std::size_t i = 0; i < hit_.size(); ++i) {
      const auto j = static_cast<Eigen::Index>(i);
      const double d = now_.deformations[j], k = springs_[j]->stiffness(), whole = springs_.stiffness(j),
                   side = sign(tangent.rates[j]);
      if (std::abs(tangent.rates[j]) <= 1e-10 * largest * scales_[j]) continue;
      const auto tell = [&](PushEvent::Kind kind, bool is_first = false) {
        path_.events.push_back({.point = point, .part = static_cast<int>(i), .kind = kind, .is_first = is_first});
        yielding_[i] = kind == PushEvent::Kind::yields ? static_cast<int>(side) : 0;
        some_yield |= kind == PushEvent::Kind::yields;
      };
      const bool falls = hit_[i] && slopes_[j] - tangent.slopes[j] > 1e-9 * whole &&
                         (k * d + now_.forces[j]) * side > 1e-6 * whole * scales_[j];
      if (yielding_[i] == -static_cast<int>(side)) {
        tell(PushEvent::Kind::unloads);
      } else if (!has_yielded_[i] && (falls || waits_for_yield(j)) &&
                 side * d >= springs_[j]->yield_deformation() * (1 - 10 * reached)) {
        has_yielded_[i] = true;
        tell(PushEvent::Kind::yields, true);
      } else if (falls && yielding_[i] == 0) {
        tell(has_yielded_[i] ? PushEvent::Kind::yields : PushEvent::Kind::softens);
      }
    }
    if (some_yield && !path_.mechanism) look_for_mechanism(way);
  }

  std::vector<int> yielding_parts() const {
    std::vector<int> parts;
    for (std::size_t i = 0; i < yielding_.size(); ++i)
      if (yielding_[i] != 0) parts.push_back(static_cast<int>(i));
    return parts;
  }

  // Tests whether the load would rise if the yielding parts had no hardening.
  void look_for_mechanism(double way) {
    VectorXd plastic(scales_.size());
    for (Eigen::Index j = 0; j < plastic.size(); ++j) plastic[j] = springs_[j]->first_slope();
    for (const int part : yielding_parts()) plastic[part] = -springs_[part]->stiffness();
    const PushTangent tangent = rates_of(statics_, scales_, plastic, way);
    if (tangent.exists && way * tangent.load_rate > flat * elastic_rate_) return;
    path_.mechanism = static_cast<int>(path_.points.size()) - 1;
    path_.mechanism_parts = yielding_parts();
  }

  void collapse(const char* what) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < hit_.size(); ++i)
      if (yielding_[i] != 0 || hit_[i]) names.push_back(structure_.yielding[i].name);
    path_.collapse = fmt::format("at {:.6g} mm: the parts that yield ({}) {}", 1e3 * now_.displacement,
                                 fmt::join(names, ", "), what);
  }

  [[noreturn]] static void fail(double displacement) {
    throw SolverError(fmt::format("no equilibrium was found beyond {:.6g} mm", 1e3 * displacement));
  }

  const Structure& structure_;
  StaticYielding statics_;
  PushedSprings springs_;
  std::vector<int> yielding_;            // yield direction; 0: not yielding
  std::vector<bool> has_yielded_, hit_;  // hit_: the last step ended at a corner of this part
  VectorXd slopes_, scales_;             // slopes_: along the last step
  double range_ = 0, smooth_step_ = 0, elastic_rate_ = 0;
  PushPoint now_;
  PushPath path_;
};

}  // namespace

PushPath push(const Structure& structure, const PushOptions& options) {
  if (structure.yielding.empty()) throw std::invalid_argument("it has no yielding parts");
  if (structure.elastic)
    throw std::invalid_argument("large rotations are not supported; remove geometry: corotational");
  for (const YieldingPart& part : structure.yielding)
    if (!part.has_spring())
      throw std::invalid_argument(part.name +
                                  " couples two directions, which a pushover does not support; type coupled: false "
                                  "under isolator");
  return Pusher(structure, options).run(options.targets);
}

}  // namespace pounding
