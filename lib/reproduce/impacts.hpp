#pragma once
/// Impacts as the program runs them through PETSc TS, and the words of the tables.

#include <string>
#include <string_view>
#include <vector>

#include <pounding/run/run.hpp>
#include <pounding/laws/all.hpp>
#include <pounding/laws/integrated_impact.hpp>
#include <pounding/results/results.hpp>

namespace pounding::reproduce {

/// A law as a user asks for it.
struct Asking {
  std::string law, formula;   ///< formula empty: none, or `exact`
  double stiffness = 0;       ///< [N/m^n]
  double restitution = 1;     ///< asked; not used by laws without damping

  /// As it is given to a link: what a law must have, at its typical values but for the stiffness.
  laws::Settings settings() const;
  laws::AnyLaw made(double reduced_mass) const;
  /// What it gives two free bodies, without a run [kg], [m/s].
  laws::FreeImpact free_impact(double reduced_mass, double speed) const;
};

/// One contact of two free bodies, thinned to what a drawing shows.
struct Loop {
  std::vector<double> time, penetration, velocity, force;  ///< [s] since the touch, [m], [m/s], [N]
  ImpactRow impact;
};

/// A body of this mass [kg] thrown at a wall [m/s]; the mass is the reduced one of two bodies, which move alike. Throws SolverError
/// unless there is exactly one impact.
Loop collide(const laws::Settings& law, double mass, double speed);

/// A part of a link's history around an impact, thinned to about `points`, time from the touch.
Loop loop_of(const LinkHistory& link, const ImpactRow& impact, int points = 240);

/// 100 (obtained - asked)/asked.
inline double percent(double obtained, double asked) { return 100 * (obtained - asked) / asked; }
/// The kinetic energy that a restitution e loses, the paper's Eq. 18 [J].
inline double kinetic_loss(double mass, double speed, double e) { return 0.5 * mass * (1 - e * e) * speed * speed; }

std::vector<double> scaled(std::vector<double> values, double factor);

}  // namespace pounding::reproduce
