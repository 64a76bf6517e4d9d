#include <pounding/pushover/pushed_springs.hpp>

#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace pounding {
namespace {

// Number of yield deformations within which a law with corners has one.
constexpr double far = 1e3;

}  // namespace

PushedSprings::PushedSprings(const Structure& s) : structure_(s) {
  for (const YieldingPart& part : s.yielding) {
    const double way = far * part.yield_deformation();
    const LoadedSpring& spring = springs_.emplace_back(part.spring());
    has_corner_.push_back(std::isfinite(way) && (spring.corner(way) || spring.corner(-way)));
  }
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> PushedSprings::law(const Eigen::VectorXd& deformations) const {
  std::pair<Eigen::VectorXd, Eigen::VectorXd> response{deformations, deformations};
  for (Eigen::Index j = 0; j < deformations.size(); ++j) {
    const laws::Response r = (*this)[j].evaluate_slowly(deformations[j]);
    response.first[j] = r.force, response.second[j] = r.by_penetration;
  }
  return response;
}

void PushedSprings::follow(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  for (Eigen::Index j = 0; j < from.size(); ++j) {
    const auto motion = [&](double s) { return LinkMotion{from[j] + s * (to[j] - from[j]), to[j] - from[j]}; };
    LinkStep step{
        .begin = 0, .end = 1, .motion_begin = motion(0), .motion_middle = motion(0.5), .motion_end = motion(1)};
    step.force_begin = (*this)[j].evaluate_slowly(step.motion_begin.penetration).force;
    step.force_middle = (*this)[j].evaluate_slowly(step.motion_middle.penetration).force;
    step.force_end = (*this)[j].evaluate_slowly(step.motion_end.penetration).force;
    (*this)[j].accept(step);
  }
}

void PushedSprings::require_unyielded(const Eigen::VectorXd& deformations) const {
  for (Eigen::Index j = 0; j < deformations.size(); ++j) {
    const double at = deformations[j], yield = (*this)[j]->yield_deformation();
    const std::optional<double> corner = (*this)[j].corner(at);
    if (std::abs(at) >= yield && (!has_corner(j) || corner))
      throw std::invalid_argument(fmt::format(
          "{} yields under gravity alone: {:.4g} of its yield deformation; make it stronger",
          structure_.yielding[static_cast<std::size_t>(j)].name, at / corner.value_or(std::copysign(yield, at))));
  }
}

void PushedSprings::start(const Eigen::VectorXd& deformations) {
  for (Eigen::Index j = 0; j < deformations.size(); ++j) (*this)[j].start({deformations[j], 0});
  follow(Eigen::VectorXd::Zero(deformations.size()), deformations);
}

}  // namespace pounding
