// Rows of impacts: integrals and peaks from a few accepted steps.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <pounding/links/impact_log.hpp>

namespace pounding {
namespace impact_log_test {

/// Accepted steps between the given times, with force and rate as functions of time.
template <class Force, class Rate, class Times>
ImpactLog logged(const Force& force, const Rate& rate, const Times& times) {
  ImpactLog log(0);
  log.begin(times[0], rate(times[0]));
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double a = times[i - 1], b = times[i], m = 0.5 * (a + b);
    log.add({.begin = a,
             .end = b,
             .motion_begin = {0, rate(a)},
             .motion_middle = {0, rate(m)},
             .motion_end = {0, rate(b)},
             .force_begin = force(a),
             .force_middle = force(m),
             .force_end = force(b)});
  }
  return log;
}

TEST(ImpactLog, ImpulseOfACubicForceIsExactInOneStep) {
  const auto force = [](double t) { return 3 + 5 * t - 7 * t * t + 11 * t * t * t; };
  const ImpactLog log = logged(force, [](double) { return 1.0; }, std::array{1.0, 3.0});
  const auto integral = [](double t) { return 3 * t + 5 * t * t / 2 - 7 * t * t * t / 3 + 11 * t * t * t * t / 4; };
  EXPECT_NEAR(log.current().impulse, integral(3) - integral(1), 1e-12 * integral(3));
}

TEST(ImpactLog, WorkIsExactWhenThePowerIsCubic) {
  const auto force = [](double t) { return 2 + 3 * t * t; };
  const auto rate = [](double t) { return 4 - 5 * t; };
  const ImpactLog log = logged(force, rate, std::array{0.0, 0.5, 2.0});
  // The integral of 8 - 10 t + 12 t^2 - 15 t^3 from 0 to 2.
  EXPECT_NEAR(log.work(), 16 - 20 + 32 - 60, 1e-12);
  EXPECT_NEAR(log.current().energy_lost, log.work(), 1e-15);
}

TEST(ImpactLog, ForceThatJumpsAtTheTouchHasItsPeakThere) {
  const ImpactLog log =
      logged([](double t) { return 50 - 3 * t; }, [](double) { return 0.0; }, std::array{2.0, 2.5, 3.0});
  EXPECT_EQ(log.current().peak_force, 44);
  EXPECT_EQ(log.current().t_peak, 2);
}

TEST(ImpactLog, ForcesOfOneImpactDoNotShapeThePeakOfTheNext) {
  ImpactLog log = logged([](double t) { return 100 - t; }, [](double) { return 0.0; }, std::array{0.0, 1.0, 2.0});
  log.end(2, -1);
  log.begin(10, 1);
  log.add({.begin = 10,
           .end = 11,
           .motion_begin = {},
           .motion_middle = {},
           .motion_end = {0.3, 0},
           .force_begin = 9,
           .force_middle = 8,
           .force_end = 7});
  EXPECT_EQ(log.rows()[0].peak_force, 100);
  EXPECT_EQ(log.rows()[1].peak_force, 9);
  EXPECT_EQ(log.rows()[1].t_peak, 10);
  EXPECT_EQ(log.rows()[1].peak_penetration, 0.3);
}

TEST(ImpactLog, TouchAtRestHasNoRestitution) {
  ImpactLog log(0);
  log.begin(0, 0);
  log.end(1, -0.5);
  EXPECT_TRUE(std::isnan(log.current().restitution));
  EXPECT_EQ(log.current().v_separation, 0.5);
}

}  // namespace impact_log_test
}  // namespace pounding
