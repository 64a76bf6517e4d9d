#include <pounding/structures/bar_and_damper.hpp>

#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace pounding {
namespace {

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

// Gauss-Legendre points in [0, 1] and their weights: exact for a linear damper in the motion that interpolate() gives.
constexpr std::array<double, 5> gauss_points{0.046910077030668, 0.230765344947158453, 0.5, 0.769234655052841547, 0.953089922969332};
constexpr std::array<double, 5> gauss_weights{0.118463442528094544, 0.239314335249683234, 0.284444444444444444, 0.239314335249683234,
                                              0.118463442528094544};

}  // namespace

void Bar::check() const {
  if (!is_positive(stiffness)) throw std::invalid_argument("the stiffness of a bar must be positive and finite");
}

double Damper::force(double rate) const noexcept {
  if (is_linear()) return coefficient * rate;
  return coefficient * rate * std::pow(rate * rate + rounding_velocity * rounding_velocity, 0.5 * (exponent - 1));
}

double Damper::slope(double rate) const noexcept {
  if (is_linear()) return coefficient;
  const double v2 = rate * rate, s = v2 + rounding_velocity * rounding_velocity;
  return coefficient * std::pow(s, 0.5 * (exponent - 1)) * (1 + (exponent - 1) * v2 / s);
}

void Damper::check() const {
  if (!is_positive(coefficient)) throw std::invalid_argument("the coefficient of a damper must be positive and finite");
  if (!(exponent >= least_exponent && exponent <= largest_exponent))
    throw std::invalid_argument(fmt::format("the exponent of a damper lies in [{:g}, {:g}]; {:g} was given", least_exponent,
                                            largest_exponent, exponent));
  if (!is_positive(rounding_velocity)) throw std::invalid_argument("the rounding_velocity of a damper must be positive and finite");
}

BarAndDamper::BarAndDamper(std::optional<Bar> bar, std::optional<Damper> damper) : bar_(bar), damper_(damper) {
  if (!bar_ && !damper_) throw std::invalid_argument("a device needs a bar, a damper or both");
  if (bar_) bar_->check();
  if (damper_) damper_->check();
}

laws::Response BarAndDamper::evaluate(const LinkMotion& motion) const noexcept {
  laws::Response response;
  if (bar_) {
    response.force = bar_->force(motion.penetration);
    response.by_penetration = bar_->stiffness;
  }
  if (damper_) {
    response.force += damper_->force(motion.rate);
    response.by_rate = damper_->slope(motion.rate);
  }
  return response;
}

void BarAndDamper::accept(const LinkStep& step) {
  elongation_ = step.motion_end.penetration;
  if (!damper_) return;
  double power = 0;
  for (std::size_t i = 0; i < gauss_points.size(); ++i) {
    const double rate = interpolate(step, gauss_points[i]).rate;
    power += gauss_weights[i] * damper_->force(rate) * rate;
  }
  damped_ += (step.end - step.begin) * power;
}

double BarAndDamper::stored_correction() const noexcept { return bar_ ? 0.5 * bar_->stiffness * elongation_ * elongation_ : 0; }

void BarAndDamper::archive(Archive& archive) {
  archive(elongation_);
  archive(damped_);
}

}  // namespace pounding
