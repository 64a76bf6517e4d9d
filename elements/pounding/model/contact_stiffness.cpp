#include <pounding/model/contact_stiffness.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding {
namespace {

constexpr double of_hertz = 1.5;

template <class... F>
struct Each : F... {
  using F::operator()...;
};
template <class... F>
Each(F...) -> Each<F...>;

double positive(double value, std::string_view name) {
  laws::require_positive(name, value);
  return value;
}

// Curvature at the contact, 1/R; zero for a flat body.
double curvature(double radius) {
  if (!(radius > 0)) throw std::invalid_argument("a radius must be positive");
  return 1 / radius;
}

double radius_of_ball(double mass, double density) { return std::cbrt(3 * mass / (4 * std::numbers::pi * density)); }

double hertz(double curvatures, const ContactMaterial& material) {
  if (!(curvatures > 0))
    throw std::invalid_argument("Hertz stiffness is undefined for two flat bodies; give one of them a radius");
  positive(material.young, "E");
  if (!(material.poisson >= 0 && material.poisson <= 0.5)) throw std::invalid_argument("poisson must lie in [0, 0.5]");
  const double modulus = material.young / (2 * (1 - material.poisson * material.poisson));
  return 4.0 / 3 * modulus / std::sqrt(curvatures);
}

// Stiffness k of k d^n with the penetration d in an elastic impact: m v^2/2 = k d^(n+1)/(n+1).
double with_penetration(double penetration, double exponent, double mass, double speed) {
  return (exponent + 1) * mass * speed * speed / (2 * std::pow(penetration, exponent + 1));
}

double with_exponent(double stiffness, double own, double wanted, double mass) {
  if (own == wanted) return stiffness;
  const double energy = 0.5 * mass * estimate_speed * estimate_speed;
  const double penetration = std::pow((own + 1) * energy / stiffness, 1 / (own + 1));
  return with_penetration(penetration, wanted, mass, estimate_speed);
}

double of_slabs(const StiffnessOfSlabs& slabs) {
  positive(slabs.young, "E");
  double flexibility = 0;
  for (int i = 0; i < 2; ++i) {
    if (!(slabs.lengths[i] >= 0) || std::isinf(slabs.lengths[i]))
      throw std::invalid_argument("length must be finite and not negative");
    if (slabs.lengths[i] > 0) flexibility += slabs.lengths[i] / (slabs.young * positive(slabs.areas[i], "area"));
  }
  if (!(flexibility > 0)) throw std::invalid_argument("at least one slab must have a positive length");
  return 1 / flexibility;
}

std::string mass_text(double mass) { return std::isinf(mass) ? "a wall" : format_quantity(mass, dimension::mass); }

std::string material_text(const ContactMaterial& material) {
  return fmt::format("E {}, nu {:g}", format_quantity(material.young, dimension::stress), material.poisson);
}

}  // namespace

double estimated_stiffness(const StiffnessEstimate& estimate, const CollidingMasses& bodies, double exponent) {
  positive(exponent, "exponent");
  positive(bodies.reduced, "reduced mass");
  return std::visit(
      Each{[&](const StiffnessOfBalls& balls) {
             positive(balls.material.density, "density");
             double curvatures = 0;
             for (const double mass : bodies.masses)
               if (!std::isinf(mass)) curvatures += 1 / radius_of_ball(positive(mass, "mass"), balls.material.density);
             return with_exponent(hertz(curvatures, balls.material), of_hertz, exponent, bodies.reduced);
           },
           [&](const StiffnessOfRadii& given) {
             const double curvatures = curvature(given.radii[0]) + curvature(given.radii[1]);
             return with_exponent(hertz(curvatures, given.material), of_hertz, exponent, bodies.reduced);
           },
           [&](const StiffnessOfSlabs& slabs) { return with_exponent(of_slabs(slabs), 1, exponent, bodies.reduced); },
           [&](const StiffnessOfPenetration& wanted) {
             return with_penetration(positive(wanted.penetration, "penetration"), exponent, bodies.reduced,
                                     positive(wanted.velocity, "velocity"));
           }},
      estimate);
}

std::string describe(const StiffnessEstimate& estimate, const CollidingMasses& bodies) {
  return std::visit(
      Each{[&](const StiffnessOfBalls& balls) {
             return fmt::format("Hertz, balls of {} and {}, {}", mass_text(bodies.masses[0]),
                                mass_text(bodies.masses[1]), material_text(balls.material));
           },
           [&](const StiffnessOfRadii& given) {
             return fmt::format("Hertz, radii {:g} m and {:g} m, {}", given.radii[0], given.radii[1],
                                material_text(given.material));
           },
           [&](const StiffnessOfSlabs& slabs) {
             return fmt::format("slabs of {:g} m and {:g} m to the centres of mass, E {}", slabs.lengths[0],
                                slabs.lengths[1], format_quantity(slabs.young, dimension::stress));
           },
           [&](const StiffnessOfPenetration& wanted) {
             return fmt::format("{} deep in an impact at {}", format_quantity(wanted.penetration, dimension::length),
                                format_quantity(wanted.velocity, dimension::velocity));
           }},
      estimate);
}

}  // namespace pounding
