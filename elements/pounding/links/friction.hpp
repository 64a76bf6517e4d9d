#pragma once
/// Friction along a closed contact: force and slopes.

#include <algorithm>
#include <array>
#include <cmath>

#include <pounding/laws/law.hpp>
#include <pounding/links/contact.hpp>

namespace pounding {

/// Coulomb friction of one contact with the force F_n, along the columns `first` .. `first + count - 1` of B.
///
/// Without a tangential stiffness it is regularised: F_t = coefficient max(F_n, 0) v_t / sqrt(|v_t|^2 + sliding^2),
/// with the sliding velocities v_t. With one, it is a slider in series with a spring k_t: F_t = k_t e, |F_t| <= mu F_n,
/// de/dt = v_t - dp/dt with the slip p. The slider sticks below the limit and slips along F_t at it. Then
///
///   mu = coefficient + (static_coefficient - coefficient) exp(-|v_t| / stribeck).
///
/// k_t is constant, or proportional to the slope of the law in slow first loading. While such a k_t grows, the new
/// contact area is unstrained, dF_t = k_t du; while it decreases, e is kept. Both lose energy and never create any:
/// Thornton, Cummins & Cleary 2011, Powder Technology 210:189.
struct Friction {
  int contact = 0;              ///< link whose force is F_n
  int first = 0, count = 1;     ///< columns of B: one in a plane model, two in space
  double coefficient = 0;       ///< Coulomb friction coefficient [-]
  double sliding = 0;           ///< velocity at which the regularised force is 0.71 of coefficient * F_n [m/s]
  double static_coefficient{};  ///< at rest [-]; 0: like `coefficient`
  double stribeck = 0;          ///< velocity over which the coefficient decays [m/s]
  double stiffness = 0;         ///< constant k_t [N/m]; 0: none
  double ratio = 0;             ///< of k_t to the slope of the law [-]; 0: none

  /// True if there is a tangential stiffness.
  bool is_compliant() const noexcept { return stiffness > 0 || ratio > 0; }
  /// mu at a sliding speed [m/s].
  double limit(double speed) const noexcept {
    return static_coefficient > 0 ? coefficient + (static_coefficient - coefficient) * std::exp(-speed / stribeck)
                                  : coefficient;
  }
  /// d mu/d speed [s/m].
  double limit_slope(double speed) const noexcept {
    return static_coefficient > 0 ? -(static_coefficient - coefficient) / stribeck * std::exp(-speed / stribeck) : 0;
  }
};

/// Vector in the plane of a contact; the second component is zero if sliding has a single direction.
using Sliding = std::array<double, 2>;

/// Motion along a contact. In a stage of a step the slip is `slip` + `lag` times its present rate; at instants the lag
/// is zero.
struct TangentialMotion {
  Sliding displacement{}, rate{};  ///< of the left end relative to the right one [m], [m/s]
  Sliding slip{};                  ///< p [m]; only with a tangential stiffness
  double lag = 0;                  ///< [s]

  /// Sets one direction.
  void set(int direction, const LinkMotion& motion) noexcept {
    displacement[direction] = motion.penetration;
    rate[direction] = motion.rate;
    slip[direction] = motion.slip;
    lag = motion.lag;
  }
};

/// Friction force and its slopes.
struct FrictionForce {
  Sliding force{};                           ///< [N]
  Sliding by_penetration{};                  ///< slope by the penetration of the contact [N/m]
  Sliding by_rate{};                         ///< slope by the rate of the contact [N s/m]
  std::array<Sliding, 2> by_sliding{};       ///< [i][j]: slope of component i by sliding velocity j [N s/m]
  std::array<Sliding, 2> by_displacement{};  ///< [i][j]: slope of component i by displacement j [N/m]
  Sliding slip_rate{};                       ///< dp/dt; zero if the lag is [m/s]
  bool slips = false;                        ///< at the limit, with a tangential stiffness
};

/// Regularised Coulomb force for the response of a contact and its sliding velocities v_t [m/s]; zero for a contact in
/// tension.
inline FrictionForce friction_force(const Friction& friction, const laws::Response& contact,
                                    const Sliding& rates) noexcept {
  FrictionForce f;
  if (!(contact.force > 0)) return f;
  const double size = std::sqrt(rates[0] * rates[0] + rates[1] * rates[1] + friction.sliding * friction.sliding);
  const Sliding direction{rates[0] / size, rates[1] / size};
  for (int i = 0; i < 2; ++i) {
    f.force[i] = friction.coefficient * contact.force * direction[i];
    f.by_penetration[i] = friction.coefficient * contact.by_penetration * direction[i];
    f.by_rate[i] = friction.coefficient * contact.by_rate * direction[i];
    for (int j = 0; j < 2; ++j)
      f.by_sliding[i][j] =
          friction.coefficient * contact.force / size * ((i == j ? 1 : 0) - direction[i] * direction[j]);
  }
  return f;
}

/// Tangential stiffness k_t of a closed contact and its growth.
struct TangentialStiffness {
  double value = 0;                  ///< k_t [N/m]
  double growth = 0;                 ///< max(dk_t/dt, 0) / k_t [1/s]
  double slope = 0;                  ///< dk_t/d penetration [N/m^2]
  double growth_by_penetration = 0;  ///< [1/(m s)]
  double growth_by_rate = 0;         ///< [1/m]
};

/// k_t at a motion of the contact. Its derivatives are central differences of the slope of the law.
inline TangentialStiffness tangential_stiffness(const Friction& friction, const Contact& contact,
                                                const LinkMotion& at) noexcept {
  if (friction.ratio == 0) return {.value = friction.stiffness};
  constexpr double part = 1e-4;  // of the penetration: truncation and round-off below 1e-8
  const double d = at.penetration, step = part * d;
  if (!(d > 0)) return {};
  const auto slope_at = [&](double x) { return friction.ratio * contact.first_loading(x).by_penetration; };
  const double below = slope_at(d - step), here = slope_at(d), above = slope_at(d + step);
  if (!(here > 0)) return {};
  TangentialStiffness k{.value = here, .slope = (above - below) / (2 * step)};
  if (!(k.slope * at.rate > 0)) return k;
  const double bend = (above - 2 * here + below) / (step * step);
  k.growth = k.slope * at.rate / here;
  k.growth_by_rate = k.slope / here;
  k.growth_by_penetration = at.rate * (bend - k.slope * k.slope / here) / here;
  return k;
}

/// Force of the slider in series with k_t, in closed form for the implicit slip of a stage. `contact`: response of the
/// contact, which may not pull.
inline FrictionForce stick_slip_force(const Friction& friction, const laws::Response& contact,
                                      const TangentialStiffness& k, const TangentialMotion& at) noexcept {
  FrictionForce f;
  const Sliding stretch{at.displacement[0] - at.slip[0], at.displacement[1] - at.slip[1]};
  const double size = std::hypot(stretch[0], stretch[1]);
  const double per_lag = at.lag > 0 ? 1 / at.lag : 0;
  if (!(contact.force > 0) || !(k.value > 0)) {
    f.slip_rate = {per_lag * stretch[0], per_lag * stretch[1]};
    return f;
  }
  const double speed = std::hypot(at.rate[0], at.rate[1]), mu = friction.limit(speed);
  const double grown = 1 + at.lag * k.growth, stuck = k.value / grown;
  f.slips = stuck * size > mu * contact.force;
  if (!f.slips) {
    const double by_penetration = (k.slope - stuck * at.lag * k.growth_by_penetration) / grown;
    const double by_rate = -stuck * at.lag * k.growth_by_rate / grown;
    for (int i = 0; i < 2; ++i) {
      f.force[i] = stuck * stretch[i];
      f.slip_rate[i] = k.growth * stretch[i] / grown;
      f.by_displacement[i][i] = stuck;
      f.by_penetration[i] = by_penetration * stretch[i];
      f.by_rate[i] = by_rate * stretch[i];
    }
    return f;
  }
  const Sliding direction{stretch[0] / size, stretch[1] / size};
  const double limit = mu * contact.force, limit_slope = speed > 0 ? friction.limit_slope(speed) / speed : 0;
  for (int i = 0; i < 2; ++i) {
    f.force[i] = limit * direction[i];
    f.slip_rate[i] = per_lag * (stretch[i] - f.force[i] / k.value);
    f.by_penetration[i] = mu * contact.by_penetration * direction[i];
    f.by_rate[i] = mu * contact.by_rate * direction[i];
    for (int j = 0; j < 2; ++j) {
      f.by_displacement[i][j] = limit / size * ((i == j ? 1 : 0) - direction[i] * direction[j]);
      f.by_sliding[i][j] = contact.force * limit_slope * at.rate[j] * direction[i];
    }
  }
  return f;
}

/// Friction of a contact at this motion and response.
inline FrictionForce friction_force(const Friction& friction, const Contact& contact, const LinkMotion& normal,
                                    const laws::Response& response, const TangentialMotion& along) noexcept {
  if (!friction.is_compliant()) return friction_force(friction, response, along.rate);
  return stick_slip_force(friction, response, tangential_stiffness(friction, contact, normal), along);
}

/// Energy stored in the tangential spring at the force F_t [J].
inline double stored_energy(const Friction& friction, const Contact& contact, const LinkMotion& normal,
                            const Sliding& force) noexcept {
  const double k = friction.is_compliant() ? tangential_stiffness(friction, contact, normal).value : 0;
  return k > 0 ? 0.5 * (force[0] * force[0] + force[1] * force[1]) / k : 0;
}

}  // namespace pounding
