// A device in isolation, with the test as integrator.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <pounding/structures/device_spring.hpp>
#include "support/loaded.hpp"

namespace pounding {
namespace device_spring_test {

using DeviceSpring = test::Loaded<pounding::DeviceSpring, DeviceParts>;

constexpr double k = 5e6, c = 2e5;

TEST(DeviceSpring, HasSlopesThatAreDerivatives) {
  for (const double exponent : {0.2, 0.35, 0.5, 1.0, 1.5, 2.0}) {
    const DeviceSpring both(DeviceParts{.bar = Bar{k}, .damper = Damper{.coefficient = c, .exponent = exponent}});
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

TEST(DeviceSpring, PullsWhereItGetsLongerAndPushesWhereItGetsShorter) {
  const DeviceSpring bar(DeviceParts{.bar = Bar{k}}),
      damper(DeviceParts{.damper = Damper{.coefficient = c, .exponent = 0.35}});
  EXPECT_EQ(bar.evaluate({0.01, 5}).force, 0.01 * k);
  EXPECT_EQ(bar.evaluate({-0.01, 5}).force, -0.01 * k);
  EXPECT_EQ(damper.evaluate({7, 0}).force, 0);
  EXPECT_EQ(damper.evaluate({7, 0.2}).force, -damper.evaluate({7, -0.2}).force);
  EXPECT_NEAR(damper.evaluate({0, 0.1}).force / (c * std::pow(0.1, 0.35)), 1, 4e-5) << "round-off of 1 mm/s";
}

// One period of d = D sin(w t): a linear damper dissipates pi c w D^2.
TEST(DeviceSpring, TakesTheEnergyOfItsForceAndNothingInTheBar) {
  DeviceSpring both(DeviceParts{.bar = Bar{k}, .damper = Damper{.coefficient = c}});
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

TEST(DeviceSpring, IsKeptByAnArchive) {
  DeviceSpring kept(DeviceParts{.bar = Bar{k}, .damper = Damper{.coefficient = c, .exponent = 0.5}});
  kept.start({0.01, 0});
  kept.accept({.begin = 0, .end = 0.1, .motion_begin = {0.01, 0.1}, .motion_middle = {}, .motion_end = {0.02, 0.1}});
  Archive written;
  kept.archive(written);
  DeviceSpring other(DeviceParts{.bar = Bar{k}, .damper = Damper{.coefficient = c, .exponent = 0.5}});
  Archive read(written.bytes());
  other.archive(read);
  EXPECT_EQ(other.stored_correction(), kept.stored_correction());
  EXPECT_EQ(other.damped(), kept.damped());
  EXPECT_GT(other.damped(), 0);
}

TEST(DeviceSpring, RefusesNumbersThatCannotBe) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(DeviceSpring(DeviceParts{}), std::invalid_argument);
  for (const double wrong : {0.0, -1.0, infinity, std::nan("")}) {
    EXPECT_THROW(DeviceSpring(DeviceParts{.bar = Bar{wrong}}), std::invalid_argument);
    EXPECT_THROW(DeviceSpring(DeviceParts{.damper = Damper{.coefficient = wrong}}), std::invalid_argument);
    EXPECT_THROW(
        DeviceSpring(DeviceParts{.damper = Damper{.coefficient = 1, .exponent = 0.5, .rounding_velocity = wrong}}),
        std::invalid_argument);
  }
  for (const double wrong : {0.049, 2.1, -1.0, std::nan("")})
    EXPECT_THROW(DeviceSpring(DeviceParts{.damper = Damper{.coefficient = 1, .exponent = wrong}}),
                 std::invalid_argument);
}

// The number of steps would be inversely proportional to the relaxation time.
TEST(DeviceSpring, RefusesASpringInSeriesThatIsFarTooStiff) {
  for (const double exponent : {0.05, 0.2, 0.5, 1.0, 2.0}) {
    const double stiffest = exponent * 2e6 / Damper::shortest_relaxation;
    EXPECT_NO_THROW(DeviceSpring(
        DeviceParts{.damper = Damper{.coefficient = 2e6, .exponent = exponent, .stiffness = 0.999 * stiffest}}));
    for (const double stiffness : {1.001 * stiffest, 4e19, 1e300})
      EXPECT_THROW(
          DeviceSpring(DeviceParts{.damper = Damper{.coefficient = 2e6, .exponent = exponent, .stiffness = stiffness}}),
          std::invalid_argument);
  }
}

// s + lag g(s) = length: g is a power of the stretch from 1/2 to 20, and the lag ranges from zero to infinity.
TEST(DeviceSpring, SolvesTheStretchBesideItsDashpot) {
  for (const double exponent : {0.05, 0.2, 0.35, 0.7, 1.0, 1.5, 2.0}) {
    const Damper damper{.coefficient = c, .exponent = exponent, .stiffness = 8 * k};
    for (const double lag : {1e-9, 1e-4, 3e-3, 1.0, 1e4})
      for (const double length : {-0.3, -0.01, 1e-7, 2e-3, 0.05}) {
        const double s = damper.stretch(length, lag);
        EXPECT_NEAR((s + lag * damper.slip_rate(s)) / length, 1, 1e-13) << exponent << " " << lag << " " << length;
        const double step = 1e-6 * std::abs(length);
        const double slope = (damper.stretch(length + step, lag) - damper.stretch(length - step, lag)) / (2 * step);
        EXPECT_NEAR(damper.stretch_slope(s, lag) / slope, 1, 1e-6) << exponent << " " << lag << " " << length;
      }
    EXPECT_EQ(damper.stretch(0.01, std::numeric_limits<double>::infinity()), 0)
        << "at rest the force of the dashpot is zero";
    EXPECT_EQ(damper.stretch(0.01, 0), 0.01);
  }
}

TEST(DeviceSpring, BeginsWithADamperAtRestAndLosesWhatItsDashpotTakes) {
  const Damper damper{.coefficient = c, .exponent = 0.5, .stiffness = k};
  DeviceSpring maxwell(DeviceParts{.damper = damper});
  EXPECT_TRUE(maxwell.slips());
  LinkMotion motion{0.02, 0};
  motion.slip = maxwell.first_slip(motion);
  EXPECT_EQ(maxwell.evaluate(motion).force, 0);
  maxwell.start(motion);
  EXPECT_EQ(maxwell.stored_correction(), 0);
  // Stretched suddenly by 100 mm and held: the force k s decreases as the dashpot takes up the stretch, and all stored
  // energy is lost.
  double slip = motion.slip, stretch = 0.1;
  constexpr int steps = 4000;
  constexpr double h = 2.5e-4;
  for (int i = 0; i < steps; ++i) {
    const double next = 1 / (1 / stretch + k * k * h / (c * c));  // ds/dt = -(k s/c)^2
    LinkMotion begin{0.12, 0}, end{0.12, 0};
    begin.slip = slip, end.slip = slip + stretch - next;
    maxwell.accept({.begin = i * h, .end = (i + 1) * h, .motion_begin = begin, .motion_middle = {}, .motion_end = end});
    slip = end.slip, stretch = next;
  }
  EXPECT_NEAR((maxwell.damped() + maxwell.stored_correction()) / (0.5 * k * 0.01), 1, 1e-7);
  EXPECT_LT(maxwell.stored_correction(), 0.01 * maxwell.damped());
}

// The law replaces the bar, whose stiffness is not added; one cycle of a bilinear law has a loop of 4 (1-b) Fy (D -
// Dy).
TEST(DeviceSpring, YieldsByItsLawAndGivesAllOfItsForce) {
  DeviceSpring brace(
      DeviceParts{.law = hysteresis::Settings{
                      .law = "bilinear", .values = {{"stiffness", k}, {"yield_force", 0.01 * k}, {"hardening", 0.1}}}});
  EXPECT_EQ(brace.stiffness(), 0) << "not assembled into a structure";
  EXPECT_DOUBLE_EQ(brace.first_slope(), k);
  EXPECT_DOUBLE_EQ(brace.yield_deformation(), 0.01);
  EXPECT_DOUBLE_EQ(brace.evaluate({0.005, 0}).force, 0.005 * k);
  EXPECT_DOUBLE_EQ(brace.evaluate({0.03, 0}).force, (0.01 + 0.1 * 0.02) * k);
  EXPECT_NEAR(brace.evaluate({0.03, 0}).by_penetration / (0.1 * k), 1, 1e-12);
  EXPECT_NEAR(brace.slope_lost(0.03) / (0.9 * k), 1, 1e-12);
  EXPECT_EQ(brace.slope_lost(0.005), 0) << "elastic: unloading follows the loading line";
  const double turns[] = {0, 0.03, -0.03, 0.03};
  double lost = 0, time = 0;
  for (int i = 1; i < 4; ++i, time += 1) {
    lost = brace.lost();
    const double way = turns[i] - turns[i - 1];
    brace.accept({.begin = time,
                  .end = time + 1,
                  .motion_begin = {turns[i - 1], way},
                  .motion_middle = {},
                  .motion_end = {turns[i], way}});
  }
  EXPECT_NEAR((brace.lost() - lost) / (0.5 * 4 * 0.9 * 0.01 * k * 0.02), 1, 1e-12) << "half a loop";
  EXPECT_NEAR(brace.stored_correction(), 0.5 * 0.1 * k * 0.03 * 0.03 + 0.5 * 0.9 * k * 0.01 * 0.01, 1e-9 * k);
  EXPECT_EQ(brace.damped(), 0);
}

TEST(DeviceSpring, RefusesPartsThatContradict) {
  const hysteresis::Settings law{.law = "bilinear", .values = {{"stiffness", k}, {"yield_force", 0.01 * k}}};
  EXPECT_NO_THROW(DeviceSpring(DeviceParts{.law = law}));
  EXPECT_THROW(DeviceSpring(DeviceParts{.bar = Bar{k}, .law = law}), std::invalid_argument);
  EXPECT_THROW(DeviceSpring(DeviceParts{.law = hysteresis::Settings{.law = "bilinear", .values = {{"stiffness", k}}}}),
               std::invalid_argument);
  EXPECT_NO_THROW(DeviceSpring(DeviceParts{.damper = Damper{.coefficient = c, .exponent = 1.5, .stiffness = k}}));
  EXPECT_THROW(DeviceSpring(DeviceParts{.damper = Damper{.coefficient = c, .stiffness = -k}}), std::invalid_argument);
}

}  // namespace device_spring_test
}  // namespace pounding
