// Forces over time: Duhamel's integral, modal superposition, forces equivalent to a ground motion, energies, links and
// frames.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "support/book.hpp"
#include "support/dense.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace forces_test {

constexpr double pi = std::numbers::pi;

using Force = std::function<double(double)>;

struct Motion {
  double u = 0, v = 0;
};

// Duhamel's integral for u'' + 2 ratio w u' + w^2 u = force from rest: Gauss quadrature on short intervals between the
// breaks.
Motion duhamel(double w, double ratio, const Force& force, std::vector<double> breaks, double end) {
  constexpr std::array<double, 5> points{0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                                         -0.9061798459386640},
      weights{0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891, 0.2369268850561891};
  const double damped = w * std::sqrt(1 - ratio * ratio);
  Motion sum;
  double begin = 0;
  breaks.push_back(end);
  for (const double each : breaks) {
    const double to = std::min(each, end);
    const int pieces = std::max(20, static_cast<int>(400 * (to - begin)));
    for (int i = 0; i < pieces; ++i) {
      const double half = (to - begin) / pieces / 2, middle = begin + (2 * i + 1) * half;
      for (std::size_t k = 0; k < points.size(); ++k) {
        const double t = middle + points[k] * half, s = end - t,
                     f = weights[k] * half * force(t) * std::exp(-ratio * w * s);
        sum.u += f * std::sin(damped * s) / damped;
        sum.v += f * (std::cos(damped * s) - ratio * w / damped * std::sin(damped * s));
      }
    }
    begin = to;
  }
  return sum;
}

// A force in input syntax, and the same as a function.
struct Given {
  std::string text;
  Force force;
  std::vector<double> breaks;
};

std::vector<Given> courses() {
  const auto within = [](double t, double begin, double end) { return t >= begin && t < end; };
  return {
      {"step_force: {amplitude: 20 kN, start: 0.1}", [](double t) { return t >= 0.1 ? 20e3 : 0; }, {0.1}},
      {"step_force: {amplitude: -20 kN, rise: 0.7}", [](double t) { return -20e3 * std::min(1.0, t / 0.7); }, {0.7}},
      {"harmonic: {amplitude: 20 kN, period: 0.37, duration: 1.4, start: 0.2, phase: 40 deg}",
       [=](double t) { return within(t, 0.2, 1.6) ? 20e3 * std::sin(2 * pi * (t - 0.2) / 0.37 + 40 * pi / 180) : 0; },
       {0.2, 1.6}},
      {"harmonic: {amplitude: 20 kN, frequency: 4 Hz, duration: 0.9}",
       [=](double t) { return within(t, 0, 0.9) ? 20e3 * std::sin(8 * pi * t) : 0; },
       {0.9}},
      {"pulse: {shape: half_sine, amplitude: 100 kN, duration: 0.15}",
       [=](double t) { return within(t, 0, 0.15) ? 100e3 * std::sin(pi * t / 0.15) : 0; },
       {0.15}},
      {"pulse: {shape: sine, amplitude: 100 kN, duration: 2 ms, start: 0.3}",
       [=](double t) { return within(t, 0.3, 0.302) ? 100e3 * std::sin(2 * pi * (t - 0.3) / 0.002) : 0; },
       {0.3, 0.302}},
      {"sum: [{amplitude: 10 kN, period: 0.3}, {amplitude: 5 kN, frequency: 9 Hz, phase: 1}], duration: 1.1, start: "
       "0.1",
       [=](double t) {
         return within(t, 0.1, 1.2)
                    ? 10e3 * std::sin(2 * pi * (t - 0.1) / 0.3) + 5e3 * std::sin(18 * pi * (t - 0.1) + 1)
                    : 0;
       },
       {0.1, 1.2}}};
}

struct Scheme {
  const char* name;
  double tolerance;
};

class Forces : public testing::TestWithParam<Scheme> {
 protected:
  std::string analysis(double duration) const {
    return fmt::format("analysis: {{duration: {}, tolerance: {}, integrator: {}, output_step: {}}}\n", duration,
                       GetParam().tolerance, GetParam().name, duration / 100);
  }
  std::string label(const char* what) const {
    return fmt::format("{}, {:g}: {}", GetParam().name, GetParam().tolerance, what);
  }
};

TEST_P(Forces, MoveAnOscillatorAsDuhamelSays) {
  test::Book book("Forces over time", "Duhamel's integral of an oscillator, by Gauss' rule",
                  "the tolerance of the run, for each period of the motion");
  constexpr double mass = 10e3, period = 0.5, w = 2 * pi / period, length = 2;
  for (const double ratio : {0.0, 0.05})
    for (const Given& given : courses()) {
      SCOPED_TRACE(given.text);
      const Outcome found = test::run_text(
          fmt::format("structures:\n  a: {{oscillator: {{mass: {}, period: {}, damping: {}}}, forces: [{{{}}}]}}\n",
                      mass, period, ratio, given.text) +
          analysis(length));
      const Motion expected = duhamel(w, ratio, [&](double t) { return given.force(t) / mass; }, given.breaks, length);
      const StructureHistory& a = found.results.structures[0];
      double largest = 0;
      for (std::size_t i = 0; i < a.displacement.size(); ++i)
        largest = std::max({largest, std::abs(a.displacement[i]), std::abs(a.velocity[i]) / w});
      const double error =
          std::hypot(a.displacement.back() - expected.u, (a.velocity.back() - expected.v) / w) / largest;
      book.below(label("error of the motion, over the tolerance [-]"), error / GetParam().tolerance / (length / period),
                 1);
      // Under the same sum of harmonics as ground motion the imbalance is 1.5 to 2 times the tolerance.
      book.below(label("imbalance of the energies, over the tolerance [-]"),
                 found.summary.energy.error / GetParam().tolerance, 2);
    }
}

const std::string building =
    "shear_building: {storeys: 3, mass: [30 t, 25 t, 20 t], stiffness: [40 MN/m, 30 MN/m, 20 MN/m]}, damping: {modal: "
    "{ratio: 4 %}}";

TEST_P(Forces, MoveABuildingAsItsModesDo) {
  test::Book book("Forces over time", "superposition of the modes of a building, each by Duhamel's integral",
                  "the tolerance of the run, for each period of the motion");
  const Eigen::Vector3d mass(30e3, 25e3, 20e3);
  const Eigen::Matrix3d stiffness{{70e6, -30e6, 0}, {-30e6, 50e6, -20e6}, {0, -20e6, 20e6}};
  const test::dense::Modes modes = test::dense::modes(stiffness, mass.asDiagonal().toDenseMatrix());
  const std::vector<Given> given = courses();
  constexpr std::array<std::pair<int, int>, 3> acting{{{2, 2}, {0, 4}, {1, 5}}};  // floor, index of the time function
  std::string forces;
  for (const auto& [floor, course] : acting)
    forces += fmt::format("{}{{floor: {}, {}}}", forces.empty() ? "" : ", ", floor + 1, given[course].text);
  constexpr double length = 2;
  const Outcome found =
      test::run_text(fmt::format("structures:\n  a: {{{}, forces: [{}]}}\n", building, forces) + analysis(length));
  Eigen::Vector3d expected = Eigen::Vector3d::Zero();
  double w = 0;
  for (int k = 0; k < 3; ++k) {
    w = std::sqrt(modes.squares[k]);
    for (const auto& [floor, course] : acting)
      expected += modes.shapes.col(k) *
                  duhamel(
                      w, 0.04, [&, k](double t) { return modes.shapes(floor, k) * given[course].force(t); },
                      given[course].breaks, length)
                      .u;
  }
  const StructureHistory& a = found.results.structures[0];
  double largest = 0;
  for (const double u : a.displacement) largest = std::max(largest, std::abs(u));
  for (int i = 0; i < 3; ++i)
    book.below(label("error of a floor, over the tolerance [-]"),
               std::abs(a.displacement[a.displacement.size() - 3 + i] - expected[i]) / largest / GetParam().tolerance /
                   (length * w / 2 / pi),
               1);
  book.below(label("imbalance of the energies, over the tolerance [-]"),
             found.summary.energy.error / GetParam().tolerance, 1);
}

// On every floor the mass times the ground acceleration, in the opposite direction.
TEST_P(Forces, OfTheMassesMoveAsTheGroundDoes) {
  const std::string course = "harmonic: {{amplitude: {}, period: 0.3, duration: 1}}";
  std::string forces;
  for (const auto& [floor, mass] : {std::pair(1, 30e3), {2, 25e3}, {3, 20e3}})
    forces +=
        fmt::format("{}{{floor: {}, {}}}", floor == 1 ? "" : ", ", floor, fmt::format(fmt::runtime(course), -3 * mass));
  const std::string structure = "structures:\n  a: {" + building;
  const Outcome pushed = test::run_text(structure + ", forces: [" + forces + "]}\n" + analysis(1.5));
  const Outcome shaken = test::run_text("ground_motion: {" + fmt::format(fmt::runtime(course), 3) + "}\n" + structure +
                                        "}\n" + analysis(1.5));
  const StructureHistory &a = pushed.results.structures[0], &b = shaken.results.structures[0];
  ASSERT_EQ(a.displacement.size(), b.displacement.size());
  double largest = 0, error = 0;
  for (std::size_t i = 0; i < a.displacement.size(); ++i) {
    largest = std::max(largest, std::abs(b.displacement[i]));
    error = std::max(error, std::abs(a.displacement[i] - b.displacement[i]));
  }
  EXPECT_LT(error, 2 * GetParam().tolerance * largest);
  EXPECT_NEAR(pushed.summary.energy.input, shaken.summary.energy.input,
              10 * GetParam().tolerance * shaken.summary.energy.input);
}

// A very short impulse leaves the velocity impulse / mass on its floor.
TEST_P(Forces, MayBeShorterThanAnyStep) {
  for (const double duration : {1e-5, 1e-4, 1e-3})
    for (const char* shape : {"half_sine", "rectangle", "sine"}) {
      SCOPED_TRACE(fmt::format("{} of {:g} s", shape, duration));
      const double mean = shape == std::string("half_sine") ? 2 / pi : shape == std::string("rectangle") ? 1 : 0;
      const double amplitude = 10e3 / duration;
      const Outcome found = test::run_text(
          fmt::format(
              "structures:\n  a: {{{}, forces: [{{floor: 3, pulse: {{shape: {}, amplitude: {}, duration: {}}}}}]}}\n",
              building, shape, amplitude, duration) +
          analysis(0.5));
      EXPECT_LT(found.summary.energy.error, GetParam().tolerance);
      if (mean == 0) continue;
      const Outcome kicked = test::run_text(
          fmt::format("structures:\n  a: {{{}, initial_velocity: [0, 0, {}]}}\n", building, 10e3 * mean / 20e3) +
          analysis(0.5));
      const double largest = *std::ranges::max_element(kicked.results.structures[0].displacement);
      // Late by half its duration.
      EXPECT_NEAR(found.results.structures[0].displacement.back(), kicked.results.structures[0].displacement.back(),
                  (4 * GetParam().tolerance + 30 * duration) * largest);
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Forces,
                         testing::Values(Scheme{"esdirk4", 1e-4}, Scheme{"esdirk4", 1e-6},
                                         Scheme{"generalized_alpha", 1e-4}, Scheme{"generalized_alpha", 1e-6}),
                         [](const auto& test) {
                           return fmt::format("{}_{:.0f}", test.param.name, -std::log10(test.param.tolerance));
                         });

// Two oscillators driven by their masses times -ag collide as under the ground motion.
TEST(ForcesOnAPair, MeetAsOnAShakingGround) {
  for (const char* law :
       {"hertz_damped, stiffness: 2.75e9, restitution: 0.65", "stereomechanical, restitution: 0.65"}) {
    const std::string shaken = test::two_oscillators(law, 1e-7, 1.5);
    std::string pushed = shaken;
    const auto replace = [&](const std::string& from, const std::string& to) {
      pushed.replace(pushed.find(from), from.size(), to);
    };
    replace("ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\n", "");
    replace("left:  {", "left: {forces: [{harmonic: {amplitude: -300 kN, period: 0.6, duration: 3}}], ");
    replace("right: {", "right: {forces: [{harmonic: {amplitude: -450 kN, period: 0.6, duration: 3}}], ");
    const Outcome by_ground = test::run_text(shaken), by_force = test::run_text(pushed);
    ASSERT_EQ(by_ground.results.impacts.size(), by_force.results.impacts.size());
    ASSERT_GE(by_force.results.impacts.size(), 2u);
    for (std::size_t i = 0; i < by_force.results.impacts.size(); ++i) {
      const ImpactRow &a = by_ground.results.impacts[i], &b = by_force.results.impacts[i];
      EXPECT_NEAR(a.t_start, b.t_start, 1e-6);
      EXPECT_NEAR(a.impulse, b.impulse, 1e-5 * a.impulse);
    }
    EXPECT_LT(by_force.summary.energy.error, 1e-6);
  }
}

// A body at rest is hit by one that a force drives.
TEST(ForcesOnAPair, DriveABodyIntoAnother) {
  const Outcome run = test::run_text(
      "structures:\n  a: {body: {mass: 2 t}, forces: [{pulse: {shape: rectangle, amplitude: 10 kN, duration: 0.2}}]}\n "
      " b: {body: {mass: 2 t}}\n"
      "links: [{between: [a, b], gap: 0.5 m, law: stereomechanical, restitution: 1}]\nanalysis: {duration: 1, "
      "tolerance: 1e-6}\n");
  ASSERT_EQ(run.results.impacts.size(), 1u);
  EXPECT_NEAR(run.results.impacts[0].t_start, 0.1 + 0.5, 1e-9);  // 1 m/s after 0.1 m in 0.2 s
  EXPECT_NEAR(run.results.structures[0].velocity.back(), 0, 1e-9);
  EXPECT_NEAR(run.results.structures[1].velocity.back(), 1, 1e-9);
  EXPECT_NEAR(run.summary.energy.input, 1000, 1e-6);
}

std::string bent(const std::string& more, double duration, const std::string& geometry = "linear") {
  return fmt::format(
      "structures:\n"
      "  a:\n"
      "    frame:\n"
      "      material: {{E: 30 GPa, density: 2500 kg/m^3}}\n"
      "      mass: consistent\n"
      "      geometry: {}\n"
      "      nodes: {{a: [0, 0], b: [0, 3 m], c: [6 m, 3 m], d: [6 m, 0]}}\n"
      "      members:\n"
      "        left: {{between: [a, b], section: {{circle: 0.2 m}}}}\n"
      "        beam: {{between: [b, c], section: {{circle: 0.2 m}}}}\n"
      "        right: {{between: [d, c], section: {{circle: 0.2 m}}}}\n"
      "      supports: {{a: fixed, d: fixed}}\n"
      "      masses: {{b: 10 t, c: 10 t}}\n"
      "      gravity: false\n"
      "      report: {{nodes: all, members: all}}\n"
      "{}"
      "    damping: 20 %\n"
      "analysis: {{duration: {}, tolerance: 1e-7, output_step: {}}}\n",
      geometry, more, duration, duration);
}

// After a slow rise the frame is at its static equilibrium, including end forces and reactions.
TEST(ForcesOnAFrame, ThatRiseSlowlyAreStaticLoads) {
  for (const char* geometry : {"linear", "corotational"}) {
    SCOPED_TRACE(geometry);
    const double factor = geometry == std::string("linear") ? 1 : 3;  // large enough for rotations
    const Outcome loaded = test::run_text(
        bent(fmt::format("      loads: {{b: {{ux: {}, uz: -20 kN, ry: 15 kN m}}}}\n", factor * 12e3), 1, geometry));
    const Outcome pushed =
        test::run_text(bent(fmt::format("    forces:\n      - {{node: b, step_force: {{amplitude: {}, rise: 20}}}}\n"
                                        "      - {{node: b, dof: uz, step_force: {{amplitude: -20 kN, rise: 20}}}}\n"
                                        "      - {{node: b, dof: ry, step_force: {{amplitude: 15 kN m, rise: 20}}}}\n",
                                        factor * 12e3),
                            40, geometry));
    const StructureHistory &a = loaded.results.structures[0], &b = pushed.results.structures[0];
    const auto compare = [&](const std::vector<double>& of_loads, const std::vector<double>& of_forces,
                             std::size_t each, const char* what) {
      double largest = 0;
      for (std::size_t i = 0; i < each; ++i) largest = std::max(largest, std::abs(of_loads[i]));
      for (std::size_t i = 0; i < each; ++i)
        EXPECT_NEAR(of_loads[of_loads.size() - each + i], of_forces[of_forces.size() - each + i], 1e-5 * largest)
            << what << " " << i;
    };
    compare(a.node_displacement, b.node_displacement, 12, "displacement");
    compare(a.end_forces, b.end_forces, 18, "end force");
    compare(a.reaction, b.reaction, 6, "reaction");
    EXPECT_LT(pushed.summary.energy.error, 1e-6);
  }
}

// A floor is equivalent to the node by which it moves.
TEST(ForcesOnAFrame, ActOnFloorsAsOnTheirNodes) {
  const std::string course = "step_force: {amplitude: 10 kN}";
  const std::string floors = "      floors: [{nodes: [b, c]}]\n";
  const Outcome by_floor = test::run_text(bent(floors + "    forces: [{floor: 1, " + course + "}]\n", 1));
  const Outcome by_node = test::run_text(bent(floors + "    forces: [{node: b, dof: ux, " + course + "}]\n", 1));
  EXPECT_EQ(by_floor.results.structures[0].node_displacement, by_node.results.structures[0].node_displacement);
  EXPECT_GT(std::ranges::max(by_floor.results.structures[0].node_displacement), 1e-4);
}

// The schemes keep their order under a force that is smooth inside the steps.
TEST(ForcesOrder, IsThatOfTheScheme) {
  for (const auto& [scheme, order] : {std::pair("esdirk4", 4.0), std::pair("generalized_alpha", 2.0)}) {
    const Force force = [](double t) { return 20 * std::sin(2 * pi * t / 4 + 0.3); };
    const Motion exact = duhamel(2 * pi, 0.02, force, {}, 2);
    std::vector<double> errors;
    for (const double step : {0.05, 0.025}) {
      const Outcome run = test::run_text(
          fmt::format("structures: {{a: {{oscillator: {{mass: 1 t, period: 1}}, damping: 2 %, forces: [{{harmonic: "
                      "{{amplitude: 20 kN, period: 4, duration: 2.0, phase: 0.3}}}}]}}}}\n"
                      "analysis: {{duration: 2, tolerance: 0.1, max_step: {}, integrator: {}, output_step: 2}}\n",
                      step, scheme));
      errors.push_back(std::abs(run.results.structures[0].displacement.back() - exact.u));
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), order, 0.4) << scheme << " " << errors[0] << " " << errors[1];
  }
}

}  // namespace forces_test
}  // namespace pounding
