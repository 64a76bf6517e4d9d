// Ground motions given as displacements: structures on moving ground and the links between them follow closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "support/runs.hpp"

namespace pounding {
namespace ground_motions_test {

constexpr double pi = std::numbers::pi;

/// A portal frame with a separate motion of its right foot d.
Outcome portal_on(const std::string& motion, double duration) {
  return test::run_text(
      "structures:\n"
      "  p: {frame: {material: {E: 30 GPa}, sections: {s: {area: 0.2, inertia_y: 0.004}},\n"
      "    nodes: {a: [0, 0], b: [0, 3], c: [5, 3], d: [5, 0]},\n"
      "    members: {left: {between: [a, b], section: s}, beam: {between: [b, c], section: s}, right: {between: [d, "
      "c], section: s}},\n"
      "    supports: {a: fixed, b: {fix: [uz, ry]}, c: {fix: [uz, ry]}, d: {fix: fixed, ground_motion: " +
      motion +
      "}},\n"
      "    masses: {b: 50 t, c: 50 t}, floors: [{nodes: [b, c], rigid: true}], report: {members: all}}, damping: 5 %}\n"
      "  w: {wall: {}}\n"
      "links: [{between: [p.1, w], gap: 1 m, law: hertz, stiffness: 1e9}]\n" +
      fmt::format("analysis: {{duration: {}, output_step: 10 ms}}\n", duration));
}

/// Displacement and velocity of foot d equal those of the ground at every output time.
template <class Motion>
void expect_foot(const Outcome& run, Motion&& ground) {
  const StructureHistory& h = run.results.structures[0];
  for (std::size_t i = 0; i < run.results.time.size(); ++i) {
    const auto [d, v] = ground(run.results.time[i]);
    ASSERT_NEAR(h.node_displacement[(i * 4 + 3) * 3], d, 1e-13) << run.results.time[i];
    ASSERT_NEAR(h.node_velocity[(i * 4 + 3) * 3], v, 1e-12) << run.results.time[i];
  }
}

struct Moved {
  double displacement, velocity;
};

TEST(DisplacementsOfTheGround, MoveAFootByHarmonics) {
  const double w = 2 * pi / 0.8;
  expect_foot(portal_on("{displacement: {harmonic: {amplitude: 20 mm, period: 0.8, duration: 2, phase: 30 deg}}}", 1.5),
              [&](double t) { return Moved{0.02 * std::sin(w * t + pi / 6), 0.02 * w * std::cos(w * t + pi / 6)}; });
  expect_foot(portal_on("{displacement: {sum: [{amplitude: 20 mm, period: 0.8, phase: 90 deg}, {amplitude: 1 cm, "
                        "period: 2}], duration: 2}}",
                        1.5),
              [&](double t) {
                return Moved{0.02 * std::cos(w * t) + 0.01 * std::sin(pi * t),
                             -0.02 * w * std::sin(w * t) + 0.01 * pi * std::cos(pi * t)};
              });
}

TEST(DisplacementsOfTheGround, MoveAFootByARecord) {
  // A cubic that starts at rest and ends without acceleration is its own spline: 30 mm (3 s^2 - s^3)/2, s = t/2.
  const std::string file = testing::TempDir() + "foot_displacement.csv";
  std::ofstream stream(file);
  stream << "t [s]; d [mm]\n";
  for (int i = 0; i <= 20; ++i) {
    const double s = i / 20.0;
    stream << fmt::format("{:.17g};{:.17g}\n", 2 * s, 15 * (3 * s * s - s * s * s));
  }
  stream.close();
  expect_foot(portal_on("{displacement: {record: " + file + "}}", 2), [](double t) {
    const double s = t / 2;
    return Moved{0.015 * (3 * s * s - s * s * s), 0.0075 * (6 * s - 3 * s * s)};
  });
}

TEST(DisplacementsOfTheGround, InitialVelocityKeepsAFootFromDrifting) {
  // a = A cos(w t) from rest does not drift, nor does a = A sin(w t) with an initial velocity of -A/w.
  const double a = 2, w = 2 * pi / 0.5;
  expect_foot(portal_on("{harmonic: {amplitude: 2, period: 0.5, duration: 3, phase: 90 deg}}", 1.5),
              [&](double t) { return Moved{a / (w * w) * (1 - std::cos(w * t)), a / w * std::sin(w * t)}; });
  expect_foot(
      portal_on(
          fmt::format("{{harmonic: {{amplitude: 2, period: 0.5, duration: 3, initial_velocity: {:.17g}}}}}", -a / w),
          1.5),
      [&](double t) { return Moved{-a / (w * w) * std::sin(w * t), -a / w * std::cos(w * t)}; });
}

TEST(DisplacementsOfTheGround, DriveAWallIntoABody) {
  // The wall approaches as 50 mm sin(2 pi t) and meets the body, which is at rest, after 30 mm.
  const Outcome run = test::run_text(
      "structures:\n"
      "  w: {wall: {}, ground_motion: {displacement: {harmonic: {amplitude: 50 mm, period: 1 s, duration: 1 s}}}}\n"
      "  b: {body: {mass: 100 t}}\n"
      "links: [{between: [w, b], gap: 30 mm, law: hertz_damped, stiffness: 2e9, restitution: 0.6}]\n"
      "analysis: {duration: 0.3, tolerance: 1e-6}\n");
  ASSERT_GE(run.results.impacts.size(), 1u);
  EXPECT_NEAR(run.results.impacts[0].t_start, std::asin(0.6) / (2 * pi), 1e-9);
  EXPECT_NEAR(run.results.impacts[0].v_approach, 0.05 * 2 * pi * 0.8, 1e-8);
}

TEST(DisplacementsOfTheGround, OffsetsOpenOrCloseTheGapFromTheStart) {
  // The wall starts 20 mm closer and retreats: 10 mm of the gap of 30 mm remain.
  const Outcome run = test::run_text(
      "structures:\n"
      "  w: {wall: {}, ground_motion: {displacement: {harmonic: {amplitude: 20 mm, period: 50 s, duration: 60 s, "
      "phase: 90 deg}}}}\n"
      "  b: {body: {mass: 100 t}, initial_velocity: -1 m/s}\n"
      "links: [{between: [w, b], gap: 30 mm, law: hertz_damped, stiffness: 2e9, restitution: 0.6}]\n"
      "analysis: {duration: 0.05, tolerance: 1e-6}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  // 10 mm = 20 mm (cos(w t) - 1) + 1 m/s t, to first order in the small retreat of the wall.
  const double t = 0.01, back = 0.02 * (1 - std::cos(2 * pi / 50 * t));
  EXPECT_NEAR(run.results.impacts[0].t_start, t + back, 1e-10);
}

TEST(AnInitialVelocityOfTheGround, LeavesAMotionRelativeToItAlone) {
  const auto run = [](const std::string& velocity) {
    return test::run_text(
        "ground_motion: {sum: [{amplitude: 2, period: 0.5}, {amplitude: 1, period: 0.2, phase: 1}], duration: 2" +
        velocity +
        "}\nstructures:\n  a: {oscillator: {mass: 100 t, period: 0.6, damping: 5 %}}\n"
        "  b: {oscillator: {mass: 150 t, period: 0.3, damping: 5 %}}\n"
        "links: [{between: [a, b], gap: 5 mm, law: hertz_damped, stiffness: 1e8, restitution: 0.6}]\n"
        "analysis: {duration: 2}\n");
  };
  const Outcome rest = run(""), moving = run(", initial_velocity: 0.3");
  ASSERT_GT(rest.results.impacts.size(), 1u);
  EXPECT_EQ(rest.results.structures[0].displacement, moving.results.structures[0].displacement);
}

}  // namespace ground_motions_test
}  // namespace pounding
