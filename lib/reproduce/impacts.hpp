#pragma once
/// Impacts for the items of the paper, integrated in time by the program.

#include <string>
#include <vector>

#include <pounding/laws/compiled.hpp>
#include <pounding/results/results.hpp>
#include <pounding/run/run.hpp>

namespace pounding::reproduce {

/// A law as a user specifies it.
struct Asking {
  std::string law, formula;  ///< formula empty: none, or `exact`
  double stiffness = 0;      ///< [N/m^n]
  double restitution = 1;    ///< target; not used by laws without damping

  /// For a link: the required parameters of the law, at typical values except for the stiffness.
  laws::Settings settings() const;
  laws::AnyLaw made(double reduced_mass) const;
  /// Impact of two free bodies without time integration: reduced mass [kg], approach velocity [m/s].
  laws::FreeImpact free_impact(double reduced_mass, double speed) const;
};

/// Hysteresis loop of one impact of two free bodies, thinned for plotting.
struct Loop {
  std::vector<double> time, penetration, velocity, force;  ///< [s] since the touch, [m], [m/s], [N]
  ImpactRow impact;
};

/// Impact of a body of this mass [kg] on a wall at this speed [m/s]; two bodies of this reduced mass are equivalent.
/// Throws SolverError unless there is exactly one impact.
Loop collide(const laws::Settings& law, double mass, double speed);

/// Loop of one impact from the history of its link, thinned to about `points`; time starts at the touch.
Loop loop_of(const LinkHistory& link, const ImpactRow& impact, int points = 240);

/// 100 (obtained - target)/target.
inline double percent(double obtained, double requested) { return 100 * (obtained - requested) / requested; }
/// Kinetic energy lost with a restitution e, Eq. 18 of the paper [J].
inline double kinetic_loss(double mass, double speed, double e) { return 0.5 * mass * (1 - e * e) * speed * speed; }

std::vector<double> scaled(std::vector<double> values, double factor);

}  // namespace pounding::reproduce
