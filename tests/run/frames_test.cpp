// Runs of frames, against oscillators, closed forms, hand calculations, mirror images, and integration in absolute
// coordinates.

#include <gtest/gtest.h>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "support/book.hpp"
#include "support/direct.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace frames_test {

constexpr double pi = std::numbers::pi;
constexpr double young = 30e9, height = 3.0;

std::string with(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

// A portal a b c d with a stiff beam that cannot rotate: one unknown, 24 E I/h^3 = m (2 pi/T)^2.
double inertia_of(double mass, double period) {
  return mass * std::pow(2 * pi / period, 2) * std::pow(height, 3) / (24 * young);
}

std::string portal(const std::string& name, double origin, double mass, double period,
                   const std::string& damping = "5 %", const std::string& foot = "fixed",
                   const std::string& beside = "") {
  return fmt::format(
      "  {}: {{frame: {{origin: [{:.17g}], material: {{E: 30 GPa}}, sections: {{s: {{area: 0.2, inertia_y: "
      "{:.17g}}}}},\n"
      "    nodes: {{a: [0, 0], b: [0, 3], c: [5, 3], d: [5, 0]}},\n"
      "    members: {{left: {{between: [a, b], section: s}}, beam: {{between: [b, c], section: s}}, right: {{between: "
      "[d, c], section: s}}}},\n"
      "    supports: {{a: fixed, b: {{fix: [uz, ry]}}, c: {{fix: [uz, ry]}}, d: {}}},\n"
      "    masses: {{b: {:.17g}, c: {:.17g}}}, floors: [{{nodes: [b, c], rigid: true}}], report: {{members: all}}}},\n"
      "    damping: {}{}}}\n",
      name, origin, inertia_of(mass, period), foot, mass / 2, mass / 2, damping, beside);
}

const std::string converged = "analysis: {duration: 3.0, tolerance: 1e-9, integrator: esdirk4}\n";
const std::string shaken = "ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\n";

void expect_same_impacts(const Outcome& a, const Outcome& b, double relative, double time) {
  ASSERT_EQ(a.results.impacts.size(), b.results.impacts.size());
  ASSERT_GT(a.results.impacts.size(), 1u);
  for (std::size_t i = 0; i < a.results.impacts.size(); ++i) {
    const ImpactRow &one = a.results.impacts[i], &other = b.results.impacts[i];
    EXPECT_EQ(one.link, other.link) << i;
    EXPECT_NEAR(one.t_start, other.t_start, time) << i;
    EXPECT_NEAR(one.v_approach, other.v_approach, relative * one.v_approach) << i;
    EXPECT_NEAR(one.peak_force, other.peak_force, relative * one.peak_force) << i;
    EXPECT_NEAR(one.impulse, other.impulse, relative * one.impulse) << i;
  }
}

TEST(Frames, WithRigidBeamsAreTwoOscillators) {
  test::Book book("Runs of frames", "two portals with stiff beams are two oscillators: DOP853 with located events",
                  "as for the oscillators: displacement to 1e-5 and half a unit of the last digit, force to 1e-4");
  const std::string links =
      "links: [{between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, restitution: 0.65, formula: "
      "exact}]\n";
  const Outcome frames = test::run_text(shaken + "structures:\n" + portal("left", 0, 100e3, 0.8) +
                                        portal("right", 5.02, 150e3, 0.4) + links + converged);
  const Outcome sticks = test::run_text(shaken +
                                        "structures:\n"
                                        "  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n"
                                        "  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}\n" +
                                        links + converged);
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(frames.summary.structures[i].peak_displacement[0], sticks.summary.structures[i].peak_displacement[0],
                1e-6 * 0.1);
  expect_same_impacts(frames, sticks, 1e-6, 1e-7);
  // See tests/verification/two_oscillators_test.cpp.
  book.near("two portals: peak displacement [m]", frames.summary.structures[0].peak_displacement[0], 0.130228,
            1e-5 * 0.13 + 0.5e-6);
  book.near("two portals: peak force [N]", frames.summary.links[0].peak_force, 9154322.9, 1e-4 * 9154322.9);
}

std::string grid(const std::string& name, const std::string& origin, const std::string& bays, const std::string& widths,
                 int storeys, const std::string& mass, const std::string& column, const std::string& more = "") {
  return fmt::format(
      "  {}: {{frame: {{origin: {}, material: {{E: 30 GPa}}, grid: {{storeys: {}, bays: {}, storey_height: 3 m, "
      "bay_width: {}, "
      "columns: {{circle: {}}}, beams: {{circle: 0.5}}, floor_mass: {}{}}}}}, damping: 5 %}}\n",
      name, origin, storeys, bays, widths, column, mass, more);
}

const std::string hertz = "gap: 10 mm, law: hertz, stiffness: 1e9";

// Mirrors the locations and the motion of a pair: the left structure becomes the right one.
TEST(Frames, MirroredGiveMirroredResults) {
  const auto pair = [](double a, double b, double amplitude) {
    const std::string between = a < b ? "[a.1, b.1]" : "[b.1, a.1]";
    return test::run_text(
        fmt::format("ground_motion: {{harmonic: {{amplitude: {}, period: 0.5, duration: 2.0}}}}\nstructures:\n",
                    amplitude) +
        grid("a", fmt::format("[{}]", a), "1", "6 m", 2, "40 t", "0.5") +
        grid("b", fmt::format("[{}]", b), "1", "6 m", 1, "60 t", "0.6") + "links: [{between: " + between + ", " +
        hertz + "}]\nanalysis: {duration: 2.0, tolerance: 1e-8, integrator: esdirk4}\n");
  };
  const Outcome one = pair(0, 6.01, 4), other = pair(-6, -12.01, -4);
  expect_same_impacts(one, other, 1e-6, 1e-8);
  EXPECT_EQ(one.results.links[0].direction[0], 1);
  EXPECT_EQ(other.results.links[0].direction[0], 1);
  EXPECT_EQ(one.results.links[0].position[0], 6);
  EXPECT_EQ(other.results.links[0].position[0], -6.01);
  for (int s = 0; s < 2; ++s) {
    const StructureHistory &h = one.results.structures[s], &g = other.results.structures[s];
    ASSERT_EQ(h.node_displacement.size(), g.node_displacement.size());
    const double size = one.summary.structures[s].peak_displacement[0];
    // The nodes "S.0" and "S.1" are exchanged.
    for (std::size_t i = 0; i < h.node_displacement.size(); ++i) {
      const std::size_t mirrored = i / 6 * 6 + (i % 6 + 3) % 6;
      const double sign = i % 3 == 1 ? 1 : -1;
      ASSERT_NEAR(h.node_displacement[i], sign * g.node_displacement[mirrored], (i % 3 == 2 ? 0.1 : 1) * 1e-6 * size)
          << s << " " << i;
    }
  }
  EXPECT_GT(one.results.impacts[0].v_approach, 0);
}

// Eccentric: both twist. The second model is its reflection on the plane x = y, which changes the sign of a rotation
// about z.
TEST(Frames, TurnedInPlanHitEachOtherAlike) {
  const auto pair = [](bool turned) {
    const auto at = [&](double x, double y) {
      return turned ? fmt::format("[{}, {}]", y, x) : fmt::format("[{}, {}]", x, y);
    };
    const std::string axis = turned ? "y" : "x", bays = turned ? "[2, 1]" : "[1, 2]";
    const std::string widths = turned ? "{x: 4 m, y: 6 m}" : "{x: 6 m, y: 4 m}";
    return test::run_text("ground_motion: {components: {" + axis +
                          ": {harmonic: {amplitude: 4, period: 0.5, duration: 1.2}}}}\nstructures:\n" +
                          grid("a", at(0, 0), bays, widths, 1, "40 t", "0.25") +
                          grid("b", at(6.01, 3), bays, widths, 1, "60 t", "0.35") + "links: [{between: [a, b], " +
                          hertz + "}]\nanalysis: {duration: 1.2, tolerance: 1e-8, integrator: esdirk4}\n");
  };
  const Outcome along_x = pair(false), along_y = pair(true);
  ASSERT_EQ(along_x.results.links.size(), 2u);
  EXPECT_EQ(along_y.results.links[0].direction[1], 1);
  EXPECT_NEAR(along_x.results.links[1].position[1], 8, 1e-12);
  EXPECT_NEAR(along_y.results.links[1].position[0], 8, 1e-12);
  expect_same_impacts(along_x, along_y, 1e-5, 1e-7);
  const std::vector<double>&u = along_x.results.structures[0].displacement,
        &w = along_y.results.structures[0].displacement;
  ASSERT_EQ(u.size(), w.size());
  double turn = 0;
  for (std::size_t i = 0; i < u.size(); i += 3) {
    EXPECT_NEAR(u[i], w[i + 1], 1e-8) << i;
    EXPECT_NEAR(u[i + 2], -w[i + 2], 1e-8) << i;
    turn = std::max(turn, std::abs(u[i + 2]));
  }
  EXPECT_GT(turn, 1e-4) << "the frames must twist in this test";
}

// Two plane frames in parallel, each with half of the floor and one contact.
TEST(Frames, InSpaceMoveAsPlaneOnesWhereAllIsSymmetric) {
  const std::string motion = "ground_motion: {harmonic: {amplitude: 4, period: 0.5, duration: 2.0}}\nstructures:\n";
  const std::string rest = "links: [{between: [a, b], floors: level, " + hertz +
                           "}]\nanalysis: {duration: 2.0, tolerance: 1e-8, integrator: esdirk4}\n";
  // The two lowest modes in space are one along x and one along y.
  const auto damped = [](const std::string& frames) {
    return with(frames, "damping: 5 %", "damping: {rayleigh: {ratio: 5 %, periods: [0.4 s, 0.1 s]}}");
  };
  const Outcome plane =
      test::run_text(damped(motion + grid("a", "[0]", "1", "6 m", 2, "40 t", "0.5", ", rigid_floors: true") +
                            grid("b", "[6.01]", "1", "6 m", 1, "60 t", "0.6", ", rigid_floors: true") + rest));
  const Outcome space = test::run_text(damped(motion + grid("a", "[0, 0]", "[1, 1]", "6 m", 2, "80 t", "0.5") +
                                              grid("b", "[6.01, 0]", "[1, 1]", "6 m", 1, "120 t", "0.6") + rest));
  ASSERT_EQ(space.results.links.size(), 2 * plane.results.links.size());
  ASSERT_EQ(space.results.impacts.size(), 2 * plane.results.impacts.size());
  ASSERT_GT(plane.results.impacts.size(), 1u);
  for (std::size_t i = 0; i < plane.results.impacts.size(); ++i) {
    EXPECT_NEAR(space.results.impacts[2 * i].peak_force, plane.results.impacts[i].peak_force,
                1e-5 * plane.results.impacts[i].peak_force)
        << i;
    EXPECT_NEAR(space.results.impacts[2 * i].t_start, plane.results.impacts[i].t_start, 1e-6) << i;
  }
  for (int s = 0; s < 2; ++s) {
    const std::vector<double>&u = space.results.structures[s].displacement,
          &w = plane.results.structures[s].displacement;
    ASSERT_EQ(u.size(), 3 * w.size());
    for (std::size_t i = 0; i < w.size(); ++i) {
      ASSERT_NEAR(u[3 * i], w[i], 1e-7) << i;
      ASSERT_NEAR(u[3 * i + 1], 0, 1e-9) << i;
      ASSERT_NEAR(u[3 * i + 2], 0, 1e-9) << i;
    }
  }
}

// The contact at y = 4.5 m is 1.5 m beyond the centre of a, at 3 m, and 1.5 m before that of b, at 6 m. a is pushed
// along -x, b along x: both rotate from x to y. Their inertia is M (3^2 + 3^2), and the impact is too short for the
// columns to respond.
TEST(Frames, AnEccentricContactTwistsBoth) {
  const Outcome run =
      test::run_text("structures:\n" +
                     with(grid("a", "[0, 0]", "[1, 1]", "6 m", 1, "40 t", "0.2"), "damping: 5 %",
                          "damping: 0, initial_velocity: 1 m/s") +
                     with(grid("b", "[6.001, 3]", "[1, 1]", "6 m", 1, "60 t", "0.2"), "damping: 5 %", "damping: 0") +
                     "links: [{between: [a, b], points: 1, gap: 1 mm, law: hertz, stiffness: 1e12}]\n"
                     "analysis: {duration: 0.03, output_step: 1e-4, tolerance: 1e-6}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  const ImpactRow& impact = run.results.impacts[0];
  ASSERT_LT(impact.t_end, 0.02);
  const std::size_t after = static_cast<std::size_t>(std::ceil(impact.t_end / 1e-4)),
                    before = static_cast<std::size_t>(impact.t_start / 1e-4);
  const double mass[] = {40e3, 60e3};
  EXPECT_EQ(run.results.links[0].position[1], 4.5);
  for (int s = 0; s < 2; ++s) {
    const std::vector<double>& v = run.results.structures[s].velocity;
    const double turn = v[3 * after + 2], push = v[3 * after] - v[3 * before];
    EXPECT_NEAR(v[3 * before + 2], 0, 1e-12);
    EXPECT_NEAR(turn, 1.5 * impact.impulse / (18 * mass[s]), 0.02 * turn) << s;
    EXPECT_NEAR(push, (s == 0 ? -1 : 1) * impact.impulse / mass[s], 0.02 * std::abs(push)) << s;
  }
}

// Cantilevers of 4 m, bent towards each other by their loads: u = F h^3/3EI + w h^4/8EI.
TEST(Frames, LeanTowardsEachOtherUnderGravity) {
  test::Book book("Runs of frames",
                  "two masts at rest under forces, loads and weight: P L^3/(3 EI) + w L^4/(8 EI), N L/(EA), statics",
                  "round-off; 1e-9 for values that the run must keep constant");
  const auto mast = [](const std::string& name, double x, double sign) {
    return fmt::format(
        "  {}: {{frame: {{origin: [{}], material: {{E: 30 GPa}}, nodes: {{foot: [0, 0], top: [0, 4]}},\n"
        "    members: {{c: {{between: [foot, top], section: {{area: 0.1, inertia_y: 1e-3}}, load: [{} N/m, 0]}}}},\n"
        "    supports: {{foot: fixed}}, masses: {{top: 20 t}}, loads: {{top: {{ux: {}}}}}, floors: [{{nodes: "
        "[top]}}],\n"
        "    report: {{members: all}}}}, damping: 5 %}}\n",
        name, x, sign * 300, sign * 5e3);
  };
  const auto pair = [&](double apart) {
    return "structures:\n" + mast("a", 0, 1) + mast("b", apart, -1) +
           "links: [{between: [a, b], law: hertz, stiffness: 1e9}]\nanalysis: {duration: 0.2}\n";
  };
  const double ei = 30e6, lean = 5e3 * 64 / (3 * ei) + 300 * 256 / (8 * ei);
  const Outcome run = test::run_text(pair(0.05));
  book.near("masts: penetration at the start [m]", run.results.links[0].penetration.front(), 2 * lean - 0.05, 1e-12);
  book.near("masts: penetration at the end [m]", run.results.links[0].penetration.back(), 2 * lean - 0.05, 1e-9);
  EXPECT_TRUE(run.results.impacts.empty());
  for (int s = 0; s < 2; ++s) {
    const double sign = s == 0 ? 1 : -1;
    const StructureHistory& h = run.results.structures[s];
    book.near("masts: displacement [m]", h.displacement.back(), sign * lean, 1e-12);
    // Nodes foot and top along x, z, ry.
    book.near("masts: displacement of the node [m]", h.node_displacement[3], sign * lean, 1e-12);
    book.near("masts: shortening [m]", h.node_displacement[4], -20e3 * 9.80665 * 4 / 3e9, 1e-12);
    // Local x up, z along -x: N, Vz, My at the foot, then at the top.
    const double expected[] = {20e3 * 9.80665,  sign * (5e3 + 1200), -sign * (5e3 * 4 + 300 * 8),
                               -20e3 * 9.80665, -sign * 5e3,         0};
    for (int j = 0; j < 6; ++j) book.near("masts: end forces [N, N m]", h.end_forces[j], expected[j], 1e-6);
  }
  EXPECT_NO_THROW(test::model_of(pair(2 * lean + 1e-6)));
  EXPECT_THROW(test::model_of(pair(2 * lean - 1e-6)), InputError);
}

// Harmonic motion from rest: the ground displacement is A/W^2 (W t - sin W t).
double ground_displacement(double amplitude, double period, double t) {
  const double w = 2 * pi / period;
  return t <= 0 ? 0 : amplitude / (w * w) * (w * t - std::sin(w * t));
}

// Quasi-static: a stiff beam on equal columns follows half of the motion of the right foot, each column is bent by the
// other half, and their shears cancel. The right column moves by 0.75 of it at mid-height.
TEST(Frames, FollowTheirSupportsStatically) {
  test::Book book(
      "Runs of frames",
      "a portal with a slowly moving foot: half of the motion reaches the floor, each column is bent by the "
      "other half; 12 EI/h^3",
      "dynamic remainder of the motion, 1e-5; the foot itself to round-off");
  const double period = 400, amplitude = 1e-5, t = 100;
  const std::string foot = fmt::format(
      "{{fix: fixed, ground_motion: {{harmonic: {{amplitude: {}, period: {}, duration: 400}}}}}}", amplitude, period);
  const Outcome run = test::run_text("structures:\n" + portal("p", 0, 100e3, 0.1, "5 %", foot) +
                                     "  w: {wall: {}}\nlinks: [{between: [{structure: p, elevation: 1.5}, w], gap: 1 "
                                     "m, law: hertz, stiffness: 1e9}]\n" +
                                     fmt::format("analysis: {{duration: {}, output_step: 10, tolerance: 1e-8}}\n", t));
  const double d = ground_displacement(amplitude, period, t);
  const StructureHistory& h = run.results.structures[0];
  const std::size_t last = run.results.time.size() - 1;
  book.near("slow foot: displacement [m]", h.displacement[last], 0.5 * d, 1e-5 * d);
  book.near("slow foot: drift [m]", h.drift[last], 0.5 * d, 1e-5 * d);
  const auto node = [&](int i, int j) { return h.node_displacement[(last * 4 + i) * 3 + j]; };
  EXPECT_EQ(node(0, 0), 0);
  book.near("slow foot: node of the floor [m]", node(1, 0), 0.5 * d, 1e-5 * d);
  book.near("slow foot: the foot itself [m]", node(3, 0), d, 1e-12 * d);
  book.near("slow foot: its velocity [m/s]", h.node_velocity[(last * 4 + 3) * 3],
            amplitude * period / (2 * pi) * (1 - std::cos(2 * pi * t / period)), 1e-12);
  book.near("slow foot: its acceleration [m/s^2]", h.node_acceleration[(last * 4 + 3) * 3],
            amplitude * std::sin(2 * pi * t / period), 1e-12);
  book.near("slow foot: penetration at 0.75 of its motion [m]", run.results.links[0].penetration.back(), 0.75 * d - 1,
            1e-5 * d);
  // A column: 12 E I/h^3 times d/2; local z points along -x.
  const double shear = 12 * young * inertia_of(100e3, 0.1) / 27 * d / 2, moment = shear * height / 2;
  const auto force = [&](int member, int j) { return h.end_forces[(last * 3 + member) * 6 + j]; };
  book.near("slow foot: end force of a column [N]", force(0, 1), shear, 1e-5 * shear);
  book.near("slow foot: end force of a column [N]", force(0, 4), -shear, 1e-5 * shear);
  book.near("slow foot: end force of a column [N]", force(2, 1), -shear, 1e-5 * shear);
  book.near("slow foot: end force of a column [N]", force(2, 4), shear, 1e-5 * shear);
  book.near("slow foot: end moment of a column [N m]", std::abs(force(2, 2)), moment, 1e-5 * moment);
  EXPECT_NEAR(force(2, 2), -force(0, 2), 1e-5 * moment);
  book.near("slow foot: storey shear [N]", h.storey_shear[last], 0, 1e-5 * shear);
}

TEST(Frames, WithADelayedFootMoveAsInAbsoluteCoordinates) {
  test::Book book("Runs of frames",
                  "independent integration in absolute coordinates, m x'' = -k/2 (x - g1) - k/2 (x - g2)",
                  "run at tolerance 1e-9; velocities and accelerations of the same error times the frequencies");
  const double mass = 100e3, period = 0.4, delay = 0.13, amplitude = 3, ground_period = 0.6, duration = 1.0, end = 1.5;
  const Outcome run =
      test::run_text("ground_motion: {harmonic: {amplitude: 3, period: 0.6, duration: 1}}\nstructures:\n" +
                     portal("p", 0, mass, period, "0", "{fix: fixed, delay: 0.13 s}") +
                     "analysis: {duration: 1.5, output_step: 0.1, tolerance: 1e-9, integrator: esdirk4}\n");
  const double k = mass * std::pow(2 * pi / period, 2);
  const auto ground = [&](double t) {
    return t >= 0 && t < duration ? amplitude * std::sin(2 * pi * t / ground_period) : 0.0;
  };
  const auto f = [&](double t, const Eigen::VectorXd& y) {  // x, g1, g2 and their velocities
    Eigen::VectorXd out(6);
    out << y[3], y[4], y[5], -0.5 * k / mass * (2 * y[0] - y[1] - y[2]), ground(t), ground(t - delay);
    return out;
  };
  const Eigen::VectorXd y =
      test::integrate(f, Eigen::VectorXd::Zero(6), 0, end, 0.1, {duration, delay, duration + delay});
  const StructureHistory& h = run.results.structures[0];
  book.near("delayed foot: displacement [m]", h.displacement.back(), y[0] - y[1], 1e-7);
  book.near("delayed foot: velocity [m/s]", h.velocity.back(), y[3] - y[4], 1e-6);
  book.near("delayed foot: acceleration [m/s^2]", h.acceleration.back(), -0.5 * k / mass * (2 * y[0] - y[1] - y[2]),
            1e-5);
  book.near("delayed foot: storey shear [N]", h.storey_shear.back(), 0.5 * k * (2 * y[0] - y[1] - y[2]), 1e-6 * k);
  book.near("delayed foot: displacement of the foot [m]", h.node_displacement[h.node_displacement.size() - 3],
            y[2] - y[1], 1e-9);
}

// Launched as a rigid body it vibrates about its initial location, regardless of the later motion of its supports.
TEST(Frames, AreThrownAsAWhole) {
  test::Book book("Runs of frames", "free vibration: u = v/w sin(w t)",
                  "run at tolerance 1e-8; velocities of the same error times the frequency");
  for (const char* foot : {"fixed", "{fix: fixed, delay: 0.5 s}"}) {
    SCOPED_TRACE(foot);
    const Outcome run = test::run_text(
        "ground_motion: {pulse: {shape: half_sine, amplitude: 1, start: 5, duration: 1}}\nstructures:\n" +
        portal("p", 0, 100e3, 0.4, "0", foot, ", initial_velocity: 0.3 m/s") +
        "analysis: {duration: 1, output_step: 0.05, tolerance: 1e-8, integrator: esdirk4}\n");
    const double w = 2 * pi / 0.4;
    for (std::size_t i = 0; i < run.results.time.size(); ++i) {
      book.near("thrown: displacement [m]", run.results.structures[0].displacement[i],
                0.3 / w * std::sin(w * run.results.time[i]), 1e-7);
      book.near("thrown: velocity [m/s]", run.results.structures[0].velocity[i],
                0.3 * std::cos(w * run.results.time[i]), 2e-6);
    }
  }
}

TEST(Frames, AreShakenUpAndDown) {
  test::Book book("Runs of frames",
                  "a mass on a column, shaken along it: u = -A/(w^2 - W^2) (sin W t - W/w sin w t), w^2 = EA/(h m)",
                  "run at tolerance 1e-9");
  const Outcome run = test::run_text(
      "ground_motion: {components: {z: {harmonic: {amplitude: 2, period: 0.25, duration: 1}}}}\nstructures:\n"
      "  p: {frame: {material: {E: 30 GPa}, nodes: {foot: [0, 0], top: [0, 3]},\n"
      "    members: {c: {between: [foot, top], section: {area: 0.01, inertia_y: 1e-3}}}, supports: {foot: fixed}, "
      "masses: {top: 100 t},\n"
      "    floors: [{nodes: [top]}], report: {members: all}}, damping: 0}\n"
      "analysis: {duration: 1, output_step: 0.05, tolerance: 1e-9, integrator: esdirk4}\n");
  const double k = 30e9 * 0.01 / 3, w = std::sqrt(k / 100e3), o = 2 * pi / 0.25;
  const StructureHistory& h = run.results.structures[0];
  for (std::size_t i = 0; i + 1 < run.results.time.size(); ++i) {
    const double t = run.results.time[i], u = -2 / (w * w - o * o) * (std::sin(o * t) - o / w * std::sin(w * t));
    book.near("up and down: displacement [m]", h.node_displacement[6 * i + 4], u, 1e-8);
    book.near("up and down: acceleration [m/s^2]", h.node_acceleration[6 * i + 4], -w * w * u, 1e-5);
    book.near("up and down: acceleration of the ground [m/s^2]", h.node_acceleration[6 * i + 1], 2 * std::sin(o * t),
              1e-9);
    book.near("up and down: end force [N]", h.end_forces[6 * i + 3], k * u, 1e-8 * k);
    EXPECT_EQ(h.node_displacement[6 * i + 3], 0);
  }
}

// Forces on the whole frame: m a of all nodes, the shear of the lowest storey, both terms of Rayleigh damping, the
// push.
TEST(Frames, StandInEquilibriumAtEveryInstant) {
  const std::string yaml =
      "ground_motion: {harmonic: {amplitude: 4, period: 0.5, duration: 1.0}}\nstructures:\n" +
      with(grid("a", "[0]", "1", "6 m", 2, "40 t", "0.5"), "}}, damping", "}, report: {members: all}}, damping") +
      "  w: {wall: {}}\nlinks: [{between: [a.2, w], gap: 10 mm, law: hertz, stiffness: 1e8}]\n"
      "analysis: {duration: 1.0, output_step: 0.01, tolerance: 1e-7}\n";
  const Model model = test::model_of(yaml);
  const Outcome run = pounding::run(model);
  const Structure& s = model.structures[0];
  const StructureHistory& h = run.results.structures[0];
  ASSERT_GT(run.results.impacts.size(), 0u);
  const LinkHistory& link = run.results.links[0];
  double largest = 0;
  int pressed = 0;
  for (std::size_t i = 0; i < run.results.time.size(); ++i) {
    const double t = run.results.time[i];
    // All free nodes, 1.0 1.1 2.0 2.1, follow the two feet.
    const double* v = &h.node_velocity[(i * 6 + 2) * 3];
    const double* a = &h.node_acceleration[(i * 6 + 2) * 3];
    double inertia = 0, by_mass = 0;
    for (int n = 0; n < 4; ++n) {
      inertia += 20e3 * a[3 * n];
      by_mass += s.by_mass * 20e3 * v[3 * n];
    }
    const double by_stiffness =
        s.by_stiffness * s.floors[0].storey_shear[0].dot(Eigen::Map<const Eigen::VectorXd>(v, 12));
    const auto at = std::lower_bound(link.time.begin(), link.time.end(), t - 1e-12);
    double push = 0;
    if (at != link.time.end() && at != link.time.begin()) {
      const std::size_t j = at - link.time.begin();
      const double part = (t - link.time[j - 1]) / (link.time[j] - link.time[j - 1]);
      push = link.time[j] > link.time[j - 1] ? (1 - part) * link.force[j - 1] + part * link.force[j] : link.force[j];
    }
    pressed += push > 1e5;
    const double shear = h.storey_shear[2 * i];
    EXPECT_NEAR(inertia + by_mass + by_stiffness + shear + push, 0, 2e-4 * 160e3 + 2e-3 * push) << t;
    largest = std::max(largest, std::abs(shear));
    // The upper end of each column of the first storey; local z points along -x.
    double of_columns = 0;
    for (std::size_t m = 0; m < h.members.size(); ++m)
      if (h.members[m].starts_with("column 1.")) of_columns -= h.end_forces[(i * h.members.size() + m) * 6 + 4];
    EXPECT_NEAR(of_columns, shear, 1e-9 * 160e3) << t;
    EXPECT_NEAR(h.drift[2 * i + 1], h.displacement[2 * i + 1] - h.displacement[2 * i], 1e-15);
    EXPECT_NEAR(h.displacement[2 * i], h.node_displacement[(i * 6 + 2) * 3], 1e-12);
  }
  EXPECT_GT(largest, 100e3) << "otherwise the test has no effect";
  EXPECT_GT(pressed, 0) << "otherwise the push is zero";
}

// A body hits a column 1 m above the ground; its ends are too heavy to move.
TEST(Frames, AColumnThatIsHitHoldsTheForceAtItsEnds) {
  test::Book book("Runs of frames",
                  "a column under impact between heavy ends: P a b^2/L^2, P a^2 b/L^2, P b^2 (3a + b)/L^3",
                  "a thousandth of the peak force");
  const Outcome run = test::run_text(
      "structures:\n  ball: {body: {mass: 10 t}, initial_velocity: 1 m/s}\n"
      "  b: {frame: {material: {E: 30 GPa}, nodes: {foot: [0, 0], top: [0, 3]},\n"
      "    members: {c: {between: [foot, top], section: {area: 0.1, inertia_y: 1e-3}}}, supports: {foot: fixed},\n"
      "    masses: {top: {ux: 1e11, uz: 1e11, ry: 1e11}}, floors: [{nodes: [top]}], report: {members: all}}, damping: "
      "0}\n"
      "links: [{between: [ball, {structure: b, elevation: 1 m}], gap: 1 mm, law: hertz, stiffness: 1e9}]\n"
      "analysis: {duration: 0.03, output_step: 2e-5, tolerance: 1e-7}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  const StructureHistory& h = run.results.structures[1];
  double largest = 0;
  for (std::size_t i = 0; i < run.results.time.size(); ++i) {
    const double* f = &h.end_forces[6 * i];
    const double p = f[1] + f[4], a = 1, b = 2, l = 3;
    largest = std::max(largest, p);
    const double t = run.results.time[i];
    if (t < run.results.impacts[0].t_start || t > run.results.impacts[0].t_end) {
      EXPECT_NEAR(p, 0, 100) << t;
    }
    book.near("column under impact: end force [N]", f[1], p * b * b * (3 * a + b) / (l * l * l), 100);
    book.near("column under impact: end moment [N m]", f[2], -p * a * b * b / (l * l), 100);
    book.near("column under impact: other end moment [N m]", f[5], p * a * a * b / (l * l), 100);
  }
  EXPECT_GT(largest, 1e5);
  EXPECT_NEAR(largest, run.results.impacts[0].peak_force, 1e-3 * largest);
}

// Constant pressure along x, motion along y that the wall follows: the work is mu N times the distance relative to the
// wall.
TEST(Frames, ThatRubAWallLoseFrictionTimesWay) {
  const double mu = 0.3;
  const Outcome run = test::run_text(
      "ground_motion: {components: {x: {pulse: {shape: rectangle, amplitude: -2, duration: 3}}, y: {harmonic: "
      "{amplitude: 3, period: 0.4, duration: 3}}}}\n"
      "structures:\n" +
      grid("a", "[0, 0]", "[1, 1]", "6 m", 1, "40 t", "0.3") +
      "  w: {wall: {}}\nlinks: [{between: [a, w], gap: 0 mm, law: kelvin_voigt_no_tension, stiffness: 2e7, "
      "restitution: 0.5, friction: 0.3, sliding_velocity: 1 mm/s, points: 1}]\n"
      "analysis: {duration: 2, output_step: 1e-3, tolerance: 1e-6}\n");
  const StructureHistory& h = run.results.structures[0];
  const LinkHistory& link = run.results.links[0];
  ASSERT_EQ(link.tangents, 2);
  double work = 0, way = 0;
  std::size_t j = 0;
  for (std::size_t i = 1; i < run.results.time.size(); ++i) {
    while (j + 1 < link.time.size() && link.time[j + 1] <= run.results.time[i]) ++j;
    const double slip = std::abs(h.displacement[3 * i + 1] - h.displacement[3 * (i - 1) + 1]);
    way += slip;
    work += mu * std::max(0.0, link.force[j]) * slip;
  }
  double lost_in_impacts = 0;
  for (const ImpactRow& row : run.results.impacts) lost_in_impacts += row.energy_lost;
  EXPECT_GT(way, 0.05);
  EXPECT_NEAR(run.summary.links[0].energy_lost - lost_in_impacts, work, 0.03 * work);
  EXPECT_LT(run.summary.energy.error, 1e-3);
}

// Friction and hinges together, which both follow the motion: the two integrators split them in different ways.
TEST(Frames, RubEachOtherWhileTheirHingesYield) {
  const auto frame = [](const std::string& name, const std::string& origin, double side, const std::string& hinges) {
    return fmt::format(
        "  {0}: {{frame: {{origin: [{1}, 0], material: {{E: 30 GPa}}, grid: {{storeys: 2, bays: 1, storey_height: 3 m, "
        "bay_width: 6 m, "
        "columns: {{rectangle: [{2}, {2}]}}, beams: {{rectangle: [0.3, 0.5]}}, floor_mass: 40 t}}{3}}}, damping: 5 "
        "%}}\n",
        name, origin, side, hinges);
  };
  std::vector<Outcome> runs;
  for (const std::string integrator : {"esdirk4", "generalized_alpha"})
    runs.push_back(
        test::run_text("ground_motion: {components: {x: {harmonic: {amplitude: 5, period: 0.5, duration: 1.5}}, z: "
                       "{harmonic: {amplitude: 2, period: 0.3, duration: 1.5}}}}\nstructures:\n" +
                       frame("a", "0", 0.4, ", hinges: {columns: {at: feet, yield_moment: 100 kN m, hardening: 2 %}}") +
                       frame("b", "6.01", 0.6, "") +
                       "links: [{between: [a, b], floors: all, friction: 0.3, law: hertz_damped, stiffness: 1.4e9, "
                       "restitution: 0.6}]\n"
                       "analysis: {duration: 1.5, tolerance: 1e-6, integrator: " +
                       integrator + "}\n"));
  for (const Outcome& run : runs) {
    EXPECT_GT(run.results.impacts.size(), 3u);
    EXPECT_LT(run.summary.energy.error, 1e-5);
    EXPECT_GT(run.summary.energy.hysteretic, 0.05 * run.summary.energy.input);
    double rubbed = run.summary.energy.impact;
    for (const ImpactRow& row : run.results.impacts) rubbed -= row.energy_lost;
    EXPECT_GT(rubbed, 1e-4 * run.summary.energy.input);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(runs[0].summary.links[i].peak_force, runs[1].summary.links[i].peak_force,
                1e-3 * runs[0].summary.links[0].peak_force);
    EXPECT_NEAR(runs[0].summary.structures[0].peak_displacement[i], runs[1].summary.structures[0].peak_displacement[i],
                1e-4 * runs[0].summary.structures[0].peak_displacement[i]);
  }
}

TEST(Frames, GoOnToTheSameBits) {
  const std::string yaml =
      "ground_motion: {components: {x: {harmonic: {amplitude: 4, period: 0.5, duration: 1.2}}, z: {harmonic: "
      "{amplitude: 1, period: 0.3, duration: 1}},"
      " y: {harmonic: {amplitude: 1, period: 0.6, duration: 1}}}, wave: {velocity: 100 m/s}}\nstructures:\n" +
      with(grid("a", "[0, 0]", "[1, 1]", "6 m", 2, "40 t", "0.5"), "}}, damping",
           "}, gravity: true, report: {members: all}}, damping") +
      grid("b", "[6.01, 2]", "[1, 1]", "6 m", 1, "60 t", "0.6") +
      "links: [{between: [a, b], floors: level, friction: 0.2, " + hertz +
      "}]\nanalysis: {duration: 1.2, tolerance: 1e-4}\n";
  const std::string path = (std::filesystem::temp_directory_path() / fmt::format("{}_frames.h5", getpid())).string();
  Outcome whole = test::run_text(yaml);
  {
    const Model model = test::model_of(yaml);
    EXPECT_THROW(
        run(model, {.output = path,
                    .stop = [](std::span<const ContactMemory> contacts) { return !contacts[0].impacts().empty(); }}),
        FailedRun);
  }
  const Model model = test::model_of(yaml);
  Outcome continued = run(model, {.output = path, .resume = path});
  std::filesystem::remove(path);
  const auto values_of = [](Results& results) {
    std::vector<std::vector<double>> all;
    visit_histories(results, [&](const std::string&, const std::vector<double>& values) { all.push_back(values); });
    return all;
  };
  EXPECT_EQ(values_of(whole.results), values_of(continued.results));
  EXPECT_EQ(whole.results.solver.steps, continued.results.solver.steps);
  ASSERT_EQ(whole.results.impacts.size(), continued.results.impacts.size());
  for (std::size_t i = 0; i < whole.results.impacts.size(); ++i)
    EXPECT_EQ(whole.results.impacts[i].peak_force, continued.results.impacts[i].peak_force) << i;
}

}  // namespace frames_test
}  // namespace pounding
