#pragma once
/// Closed forms of free impacts. `closed_form` of the result marks the known values; the others are zero. Mass [kg],
/// closing speed v [m/s].

#include <cmath>
#include <limits>
#include <numbers>

#include <pounding/laws/bilinear_hertz.hpp>
#include <pounding/laws/elastoplastic.hpp>
#include <pounding/laws/exact_damping.hpp>
#include <pounding/laws/hertz.hpp>
#include <pounding/laws/hertz_damped.hpp>
#include <pounding/laws/integrated_impact.hpp>
#include <pounding/laws/jankowski.hpp>
#include <pounding/laws/kelvin_voigt.hpp>
#include <pounding/laws/kelvin_voigt_no_tension.hpp>
#include <pounding/laws/komodromos.hpp>
#include <pounding/laws/linear_spring.hpp>
#include <pounding/laws/modified_kelvin.hpp>
#include <pounding/laws/modified_linear_viscoelastic.hpp>
#include <pounding/laws/stereomechanical.hpp>
#include <pounding/laws/viscous_hertz.hpp>

namespace pounding::laws {

/// Sets energy and impulse, which follow from the restitution in every free impact.
inline FreeImpact with_momentum(FreeImpact r, double m, double v) noexcept {
  r.energy_lost = 0.5 * m * v * v * (1 - r.restitution) * (1 + r.restitution);
  r.impulse = m * v * (1 + r.restitution);
  return r;
}

/// F = k d^n, p = n + 1: d_max = [p m v^2/(2k)]^(1/p), T = 2 (d_max/v) sqrt(pi) Gamma(1+1/p)/Gamma(1/2+1/p).
inline FreeImpact elastic_impact(double k, double n, double m, double v) {
  const double p = n + 1, d = std::pow(p * m * v * v / (2 * k), 1 / p);
  const double half = d / v * std::sqrt(std::numbers::pi) * std::tgamma(1 + 1 / p) / std::tgamma(0.5 + 1 / p);
  return with_momentum({.restitution = 1,
                        .peak_force = k * std::pow(d, n),
                        .time_of_peak = half,
                        .peak_penetration = d,
                        .duration = 2 * half,
                        .closed_form = {true, true, true, true, true}},
                       m, v);
}

/// Linear spring and dashpot with damping ratio z up to the maximum penetration; the caller sets restitution and
/// duration.
inline FreeImpact oscillator_approach(double k, double z, double m, double v) {
  const double w = std::sqrt(k / m), angle = angle_ratio(z);
  FreeImpact r{.peak_force = 2 * z * m * w * v,
               .peak_penetration = v / w * std::exp(-z * angle),
               .closed_form = {true, true, true, true, true}};
  if (z < 0.5) {  // otherwise the jump at the touch is the peak force
    const double phase = 3 * angle - std::numbers::pi / std::sqrt((1 - z) * (1 + z));
    r.peak_force = m * w * v * std::exp(-z * phase);
    r.time_of_peak = phase / w;
  }
  return r;
}

/// Laws without a closed form, and user-defined laws: no value is known.
template <class L>
FreeImpact closed_impact(const L&, double, double) {
  return {};
}

inline FreeImpact closed_impact(const LinearSpring& law, double m, double v) {
  return elastic_impact(law.stiffness, 1, m, v);
}

inline FreeImpact closed_impact(const Hertz& law, double m, double v) {
  return elastic_impact(law.stiffness, law.exponent, m, v);
}

/// For zeta >= 1 the bodies never separate: restitution 0, infinite duration.
inline FreeImpact closed_impact(const KelvinVoigt& law, double m, double v) {
  const double k = law.stiffness, z = law.damping_for(v) / (2 * std::sqrt(k * m));
  FreeImpact r = oscillator_approach(k, z, m, v);
  r.restitution = restitution_to_zero_penetration(z);
  r.duration =
      z < 1 ? std::numbers::pi / std::sqrt(k / m * (1 - z) * (1 + z)) : std::numeric_limits<double>::infinity();
  return with_momentum(r, m, v);
}

/// Linear spring k and dashpot c whose force is cut off at zero.
inline FreeImpact cut_oscillator_impact(double k, double c, double m, double v) {
  const double z = c / (2 * std::sqrt(k * m));
  FreeImpact r = oscillator_approach(k, z, m, v);
  r.restitution = restitution_to_zero_force(z);
  r.duration = 2 * angle_ratio(z) * std::sqrt(m / k);
  return with_momentum(r, m, v);
}

inline FreeImpact closed_impact(const KelvinVoigtNoTension& law, double m, double v) {
  return cut_oscillator_impact(law.stiffness, law.damping_for(v), m, v);
}

inline FreeImpact closed_impact(const Komodromos& law, double m, double v) {
  return cut_oscillator_impact(law.stiffness, law.damping_for(v), m, v);
}

inline FreeImpact closed_impact(const ModifiedLinearViscoelastic& law, double m, double v) {
  const double k = law.stiffness, z = law.damping_for(v) / (2 * std::sqrt(k * m));
  FreeImpact r = oscillator_approach(k, z, m, v);
  r.restitution = restitution_of_approach(z);
  r.duration = (angle_ratio(z) + std::numbers::pi / 2) * std::sqrt(m / k);
  return with_momentum(r, m, v);
}

/// F = k d^n (1 + a d'/v): restitution, maximum penetration and peak force by separation of variables.
inline FreeImpact proportional_impact(double k, double n, double zeta, double m, double v) {
  const double a = zeta * v / k;
  if (!(a > 0)) return elastic_impact(k, n, m, v);
  const double excess = log_excess(a), scale = m * (n + 1) * v * v / (k * a * a);
  const auto rise = [&](double u) { return u * n / (n + 1) + log_excess(u) - excess; };  // zero at the peak force
  const double u = find_root(rise, 0, -excess, a, rise(a));
  return with_momentum({.restitution = restitution_of_factor(a),
                        .peak_force = k * std::pow(scale * n * u / (n + 1), n / (n + 1)) * (1 + u),
                        .peak_penetration = std::pow(scale * excess, 1 / (n + 1)),
                        .closed_form = {.restitution = true, .peak_force = true, .peak_penetration = true}},
                       m, v);
}

inline FreeImpact closed_impact(const HertzDamped& law, double m, double v) {
  return proportional_impact(law.stiffness, law.exponent, law.damping_for(v), m, v);
}

inline FreeImpact closed_impact(const ModifiedKelvin& law, double m, double v) {
  return proportional_impact(law.stiffness, 1, law.damping_for(v), m, v);
}

inline FreeImpact closed_impact(const Jankowski& law, double m, double v) {
  const double k = law.stiffness, z = law.damping_for(v) / std::sqrt(5 * k * m);
  const double e = restitution_of_approach(z);
  return with_momentum({.restitution = e,
                        .peak_penetration = std::pow(5 * m * e * v * e * v / (4 * k), 0.4),
                        .closed_form = {.restitution = true, .peak_penetration = true}},
                       m, v);
}

inline FreeImpact closed_impact(const ViscousHertz& law, double m, double v) {
  const double k = law.stiffness, p = law.exponent + 1, z = law.damping_for(v) / std::sqrt(2 * p * k * m);
  const double top = v * restitution_of_approach(z);
  return with_momentum({.restitution = restitution_to_zero_force(z),
                        .peak_penetration = std::pow(p * m * top * top / (2 * k), 1 / p),
                        .closed_form = {.restitution = true, .peak_penetration = true}},
                       m, v);
}

inline FreeImpact closed_impact(const BilinearHertz& law, double m, double v) {
  const auto [k1, k2, yield] = law.curve(touch(law, v));
  const double energy = 0.5 * m * v * v, left = energy - 0.5 * k1 * yield * yield;
  if (left <= 0) return elastic_impact(k1, 1, m, v);
  const double q = 2 * left / (k1 * yield + std::sqrt(k1 * k1 * yield * yield + 2 * k2 * left));
  return with_momentum({.restitution = std::sqrt(1 - (k1 - k2) * yield * q / energy),
                        .peak_force = k1 * yield + k2 * q,
                        .peak_penetration = yield + q,
                        .closed_form = {.restitution = true, .peak_force = true, .peak_penetration = true}},
                       m, v);
}

/// On undamaged surfaces. Unloading is the elastic impact at e v to a depth of e^2 d_m, and lasts e times as long as
/// loading.
inline FreeImpact closed_impact(const Elastoplastic& law, double m, double v) {
  FreeImpact r = elastic_impact(law.stiffness, law.exponent, m, v);
  r.restitution = std::sqrt(1 - law.damping_for(v));
  r.duration = r.time_of_peak * (1 + r.restitution);
  return with_momentum(r, m, v);
}

/// Infinite force of zero duration.
inline FreeImpact closed_impact(const Stereomechanical& law, double m, double v) {
  return with_momentum({.restitution = law.restitution,
                        .peak_force = std::numeric_limits<double>::infinity(),
                        .closed_form = {true, true, true, true, true}},
                       m, v);
}

}  // namespace pounding::laws
