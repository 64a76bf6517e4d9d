// Frames that turn by large angles in time: closed forms, integration of their energy by other means, and the limits of
// linear frames.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/modal_base.hpp>
#include <pounding/petsc/sparse_base.hpp>
#include "analysis/direct.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace {

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
  std::unique_ptr<Base> base;
  std::unique_ptr<Stepper> stepper;

  Motion(const std::string& yaml, const Scheme& scheme, double tolerance, bool sparse = false, bool linear = false)
      : model(test::model_of(yaml)) {
    if (linear) model.structures[0].elastic.reset();
    system = assemble(model, true);
    if (sparse)
      base = std::make_unique<petsc::SparseBase>(PETSC_COMM_SELF, system);
    else
      base = std::make_unique<ModalBase>(system);
    stepper = std::make_unique<Stepper>(system, *base, StepperOptions{.tolerance = tolerance, .scheme = scheme, .first_rung = 0.02});
    const auto [u, v] = initial_state(model);
    stepper->start(0, u, v);
  }
  double u(const std::string& label) const { return stepper->state().u[unknown(model.structures[0], label)]; }
  double v(const std::string& label) const { return stepper->state().v[unknown(model.structures[0], label)]; }
  double imbalance() const {
    const Energies e = stepper->energies();
    return (e.input - e.kinetic - e.strain - e.damping - e.impact) / e.input;
  }
};

// A rod that hardly strains on a rotational spring, a mass on top.
constexpr double rod_length = 2, rod_mass = 100, rod_spring = 4e3, rod_turn = 1.2;

std::string pendulum(bool heavy, double velocity, bool in_space = false) {
  const std::string y = in_space ? ", 0" : "";
  return fmt::format(
      "structures:\n  rod: {{frame: {{geometry: corotational, gravity: {}, material: {{E: 1e9, G: 1e9}},\n"
      "    sections: {{s: {{area: 1, inertia_y: 1, inertia_z: 1, torsion: 1}}}},\n"
      "    nodes: {{a: [0{}, 0], b: [0{}, {}]}}, members: {{rod: {{between: [a, b], section: s}}}},\n"
      "    supports: {{a: {{fix: [ux, {}uz{}], springs: {{ry: {}}}}}}}, masses: {{b: {}}}, floors: [{{nodes: [b], rigid: false}}]}},\n"
      "    damping: 0, initial_velocity: {:.17g}}}\nlinks: []\nanalysis: {{duration: 1}}\n",
      heavy, y, y, rod_length, in_space ? "uy, " : "", in_space ? ", rx, rz" : "", rod_spring, rod_mass, velocity);
}

// Of the turn: m L^2 w^2/2 + k t^2/2 - m g L (1 - cos t) is constant.
double pendulum_energy(double turn, double g) {
  return 0.5 * rod_spring * turn * turn - rod_mass * g * rod_length * (1 - std::cos(turn));
}

// A quarter of the period by the midpoint rule over s, turn = rod_turn sin s, which is smooth and so exact to rounding.
double pendulum_quarter(double g) {
  constexpr int points = 400;
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double s = (i + 0.5) / points * pi / 2, turn = rod_turn * std::sin(s);
    const double rate = std::sqrt(2 * (pendulum_energy(rod_turn, g) - pendulum_energy(turn, g)) / (rod_mass * rod_length * rod_length));
    sum += rod_turn * std::cos(s) / rate;
  }
  return sum * pi / 2 / points;
}

TEST(Turning, PendulumSwingsWithItsExactPeriod) {
  for (const bool in_space : {false, true})
    for (const double g : {0.0, gravity})
      for (const auto& [name, scheme, order] : test::schemes) {
        const double velocity = std::sqrt(2 * pendulum_energy(rod_turn, g) / rod_mass), quarter = pendulum_quarter(g);
        Motion m(pendulum(g > 0, velocity, in_space), scheme, order == 2 ? 1e-5 : 1e-7);
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

// The mast of tests/verification/turning_mast.py, which is where the numbers come from.
std::string mast(bool heavy, double velocity = 6, const std::string& damping = "0", const std::string& geometry = "corotational") {
  return fmt::format("structures:\n  mast: {{frame: {{geometry: {}, gravity: {}, material: {{E: 1e10}},\n"
                     "    sections: {{s: {{area: 0.01, inertia_y: 4e-6}}}},\n"
                     "    nodes: {{a: [0, 0], b: [0, 1], c: [0, 2], d: [0, 3], e: [0, 4]}},\n"
                     "    members: {{1: {{between: [a, b], section: s}}, 2: {{between: [b, c], section: s}}, 3: {{between: [c, d], section: s}},\n"
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
    {false, -1.53068043851149, -0.35546947832598, 1.04164665559407, -0.929654916876524, -0.545153046493866},
    {true, -1.6630070822959, -0.411053480996892, -1.14943569594996, -2.12389609691637, -0.582055586760455}};

double distance_of(const Motion& m, const MastAtTheEnd& end) {
  const Structure& s = m.model.structures[0];
  const double settled = s.at_rest.size() > 0 ? s.at_rest[unknown(s, "node e uz")] : 0;
  return std::max({std::abs(m.u("node e ux") - end.x), std::abs(m.u("node e uz") + settled - end.z),
                   std::abs(m.v("node e ux") - end.vx) / 10, std::abs(m.v("node e uz") - end.vz) / 10, std::abs(m.u("node e ry") - end.turn)});
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

}  // namespace
}  // namespace pounding
