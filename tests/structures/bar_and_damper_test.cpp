// A bar and a damper by themselves, the test playing the integrator.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <pounding/structures/bar_and_damper.hpp>

namespace pounding {
namespace {

constexpr double k = 5e6, c = 2e5;

TEST(BarAndDamper, HasSlopesThatAreDerivatives) {
  for (const double exponent : {0.2, 0.35, 0.5, 1.0, 1.5, 2.0}) {
    const BarAndDamper both(Bar{k}, Damper{.coefficient = c, .exponent = exponent});
    for (const double d : {-0.02, 0.0, 0.01})
      for (const double v : {-0.4, -1e-3, -1e-5, 0.0, 3e-4, 2e-3, 0.7}) {
        const laws::Response at = both.evaluate({d, v});
        const auto error = [&](double step) {
          const double by_d = (both.evaluate({d + step, v}).force - both.evaluate({d - step, v}).force) / (2 * step);
          const double by_v = (both.evaluate({d, v + step}).force - both.evaluate({d, v - step}).force) / (2 * step);
          return std::max(std::abs(by_d / at.by_penetration - 1), std::abs(by_v / at.by_rate - 1));
        };
        EXPECT_LT(error(1e-6), 1e-5) << exponent << " " << d << " " << v;
        EXPECT_GT(at.by_rate, 0);
        EXPECT_EQ(at.by_penetration, k);
      }
  }
}

TEST(BarAndDamper, PullsWhereItGetsLongerAndPushesWhereItGetsShorter) {
  const BarAndDamper bar(Bar{k}, {}), damper({}, Damper{.coefficient = c, .exponent = 0.35});
  EXPECT_EQ(bar.evaluate({0.01, 5}).force, 0.01 * k);
  EXPECT_EQ(bar.evaluate({-0.01, 5}).force, -0.01 * k);
  EXPECT_EQ(damper.evaluate({7, 0}).force, 0);
  EXPECT_EQ(damper.evaluate({7, 0.2}).force, -damper.evaluate({7, -0.2}).force);
  EXPECT_NEAR(damper.evaluate({0, 0.1}).force / (c * std::pow(0.1, 0.35)), 1, 4e-5) << "the rounding of 1 mm/s";
}

// One period of d = D sin(w t): a linear damper takes pi c w D^2.
TEST(BarAndDamper, TakesTheEnergyOfItsForceAndNothingInTheBar) {
  BarAndDamper both(Bar{k}, Damper{.coefficient = c});
  constexpr double amplitude = 0.02, w = 7;
  constexpr int steps = 40;
  const auto at = [&](double t) { return LinkMotion{amplitude * std::sin(w * t), amplitude * w * std::cos(w * t)}; };
  const double period = 2 * M_PI / w;
  for (int i = 0; i < steps; ++i) {
    const double t0 = period * i / steps, t1 = period * (i + 1) / steps;
    both.accept({.begin = t0,
                 .end = t1,
                 .motion_begin = at(t0),
                 .motion_middle = {},
                 .motion_end = at(t1),
                 .acceleration_begin = -w * w * at(t0).penetration,
                 .acceleration_end = -w * w * at(t1).penetration});
    EXPECT_NEAR(both.stored_correction(), 0.5 * k * at(t1).penetration * at(t1).penetration, 1e-9);
  }
  EXPECT_NEAR(both.damped() / (M_PI * c * w * amplitude * amplitude), 1, 1e-9);
  EXPECT_EQ(both.lost(), 0);
}

TEST(BarAndDamper, IsKeptByAnArchive) {
  BarAndDamper kept(Bar{k}, Damper{.coefficient = c, .exponent = 0.5});
  kept.start({0.01, 0});
  kept.accept({.begin = 0, .end = 0.1, .motion_begin = {0.01, 0.1}, .motion_middle = {}, .motion_end = {0.02, 0.1}});
  Archive written;
  kept.archive(written);
  BarAndDamper other(Bar{k}, Damper{.coefficient = c, .exponent = 0.5});
  Archive read(written.bytes());
  other.archive(read);
  EXPECT_EQ(other.elongation(), kept.elongation());
  EXPECT_EQ(other.damped(), kept.damped());
  EXPECT_GT(other.damped(), 0);
}

TEST(BarAndDamper, RefusesNumbersThatCannotBe) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(BarAndDamper({}, {}), std::invalid_argument);
  for (const double wrong : {0.0, -1.0, infinity, std::nan("")}) {
    EXPECT_THROW(BarAndDamper(Bar{wrong}, {}), std::invalid_argument);
    EXPECT_THROW(BarAndDamper({}, Damper{.coefficient = wrong}), std::invalid_argument);
    EXPECT_THROW(BarAndDamper({}, Damper{.coefficient = 1, .exponent = 0.5, .rounding_velocity = wrong}), std::invalid_argument);
  }
  for (const double wrong : {0.19, 2.1, -1.0, std::nan("")})
    EXPECT_THROW(BarAndDamper({}, Damper{.coefficient = 1, .exponent = wrong}), std::invalid_argument);
}

}  // namespace
}  // namespace pounding
