// Large rotations of frames in time: closed forms, energy integrals, and the limit of linear frames.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>
#include "support/direct.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace turning_test {

using Eigen::VectorXd;

constexpr double pi = std::numbers::pi, gravity = 9.80665;

int unknown(const Structure& s, const std::string& label) {
  const auto found = std::find(s.unknowns.begin(), s.unknowns.end(), label);
  if (found == s.unknowns.end()) throw std::logic_error("no unknown " + label);
  return static_cast<int>(found - s.unknowns.begin());
}

// The only structure of a model with a stepper on it.
struct Motion {
  Model model;
  System system;
  std::unique_ptr<StructureSolver> base;
  std::unique_ptr<Stepper> stepper;

  Motion(const std::string& yaml, const Scheme& scheme, double tolerance, bool sparse = false, bool linear = false)
      : model(test::model_of(yaml)) {
    if (linear) model.structures[0].elastic.reset();
    system = assemble(model, true);
    if (sparse)
      base = std::make_unique<petsc::SparseSolver>(PETSC_COMM_SELF, system);
    else
      base = std::make_unique<ModalSolver>(system);
    stepper = std::make_unique<Stepper>(system, *base,
                                        StepperOptions{.tolerance = tolerance, .scheme = scheme, .max_step = 0.02});
    const auto [u, v] = initial_state(model);
    stepper->start(0, u, v);
  }
  double u(const std::string& label) const { return stepper->view().state().u[unknown(model.structures[0], label)]; }
  double v(const std::string& label) const { return stepper->view().state().v[unknown(model.structures[0], label)]; }
  double imbalance() const {
    const Energies e = stepper->view().energies();
    return (e.input - e.kinetic - e.strain - e.damping - e.impact) / e.input;
  }
};

// A nearly rigid rod on a rotational spring with a mass on top.
constexpr double rod_length = 2, rod_mass = 100, rod_spring = 4e3, rod_turn = 1.2;

std::string pendulum(bool heavy, double velocity, bool in_space = false) {
  const std::string y = in_space ? ", 0" : "";
  return fmt::format(
      "structures:\n  rod: {{frame: {{geometry: corotational, gravity: {}, material: {{E: 1e9, G: 1e9}},\n"
      "    sections: {{s: {{area: 1, inertia_y: 1, inertia_z: 1, torsion: 1}}}},\n"
      "    nodes: {{a: [0{}, 0], b: [0{}, {}]}}, members: {{rod: {{between: [a, b], section: s}}}},\n"
      "    supports: {{a: {{fix: [ux, {}uz{}], springs: {{ry: {}}}}}}}, masses: {{b: {}}}, floors: [{{nodes: [b], "
      "rigid: false}}]}},\n"
      "    damping: 0, initial_velocity: {:.17g}}}\nlinks: []\nanalysis: {{duration: 1}}\n",
      heavy, y, y, rod_length, in_space ? "uy, " : "", in_space ? ", rx, rz" : "", rod_spring, rod_mass, velocity);
}

// Energy without the kinetic part at this rotation: m L^2 w^2/2 + k t^2/2 - m g L (1 - cos t) is constant.
double pendulum_energy(double turn, double g) {
  return 0.5 * rod_spring * turn * turn - rod_mass * g * rod_length * (1 - std::cos(turn));
}

// A quarter of the period by the midpoint rule over s with the rotation rod_turn sin s: smooth and periodic, so exact
// up to round-off.
double pendulum_quarter(double g) {
  constexpr int points = 400;
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double s = (i + 0.5) / points * pi / 2, turn = rod_turn * std::sin(s);
    const double rate =
        std::sqrt(2 * (pendulum_energy(rod_turn, g) - pendulum_energy(turn, g)) / (rod_mass * rod_length * rod_length));
    sum += rod_turn * std::cos(s) / rate;
  }
  return sum * pi / 2 / points;
}

TEST(Turning, PendulumSwingsWithItsExactPeriod) {
  for (const bool in_space : {false, true})
    for (const double g : {0.0, gravity})
      for (const auto& [name, scheme, order] : test::schemes) {
        const double velocity = std::sqrt(2 * pendulum_energy(rod_turn, g) / rod_mass), quarter = pendulum_quarter(g);
        Motion m(pendulum(g > 0, velocity, in_space), scheme, order == 2 ? 1e-4 : 1e-6);
        test::march(*m.stepper, quarter, 0.02);
        EXPECT_NEAR(m.u("node b ux"), rod_length * std::sin(rod_turn), 2e-5) << name << g;
        EXPECT_NEAR(m.u("node b uz"), rod_length * (std::cos(rod_turn) - 1), 2e-5) << name << g;
        EXPECT_NEAR(m.u("node a ry"), rod_turn, 2e-5) << name << g;
        EXPECT_NEAR(m.v("node a ry"), 0, 1e-4 * velocity) << name << g;
        test::march(*m.stepper, 4 * quarter, 0.02);
        EXPECT_NEAR(m.u("node b ux"), 0, 1e-4 * quarter * velocity) << name << g;
        EXPECT_NEAR(m.v("node b ux"), velocity, 1e-4 * velocity) << name << g;
        EXPECT_NEAR(m.v("node a ry"), velocity / rod_length, 1e-4 * velocity) << name << g;
        EXPECT_LT(std::abs(m.imbalance()), 1e-5) << name << g;
      }
}

// The mast of tests/verification/turning_mast.py, the source of the reference values.
std::string mast(bool heavy, double velocity = 6, const std::string& damping = "0",
                 const std::string& geometry = "corotational") {
  return fmt::format(
      "structures:\n  mast: {{frame: {{geometry: {}, gravity: {}, material: {{E: 1e10}},\n"
      "    sections: {{s: {{area: 2e-4, inertia_y: 4e-6}}}},\n"
      "    nodes: {{a: [0, 0], b: [0, 1], c: [0, 2], d: [0, 3], e: [0, 4]}},\n"
      "    members: {{1: {{between: [a, b], section: s}}, 2: {{between: [b, c], section: s}}, 3: {{between: [c, d], "
      "section: s}},\n"
      "      4: {{between: [d, e], section: s}}}},\n"
      "    supports: {{a: fixed}}, masses: {{b: 50, c: 50, d: 50, e: 50}}, floors: [{{nodes: [c]}}, {{nodes: [e]}}],\n"
      "    report: {{nodes: all, members: all}}}}, damping: {}, initial_velocity: {:.17g}}}\n"
      "links: []\nanalysis: {{duration: 1}}\n",
      geometry, heavy, damping, velocity);
}

struct MastAtTheEnd {
  bool heavy;
  double x, z, vx, vz, turn;
};
constexpr MastAtTheEnd mast_at_the_end[] = {
    {false, -1.50485355670196, -0.319638566788881, 0.160976304080481, 0.660905910736644, -0.547953348089647},
    {true, -1.65236031776303, -0.39404774573751, -2.33543112215688, 0.222841347644037, -0.595214876366845}};

double distance_of(const Motion& m, const MastAtTheEnd& end) {
  const Structure& s = m.model.structures[0];
  const double settled = s.at_rest.size() > 0 ? s.at_rest[unknown(s, "node e uz")] : 0;
  return std::max({std::abs(m.u("node e ux") - end.x), std::abs(m.u("node e uz") + settled - end.z),
                   std::abs(m.v("node e ux") - end.vx) / 10, std::abs(m.v("node e uz") - end.vz) / 10,
                   std::abs(m.u("node e ry") - end.turn)});
}

TEST(Turning, MastThatIsThrownMovesAsItsEnergySays) {
  for (const MastAtTheEnd& end : mast_at_the_end)
    for (const bool sparse : {false, true}) {
      Motion m(mast(end.heavy), {.kind = Scheme::Kind::esdirk4}, 1e-8, sparse);
      test::march(*m.stepper, 1, 0.02);
      EXPECT_LT(distance_of(m, end), 1e-6) << end.heavy << sparse;
      EXPECT_LT(std::abs(m.imbalance()), 1e-7) << end.heavy << sparse;
    }
}

TEST(Turning, HalvingTheStepShowsTheOrderOfTheScheme) {
  const MastAtTheEnd& end = mast_at_the_end[1];
  for (const auto& [name, scheme, order] : test::schemes) {
    std::vector<double> errors;
    const double h = order == 2 ? 1.0 / 16384 : 1.0 / 4096;
    for (const double step : {h, h / 2}) {
      Motion m(mast(true), scheme, 1e-8);
      test::march_evenly(*m.stepper, 1, step);
      errors.push_back(distance_of(m, end));
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), order, 0.15) << name << " " << errors[0];
  }
}

// Compared with the linear frame of the same stiffness at rest: terms of second order in the amplitude remain.
TEST(Turning, SmallMotionIsThatOfTheStiffnessAtRest) {
  for (const bool heavy : {false, true}) {
    std::vector<double> apart;
    for (const double velocity : {0.02, 0.01}) {
      Motion turning(mast(heavy, velocity, "2 %"), {.kind = Scheme::Kind::esdirk4}, 1e-9);
      Motion linear(mast(heavy, velocity, "2 %"), {.kind = Scheme::Kind::esdirk4}, 1e-9, false, true);
      test::march(*turning.stepper, 0.5, 0.02);
      test::march(*linear.stepper, 0.5, 0.02);
      apart.push_back((turning.stepper->view().state().u - linear.stepper->view().state().u).cwiseAbs().maxCoeff());
      EXPECT_LT(std::abs(turning.imbalance()), 1e-6);
    }
    EXPECT_LT(apart[0], 1e-4);
    EXPECT_NEAR(apart[0] / apart[1], 4, 0.1) << heavy;
  }
}

// A column of n members under a third of its buckling load. P-Delta bends each member; corotational ones are straight
// between their nodes, and the difference is of second order in their length.
double frequency_of_column(int members, const std::string& geometry) {
  std::string nodes = "n0: [0, 0]", between;
  for (int i = 1; i <= members; ++i) {
    nodes += fmt::format(", n{}: [0, {:.17g}]", i, 4.0 * i / members);
    between += fmt::format("{}m{}: {{between: [n{}, n{}], section: s}}", i > 1 ? ", " : "", i, i - 1, i);
  }
  const double buckling = pi * pi * 4e4 / 64;  // pi^2 EI/(2 L)^2
  return test::model_of(
             fmt::format("structures:\n  column: {{frame: {{geometry: {0}, gravity: true, material: {{E: 1e10}},\n"
                         "    sections: {{s: {{area: 0.01, inertia_y: 4e-6, shear: false}}}}, nodes: {{{1}}}, members: "
                         "{{{2}}},\n"
                         "    supports: {{n0: fixed}}, masses: {{n{3}: {4:.17g}}}}}, damping: 0}}\nlinks: "
                         "[]\nanalysis: {{duration: 1}}\n",
                         geometry, nodes, between, members, buckling / 3 / gravity))
      .structures[0]
      .frequencies[0];
}

TEST(Turning, FrequenciesUnderWeightsAreThoseOfPDelta) {
  const double exact = frequency_of_column(16, "p_delta");
  const double coarse = frequency_of_column(4, "corotational") / exact - 1,
               fine = frequency_of_column(8, "corotational") / exact - 1;
  EXPECT_LT(std::abs(fine), 1e-2);
  EXPECT_NEAR(coarse / fine, 4, 0.3);
  EXPECT_GT(std::abs(frequency_of_column(8, "linear") / exact - 1), 0.1);
}

// Consistency of the reports: the storey shear accelerates the masses above, and the tip is held by its member alone.
TEST(Turning, ShearsAndEndForcesMoveTheMasses) {
  for (const std::string scheme : {"generalized_alpha", "esdirk4"}) {
    std::string text = mast(true);
    text.replace(text.find("{duration: 1}"), 13,
                 "{duration: 1, tolerance: 1e-6, output_step: 1 ms, integrator: " + scheme + "}");
    const StructureHistory h = test::run_text(text).results.structures[0];
    const std::size_t times = h.storey_shear.size() / 2;
    ASSERT_EQ(times, 1001u);
    ASSERT_EQ(h.end_forces.size(), times * 24);
    for (std::size_t i = 0; i < times; ++i) {
      const auto acceleration = [&](int node, int direction) {
        return h.node_acceleration[(i * 5 + node) * 3 + direction];
      };
      const double below_c = -50 * (acceleration(2, 0) + acceleration(3, 0) + acceleration(4, 0));
      ASSERT_NEAR(h.storey_shear[2 * i], below_c, 1e-3 * 1e4) << scheme << i;
      const double* end = h.end_forces.data() + i * 24 + 21;
      ASSERT_NEAR(std::hypot(end[0], end[1]), 50 * std::hypot(acceleration(4, 0), acceleration(4, 1) + gravity),
                  1e-3 * 1e4)
          << scheme << i;
      ASSERT_NEAR(end[2], 0, 1e-3 * 1e4) << scheme << i;
    }
    // Rotations have no mass; their velocity is the rate of the reported rotations.
    for (std::size_t i = 2; i + 2 < times; ++i) {
      const auto value = [&](const std::vector<double>& of, int shift) { return of[((i + shift) * 5 + 4) * 3 + 2]; };
      const auto slope = [&](const std::vector<double>& of) {
        return (8 * (value(of, 1) - value(of, -1)) - (value(of, 2) - value(of, -2))) / (12 * 0.001);
      };
      ASSERT_NEAR(slope(h.node_displacement), value(h.node_velocity, 0), 5e-3 * 10) << scheme << i;
      ASSERT_NEAR(slope(h.node_velocity), value(h.node_acceleration, 0), 5e-3 * 1e3) << scheme << i;
    }
  }
}

// Two masts, one launched at the other.
std::string two_masts(const std::string& analysis) {
  std::string text = mast(true, 6, "1 %");
  const std::size_t from = text.find("  mast:"), to = text.find("links:");
  std::string other = text.substr(from, to - from);
  other.replace(0, 7, "  neighbour:");
  other.replace(other.find("{geometry"), 1, "{origin: [0.4], ");
  const std::size_t speed = other.find(", initial_velocity");
  return text.substr(0, to) + other.substr(0, speed) + "}\n" +
         "links: [{between: [mast.2, neighbour.2], gap: 400 mm, law: hertz_damped, stiffness: 1e7, restitution: "
         "0.6}]\n" +
         analysis;
}

TEST(Turning, MastsThatHitEachOtherCloseTheirEnergy) {
  for (const char* scheme : {"integrator: generalized_alpha", "integrator: esdirk4"}) {
    const std::string text =
        two_masts(std::string("analysis: {duration: 0.6, tolerance: 1e-5, output_step: 20 ms, ") + scheme + "}\n");
    const Outcome run = test::run_text(text), again = test::run_text(text);
    ASSERT_GT(run.results.impacts.size(), 0u);
    EXPECT_GT(run.summary.energy.impact, 0.01 * run.summary.energy.input);
    EXPECT_GT(run.summary.energy.damping, 0.01 * run.summary.energy.input);
    EXPECT_LT(run.summary.energy.error, 1e-5) << scheme;
    EXPECT_EQ(run.results.structures[1].node_displacement, again.results.structures[1].node_displacement);
    EXPECT_EQ(run.results.links[0].force, again.results.links[0].force);
  }
}

}  // namespace turning_test
}  // namespace pounding
