// Free motions: frames released from a displacement, falling bodies, and unsupported frames.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/model/modes.hpp>
#include <pounding/structures/massless.hpp>
#include "support/book.hpp"
#include "support/dense.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace starts_test {

// Two storeys with massless rotations and beam ends.
std::string tower(const std::string& start, double duration, const std::string& damping = "0") {
  return fmt::format(
      "structures:\n"
      "  a:\n"
      "    frame:\n"
      "      material: {{E: 30 GPa}}\n"
      "      grid: {{storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {{rectangle: [0.3 m, 0.3 m]}},\n"
      "             beams: {{rectangle: [0.3 m, 0.4 m]}}, floor_mass: 20 t}}\n"
      "      {}\n"
      "    damping: {}\n"
      "analysis: {{duration: {}, tolerance: 1e-7, output_step: {}}}\n",
      start, damping, duration, duration / 50);
}

// Free vibration of a structure from rest at these displacements, by its modes.
Eigen::VectorXd let_go(const Structure& s, const Eigen::VectorXd& from, double t) {
  const test::dense::Condensed condensed = test::dense::condense(s.stiffness, s.mass);
  const test::dense::Modes modes = test::dense::modes(condensed.stiffness, condensed.mass);
  const Eigen::VectorXd parts = modes.shapes.transpose() * (condensed.mass * from(condensed.dynamic));
  const Eigen::VectorXd dynamic =
      modes.shapes * (parts.array() * (modes.squares.cwiseSqrt() * t).array().cos()).matrix();
  Eigen::VectorXd u = Eigen::VectorXd::Zero(s.size());
  u(condensed.dynamic) = dynamic;
  u(condensed.massless) = condensed.following * dynamic;
  return u;
}

TEST(DisplacedFrame, VibratesFreelyFromTheShapeThatForcesHold) {
  test::Book book("Frames released from a displacement", "superposition of the modes of the condensed matrices",
                  "the tolerance of the run, for each period");
  for (const std::string start : {"initial_displacement: [4 mm, 10 mm]", "initial_displacement: 5 mm",
                                  "initial_node_displacements: {2.0: {ux: 10 mm}, 1.1: {ux: -3 mm}}"}) {
    SCOPED_TRACE(start);
    const Model model = test::model_of(tower(start, 0.6));
    const Structure& s = model.structures[0];
    const Outcome found = run(model);
    const std::vector<double>& u = found.results.structures[0].displacement;
    if (start.starts_with("initial_displacement")) {
      EXPECT_NEAR(u[0], start.find('[') == start.npos ? 0.005 : 0.004, 1e-14);
      EXPECT_NEAR(u[1], start.find('[') == start.npos ? 0.005 : 0.010, 1e-14);
    }
    // Forces act only where displacements are prescribed.
    const Eigen::VectorXd forces = s.stiffness * s.initial_displacement;
    EXPECT_EQ((forces.array().abs() > 1e-9 * forces.cwiseAbs().maxCoeff()).count(), 2);
    for (const double part : {0.5, 1.0}) {
      const std::size_t at = static_cast<std::size_t>(50 * part);
      const Eigen::VectorXd expected = let_go(s, s.initial_displacement, found.results.time[at]);
      for (int floor = 0; floor < 2; ++floor)
        book.near("displacement of a floor [m]", u[2 * at + floor], s.floors[floor].motion[0].dot(expected), 1e-8);
    }
    EXPECT_NEAR(found.summary.energy.input, 0.5 * s.initial_displacement.dot(forces),
                1e-9 * found.summary.energy.input);
    EXPECT_LT(found.summary.energy.error, 1e-6);
  }
}

// The initial shape is that of static loads.
TEST(DisplacedFrame, RestsAsUnderLoads) {
  const Outcome loaded = test::run_text(tower("loads: {2.0: {ux: 40 kN}}\n      gravity: false", 0.01));
  const double top = loaded.results.structures[0].displacement[1];
  const Outcome held =
      test::run_text(tower(fmt::format("initial_node_displacements: {{2.0: {{ux: {:.17g}}}}}", top), 0.01));
  const StructureHistory &a = loaded.results.structures[0], &b = held.results.structures[0];
  for (std::size_t i = 0; i < a.nodes.size() * a.node_directions.size(); ++i)
    EXPECT_NEAR(a.node_displacement[i], b.node_displacement[i], 1e-12) << i;
}

// Large rotations: the initial energy is conserved in the vibration.
TEST(DisplacedFrame, MayTurnByLargeAngles) {
  const Outcome found = test::run_text(tower("geometry: corotational\n      initial_displacement: [10 cm, 25 cm]", 1));
  EXPECT_NEAR(found.results.structures[0].displacement[1], 0.25, 1e-12);
  EXPECT_LT(found.summary.energy.error, 1e-6);
  EXPECT_GT(found.summary.energy.input, 1000);
}

std::string ball(const std::string& gravity, const std::string& law, double duration) {
  return fmt::format(
      "structures:\n  ground: {{wall: {{}}}}\n  ball: {{body: {{mass: 2 kg, gravity: {}}}}}\n"
      "links: [{{between: [ground, ball], gap: 1 m, law: {}}}]\nanalysis: {{duration: {}, tolerance: 1e-8}}\naccept: "
      "[gap]\n",
      gravity, law, duration);
}

TEST(FallingBody, BouncesAsABallDoes) {
  test::Book book("A bouncing ball", "closed form: times and speeds of the bounces, heights of the flights",
                  "round-off of the located impacts");
  constexpr double g = 9.80665, e = 0.8;
  const Outcome found = test::run_text(ball("-1 g", "stereomechanical, restitution: 0.8", 3));
  const double first = std::sqrt(2 / g);
  double time = first, speed = g * first;
  ASSERT_GE(found.results.impacts.size(), 6u);
  for (std::size_t n = 0; n < found.results.impacts.size(); ++n) {
    const ImpactRow& bounce = found.results.impacts[n];
    book.near("time of a bounce [s]", bounce.t_start, time, 1e-8);
    book.near("speed of a bounce [m/s]", bounce.v_approach, speed, 1e-7);
    speed *= e;
    // Top of the next flight, which the outputs resolve to 1.5 ms.
    const double top = time + speed / g;
    if (top < 3) {
      const std::size_t at = static_cast<std::size_t>(std::lround(top / 0.003));
      book.near("height of a flight [m]", 1 + found.results.structures[1].displacement[at], speed * speed / (2 * g),
                2e-5);
    }
    time += 2 * speed / g;
  }
  EXPECT_GT(time, 3);
  EXPECT_LT(found.summary.energy.error, 1e-8);
}

TEST(FallingBody, TakesAnyAccelerationAndComesToRest) {
  const Outcome up =
      test::run_text("structures: {a: {body: {mass: 2 kg, gravity: 3 m/s^2}}}\nanalysis: {duration: 2}\n");
  EXPECT_NEAR(up.results.structures[0].displacement.back(), 6, 1e-12);
  EXPECT_NEAR(up.summary.energy.input, 36, 1e-9);
  // Bounces accumulate at 4.06 s; then the ball is at rest.
  const Outcome lies = test::run_text(ball("-1 g", "stereomechanical, restitution: 0.8", 5));
  EXPECT_NEAR(lies.results.structures[1].displacement.back(), -1, 1e-6);
  EXPECT_NEAR(lies.results.structures[1].velocity.back(), 0, 1e-6);
  const Outcome on_spring = test::run_text(ball("-1 g", "hertz, stiffness: 1e6", 2));
  EXPECT_GE(on_spring.results.impacts.size(), 2u);
  EXPECT_LT(on_spring.summary.energy.error, 1e-7);
}

// An upright unsupported beam at x, with 20 parts.
std::string free_beam(const std::string& name, double x, const std::string& more,
                      const std::string& beside = "damping: 0") {
  std::string nodes, members;
  for (int i = 0; i <= 20; ++i) nodes += fmt::format("{}n{}: [{}, {}]", i > 0 ? ", " : "", i, x, 0.3 * i);
  for (int i = 0; i < 20; ++i)
    members += fmt::format("{}m{}: {{between: [n{}, n{}], section: {{rectangle: [0.2 m, 0.2 m], shear: false}}}}",
                           i > 0 ? ", " : "", i, i, i + 1);
  return fmt::format(
      "  {}:\n    frame:\n      material: {{E: 30 GPa, density: 2500 kg/m^3}}\n      nodes: {{{}}}\n      members: "
      "{{{}}}\n"
      "      supports: none\n{}    {}\n",
      name, nodes, members, more, beside);
}

TEST(FreeFrame, HasTheFrequenciesOfAFreeBeam) {
  test::Book book("Frames without supports", "closed form of the free-free beam, cos(b L) cosh(b L) = 1",
                  "20 parts with consistent masses");
  const Model model =
      test::model_of("structures:\n" + free_beam("a", 0, "      mass: consistent\n") + "analysis: {duration: 1}\n");
  const Structure& s = model.structures[0];
  const double length = 6, inertia = std::pow(0.2, 4) / 12,
               unit = std::sqrt(30e9 * inertia / (2500 * 0.04)) / (length * length);
  book.near("first frequency [rad/s]", s.frequencies[0], 4.730040744862704 * 4.730040744862704 * unit,
            1e-4 * s.frequencies[0]);
  book.near("second frequency [rad/s]", s.frequencies[1], 7.853204624095838 * 7.853204624095838 * unit,
            1e-4 * s.frequencies[1]);
  const std::vector<Mode> found = modes(s, 4, dense_modes);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isinf(found[i].period)) << i;
  EXPECT_NEAR(found[3].period, 2 * M_PI / s.frequencies[0], 1e-9);
}

TEST(FreeFrame, KeepsItsVelocity) {
  for (const char* damping : {"0", "5 %", "{modal: {ratio: 5 %}}"}) {
    const Outcome found = test::run_text(
        "structures:\n" + free_beam("a", 0, "      initial_velocity: 2 m/s\n", std::string("damping: ") + damping) +
        "analysis: {duration: 10}\n");
    const StructureHistory& a = found.results.structures[0];
    for (std::size_t node = 0; node < a.nodes.size(); ++node) {
      const std::size_t at = a.node_displacement.size() - 3 * (a.nodes.size() - node);
      EXPECT_NEAR(a.node_displacement[at], 20, 1e-7) << node;
      EXPECT_NEAR(a.node_velocity[at], 2, 1e-8) << node;
    }
  }
}

// One beam hits another at rest off its middle: both rotate, and linear and angular momentum are conserved.
TEST(FreeFrame, MeetsAnotherAndTheMomentumStays) {
  const Outcome found =
      test::run_text("structures:\n" + free_beam("a", 0, "      initial_velocity: 2 m/s\n") + free_beam("b", 0.1, "") +
                     "links: [{between: [{structure: a, node: n13}, {structure: b, node: n13}], gap: 0.1 m, law: "
                     "hertz_damped, stiffness: 1e8, restitution: 0.6}]\n"
                     "analysis: {duration: 0.3, tolerance: 1e-7}\naccept: [period, mass, section]\n");
  ASSERT_GE(found.results.impacts.size(), 1u);
  const double part = 2500 * 0.04 * 0.3;
  double momentum = 0, spin = 0, turned = 0;
  for (const StructureHistory& s : found.results.structures)
    for (int node = 0; node <= 20; ++node) {
      const double v = s.node_velocity[s.node_velocity.size() - 3 * (21 - node)],
                   mass = node % 20 == 0 ? part / 2 : part;
      momentum += mass * v;
      spin += mass * v * 0.3 * node;
      turned = std::max(turned, std::abs(v));
    }
  EXPECT_NEAR(momentum, 20 * part * 2, 1e-5 * momentum);
  EXPECT_NEAR(spin, 20 * part * 2 * 3, 1e-5 * spin);
  EXPECT_GT(turned, 2);
  EXPECT_LT(found.summary.energy.error, 1e-6);
}

// The ground moves below it.
TEST(FreeFrame, StaysWhereItIsOnAShakingGround) {
  const Outcome found =
      test::run_text("ground_motion: {pulse: {shape: sine, amplitude: 3, duration: 1}}\nstructures:\n" +
                     free_beam("a", 0, "") + "analysis: {duration: 1, tolerance: 1e-7}\n");
  const StructureHistory& a = found.results.structures[0];
  const double ground = 3 / (2 * M_PI);  // displacement after a full sine
  for (std::size_t node = 0; node < a.nodes.size(); ++node)
    EXPECT_NEAR(a.node_displacement[a.node_displacement.size() - 3 * (a.nodes.size() - node)], -ground, 1e-6);
}

// A force through its centre moves it as a single mass.
TEST(FreeFrame, IsMovedByAForce) {
  const Outcome found = test::run_text(
      "structures:\n" +
      free_beam("a", 0, "    forces: [{node: n10, pulse: {shape: half_sine, amplitude: 20 kN, duration: 0.5}}]\n") +
      "analysis: {duration: 1, tolerance: 1e-7}\n");
  const StructureHistory& a = found.results.structures[0];
  double mean = 0;
  for (int node = 0; node <= 20; ++node)
    mean += a.node_velocity[a.node_velocity.size() - 3 * (21 - node)] * (node % 20 == 0 ? 0.5 : 1) / 20;
  EXPECT_NEAR(mean, 20e3 * 0.5 * 2 / M_PI / (2500 * 0.04 * 6), 1e-6);
}

// A model without excitation gets a warning; one that is displaced, moving, forced or shaken does not.
TEST(Starts, OfNothingAreTold) {
  const auto warnings = [](const std::string& start, const std::string& more = "") {
    return test::run_text("structures:\n  a: {oscillator: {mass: 100 t, period: 0.8}, damping: 5 %" + start + "}\n" +
                          more + "analysis: {duration: 0.1}\n")
        .summary.warnings;
  };
  const std::vector<std::string> none;
  ASSERT_EQ(warnings("").size(), 1u);
  EXPECT_NE(warnings("")[0].find("nothing moved"), std::string::npos);
  EXPECT_EQ(warnings("", "accept: [motion]\n"), none);
  EXPECT_EQ(warnings(", initial_displacement: 1 mm"), none);
  EXPECT_EQ(warnings(", forces: [{pulse: {shape: half_sine, amplitude: 1 kN, duration: 0.05}}]"), none);
  EXPECT_EQ(warnings(", initial_velocity: 1 mm/s"), none);
  EXPECT_EQ(warnings("", "ground_motion: {pulse: {shape: sine, amplitude: 1, duration: 1}}\n"), none);
}

}  // namespace starts_test
}  // namespace pounding
