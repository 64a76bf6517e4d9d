#include <pounding/structures/bilinear_spring.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pounding {

BilinearSpring::BilinearSpring(const Parameters& p)
    : parameters_(p), yielding_((1 - p.hardening) * p.stiffness), yield_point_(p.yield_force / p.stiffness) {
  if (!(p.stiffness > 0) || std::isinf(p.stiffness)) throw std::invalid_argument("stiffness must be positive and finite");
  if (!(p.yield_force > 0) || std::isinf(p.yield_force))
    throw std::invalid_argument("yield_force must be positive and finite");
  if (!(p.hardening >= 0 && p.hardening < 1)) throw std::invalid_argument("hardening must lie in [0, 1)");
}

laws::Response BilinearSpring::evaluate(const LinkMotion& motion) const noexcept {
  const double u = motion.penetration, stretch = u - slip_;
  if (std::abs(stretch) <= yield_point_) return {-yielding_ * slip_, 0, 0};
  return {yielding_ * (std::copysign(yield_point_, stretch) - u), -yielding_, 0};
}

std::optional<double> BilinearSpring::corner(double deformation) const noexcept {
  const double yields_at = slip_ + std::copysign(yield_point_, deformation - deformation_);
  const bool is_between = deformation > deformation_ ? yields_at > deformation_ && yields_at < deformation
                                                     : yields_at < deformation_ && yields_at > deformation;
  return is_between ? std::optional(yields_at) : std::nullopt;
}

void BilinearSpring::accept(const LinkStep& step) {
  if (step.motion_begin.rate * step.motion_end.rate < 0) {
    const CubicPenetration between(step.motion_begin, step.motion_end, step.end - step.begin);
    const double s = between.turn();
    if (s > 0 && s < 1) follow(between.at(s));
  }
  follow(step.motion_end.penetration);
}

// The work of the yielding part on its slip is lost.
void BilinearSpring::follow(double deformation) {
  const double slip = std::clamp(slip_, deformation - yield_point_, deformation + yield_point_);
  lost_ += yielding_ * yield_point_ * std::abs(slip - slip_);
  slip_ = slip;
  deformation_ = deformation;
}

// (1 - a) k/2 ((u - s)^2 - u^2).
double BilinearSpring::stored_correction() const noexcept { return yielding_ * slip_ * (0.5 * slip_ - deformation_); }

void BilinearSpring::archive(Archive& archive) {
  archive(slip_);
  archive(deformation_);
  archive(lost_);
}

}  // namespace pounding
