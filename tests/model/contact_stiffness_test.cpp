#include <pounding/model/contact_stiffness.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <pounding/elements.hpp>
#include <pounding/laws/free_impact.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace contact_stiffness_test {

constexpr double infinite = std::numeric_limits<double>::infinity();

CollidingMasses equal(double mass) { return {{mass, mass}, mass / 2}; }

// Goldsmith, Impact (1960): k = 4/(3 pi (d1 + d2)) sqrt(R1 R2/(R1 + R2)) with d = (1 - nu^2)/(pi E), R = (3 m/(4 pi
// rho))^(1/3).
TEST(ContactStiffness, OfBallsIsThatOfGoldsmith) {
  const double d = (1 - 0.04) / (std::numbers::pi * 30e9);
  const double r1 = std::cbrt(3 * 120e3 / (4 * std::numbers::pi * 2500)),
               r2 = std::cbrt(3 * 300e3 / (4 * std::numbers::pi * 2500));
  const double published = 4 / (3 * std::numbers::pi * 2 * d) * std::sqrt(r1 * r2 / (r1 + r2));
  const CollidingMasses bodies{{120e3, 300e3}, 120e3 * 300e3 / 420e3};
  EXPECT_NEAR(estimated_stiffness(StiffnessOfBalls{}, bodies, 1.5), published, 1e-12 * published);
  EXPECT_NEAR(estimated_stiffness(StiffnessOfRadii{.radii = {r1, r2}}, bodies, 1.5), published, 1e-12 * published);
  EXPECT_NEAR(estimated_stiffness(StiffnessOfBalls{}, equal(120e3), 1.5), 2.21e10, 0.01e10);
}

TEST(ContactStiffness, OfABallOnAWallIsThatOnAFlatBody) {
  const CollidingMasses bodies{{120e3, infinite}, 120e3};
  const double radius = std::cbrt(3 * 120e3 / (4 * std::numbers::pi * 2500));
  EXPECT_DOUBLE_EQ(estimated_stiffness(StiffnessOfBalls{}, bodies, 1.5),
                   estimated_stiffness(StiffnessOfRadii{.radii = {radius, infinite}}, bodies, 1.5));
}

TEST(ContactStiffness, OfSlabsIsThatOfTwoBarsInLine) {
  const StiffnessOfSlabs slabs{.young = 30e9, .areas = {3, 2}, .lengths = {9, 6}};
  EXPECT_NEAR(estimated_stiffness(slabs, equal(1e5), 1), 1 / (9 / 90e9 + 6 / 60e9), 1);
  const StiffnessOfSlabs one{.young = 30e9, .areas = {3, 0}, .lengths = {9, 0}};
  EXPECT_NEAR(estimated_stiffness(one, equal(1e5), 1), 1e10, 1);
}

// Each law without damping reaches the requested penetration in its own free impact.
TEST(ContactStiffness, OfAPenetrationIsReachedInAFreeImpact) {
  const StiffnessOfPenetration wanted{.penetration = 5e-3, .velocity = 0.8};
  const CollidingMasses bodies = equal(150e3);
  const laws::LinearSpring linear{.stiffness = estimated_stiffness(wanted, bodies, 1)};
  const laws::Hertz hertz{.stiffness = estimated_stiffness(wanted, bodies, 1.5)};
  const laws::Hertz soft{.stiffness = estimated_stiffness(wanted, bodies, 2.2), .exponent = 2.2};
  EXPECT_NEAR(laws::free_impact(linear, bodies.reduced, 0.8).peak_penetration, 5e-3, 1e-9);
  EXPECT_NEAR(laws::free_impact(hertz, bodies.reduced, 0.8).peak_penetration, 5e-3, 1e-9);
  EXPECT_NEAR(laws::free_impact(soft, bodies.reduced, 0.8).peak_penetration, 5e-3, 1e-9);
}

TEST(ContactStiffness, OfAnotherExponentGoesAsDeepAtTheSpeedOfTheEstimate) {
  const CollidingMasses bodies = equal(120e3);
  const laws::Hertz hertz{.stiffness = estimated_stiffness(StiffnessOfBalls{}, bodies, 1.5)};
  const laws::LinearSpring linear{.stiffness = estimated_stiffness(StiffnessOfBalls{}, bodies, 1)};
  const double deep = laws::free_impact(hertz, bodies.reduced, estimate_speed).peak_penetration;
  EXPECT_NEAR(laws::free_impact(linear, bodies.reduced, estimate_speed).peak_penetration, deep, 1e-6 * deep);
}

TEST(ContactStiffness, RefusesAbsurdNumbers) {
  const CollidingMasses bodies = equal(1e5);
  EXPECT_THROW(estimated_stiffness(StiffnessOfBalls{{.young = 0}}, bodies, 1.5), std::invalid_argument);
  EXPECT_THROW(estimated_stiffness(StiffnessOfBalls{{.poisson = 0.6}}, bodies, 1.5), std::invalid_argument);
  EXPECT_THROW(estimated_stiffness(StiffnessOfRadii{.radii = {infinite, infinite}}, bodies, 1.5),
               std::invalid_argument);
  EXPECT_THROW(estimated_stiffness(StiffnessOfRadii{.radii = {-1, 2}}, bodies, 1.5), std::invalid_argument);
  EXPECT_THROW(estimated_stiffness(StiffnessOfSlabs{}, bodies, 1), std::invalid_argument);
  EXPECT_THROW(estimated_stiffness(StiffnessOfPenetration{.penetration = 1e-3}, bodies, 1), std::invalid_argument);
  EXPECT_THROW(estimated_stiffness(StiffnessOfBalls{}, bodies, std::nan("")), std::invalid_argument);
}

double stiffness_of(const Link& link) {
  for (const laws::ResolvedValue& value : link.parameters)
    if (value.name == "stiffness") return value.value;
  return 0;
}

// Two buildings with floors of different mass: the stiffness of each link follows from its own floors.
TEST(ContactStiffness, OfALinkIsThatOfItsFloors) {
  for (const bool by_name : {false, true}) {
    Model model;
    const auto left = model.add("left", make_shear_building({.storeys = 2, .mass = {100e3, 200e3}, .stiffness = 1e8}),
                                {.damping = 0.05});
    const auto right =
        model.add("right", make_shear_building({.storeys = 2, .mass = 150e3, .stiffness = 2e8}), {.damping = 0.05});
    LinkOptions options{.gap = 0.02, .floors = FacingFloors::all, .stiffness = StiffnessOfBalls{}};
    if (by_name)
      model.link(left, right, options, laws::Settings{.law = "jankowski", .formula = {}, .restitution = 0.65});
    else
      model.link(left, right, options, laws::Jankowski{.restitution = 0.65});
    ASSERT_EQ(model.links.size(), 2u);
    for (int i = 0; i < 2; ++i) {
      const double own = i == 0 ? 100e3 : 200e3;
      const CollidingMasses bodies{{own, 150e3}, own * 150e3 / (own + 150e3)};
      EXPECT_DOUBLE_EQ(stiffness_of(model.links[i]), estimated_stiffness(StiffnessOfBalls{}, bodies, 1.5));
    }
    EXPECT_TRUE(test::mentions(model.links[0].stiffness_from, {"100 t", "150 t", "30 GPa", "0.2"}));
  }
}

TEST(ContactStiffness, IsRefusedForALawWithoutOne) {
  Model model;
  const auto left = model.add("left", make_body({.mass = 1e5}), {.initial_velocity = 1});
  const auto right = model.add("right", make_wall());
  const LinkOptions options{.gap = 0.02, .stiffness = StiffnessOfBalls{}};
  try {
    model.link(left, right, options, laws::Stereomechanical{.restitution = 0.5});
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_TRUE(test::mentions(std::string(error.what()), {"stereomechanical"}));
  }
}

}  // namespace contact_stiffness_test
}  // namespace pounding
