// Elements with two deformations in the time integration: on masses, in series with massless unknowns, and together
// with contacts and springs of one deformation.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <Eigen/LU>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/links/gap_contact.hpp>
#include <pounding/stepping/stepper.hpp>
#include <pounding/structures/coupled_bouc_wen.hpp>
#include <pounding/structures/coupled_pendulum.hpp>
#include "support/book.hpp"
#include "support/direct.hpp"
#include "support/elements.hpp"

namespace pounding {
namespace coupled_elements_test {

using Eigen::Vector2d;
using std::numbers::pi;
using test::diagonal;

constexpr double mass = 1e5;

// Two horizontal unknowns of one mass, or of a mass and a massless node in series, on harmonic ground motion with
// different periods along x and y.
struct Problem {
  static constexpr double amplitude[] = {3, 2}, period[] = {0.7, 0.45}, duration = 1.5;
  std::unique_ptr<Element> element;
  std::unique_ptr<const Contact> contact;
  System system;

  // `series` > 0: stiffness between the mass and the node on the element [N/m]. `motions` along x and y.
  explicit Problem(std::unique_ptr<Element> on, double series = 0, std::vector<GroundMotion> motions = {})
      : element(std::move(on)) {
    const int n = series > 0 ? 4 : 2, node = n - 2;
    std::vector<double> masses(n, 0.0);
    masses[0] = masses[1] = mass;
    system.mass = diagonal(masses);
    system.damping = SparseMatrix(n, n);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n), b = Eigen::MatrixXd::Zero(n, 2);
    for (int i = 0; i < 2; ++i) {
      k(node + i, node + i) += element->stiffness(i);
      b(node + i, i) = 1;
      if (series == 0) continue;
      k(i, i) += series, k(node + i, node + i) += series;
      k(i, node + i) -= series, k(node + i, i) -= series;
    }
    system.stiffness = k.sparseView();
    system.gap_jacobian = b.sparseView();
    system.elements = {element.get()};
    system.is_part = {true, true};
    system.load = Eigen::MatrixXd::Zero(n, 2);
    system.grounds = std::move(motions);
    for (int i = 0; i < 2; ++i) {
      if (system.grounds.size() < 2) system.grounds.emplace_back(Harmonic{amplitude[i], period[i], duration});
      system.load(i, i) = mass;
    }
    system.groups = {{0, n, 1e-4, 1e-3}};
    system.outputs = SparseMatrix(n, 0);
  }

  // A wall at a distance along x.
  void add_wall(double gap, double stiffness) {
    contact = std::make_unique<GapContact<laws::LinearSpring>>(laws::LinearSpring{.stiffness = stiffness}, gap);
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(system.size(), 3);
    b(0, 0) = 1;
    b.rightCols(2) = Eigen::MatrixXd(system.gap_jacobian);
    system.gap_jacobian = b.sparseView();
    system.contacts = {contact.get()};
  }

  static double ground(int i, double t) { return t < duration ? amplitude[i] * std::sin(2 * pi * t / period[i]) : 0.0; }
};

constexpr double k = 1e7, yield_force = 1.5e5, yield = yield_force / k, hardening = 0.05;

std::unique_ptr<Element> bouc_wen() {
  return std::make_unique<CoupledBoucWen>(
      hysteresis::BoucWen{.initial_stiffness = k, .yield_force = yield_force, .hardening = hardening});
}

// dz/dd of that law with n = 2 and g = 1/2, while it is loaded (z.dd > 0) or unloaded.
Eigen::Matrix2d flow(const Vector2d& z, bool is_loaded) {
  const Eigen::Matrix2d elastic = Eigen::Matrix2d::Identity();
  return is_loaded ? Eigen::Matrix2d(elastic - z * z.transpose() / (yield * yield)) : elastic;
}

// u, v of the mass, d and z of the element; contact with a wall and its work.
Eigen::VectorXd direct(double end, double series, double gap, double wall) {
  const auto f = [&](double t, const Eigen::VectorXd& y) {
    const Vector2d u = y.head(2), v = y.segment(2, 2), z = y.segment(6, 2);
    const Vector2d d = series > 0 ? Vector2d(y.segment(4, 2)) : u;
    Vector2d force = hardening * k * d + (1 - hardening) * k * z;
    if (wall > 0) force[0] += wall * std::max(0.0, u[0] - gap);
    const auto rate_of = [&](bool is_loaded) -> Vector2d {
      if (series == 0) return v;
      const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
      const Eigen::Matrix2d tangent = hardening * k * one + (1 - hardening) * k * flow(z, is_loaded);
      return (series * one + tangent).partialPivLu().solve(series * v);
    };
    const bool is_loaded = z.dot(rate_of(true)) > 0;
    const Vector2d rate = rate_of(is_loaded);
    Eigen::VectorXd out(8);
    out << v, -force / mass - Vector2d(Problem::ground(0, t), Problem::ground(1, t)), rate, flow(z, is_loaded) * rate;
    return out;
  };
  return test::integrate(f, Eigen::VectorXd::Zero(8), 0, end, 0.05, {Problem::duration});
}

class Coupled : public testing::TestWithParam<test::NamedScheme> {};

INSTANTIATE_TEST_SUITE_P(Schemes, Coupled, testing::ValuesIn(test::schemes),
                         [](const auto& test) { return std::string(test.param.name); });

// Corners of coupled elements are not located, so the error is larger than the tolerance; it decreases with it.
TEST_P(Coupled, AMassOnAnIsolatorAgreesWithAnIndependentIntegration) {
  test::Book book("Elements with two deformations", "independent integration of the coupled Bouc-Wen equations",
                  "run at tolerance 1e-7");
  for (const double series : {0.0, 2e7}) {
    static constexpr double end = 2.5;
    const Eigen::VectorXd expected = direct(end, series, 0, 0);
    Eigen::VectorXd motion(4);
    motion << expected.head(2), 0.1 * expected.segment(2, 2);
    std::vector<double> errors;
    for (const double tolerance : {1e-5, 1e-7}) {
      Problem problem(bouc_wen(), series);
      ModalSolver base(problem.system);
      Stepper stepper(problem.system, base, {.tolerance = tolerance, .scheme = GetParam().scheme, .max_step = 0.01});
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.system.size());
      stepper.start(0, zero, zero);
      test::march(stepper, end, 0.01);
      const State& state = stepper.view().state();
      Eigen::VectorXd found(4);
      found << state.u.head(2), 0.1 * state.v.head(2);
      errors.push_back((found - motion).norm() / motion.norm());
      if (series > 0) {
        EXPECT_NEAR(state.u[2], expected[4], 100 * tolerance * expected.segment(4, 2).norm()) << "the massless node";
      }
      const Energies e = stepper.view().energies();
      EXPECT_GT(e.hysteretic, 0.3 * e.input);
      EXPECT_LT(std::abs(e.imbalance()), 10 * tolerance * e.input);
    }
    const char* where = series > 0 ? "in series with a massless node" : "on the mass";
    book.below(fmt::format("{}: displacements and velocities, difference over size [-]", where), errors[1], 1e-5);
    EXPECT_GT(errors[0] / errors[1], 10) << where;
  }
}

TEST_P(Coupled, AnIsolatorBesideAContactAgreesWithAnIndependentIntegration) {
  constexpr double end = 1.2, gap = 0.01, wall = 4e7;
  const Eigen::VectorXd expected = direct(end, 0, gap, wall);
  Problem problem(bouc_wen());
  problem.add_wall(gap, wall);
  ModalSolver base(problem.system);
  Stepper stepper(problem.system, base, {.tolerance = 1e-6, .scheme = GetParam().scheme, .max_step = 0.01});
  stepper.start(0, Vector2d::Zero(), Vector2d::Zero());
  test::march(stepper, end, 0.01);
  EXPECT_GT(stepper.view().memory().contacts[0].impacts().size(), 0u);
  EXPECT_LT((stepper.view().state().u - expected.head(2)).norm(), 1e-4 * expected.head(2).norm());
  const Energies e = stepper.view().energies();
  EXPECT_LT(std::abs(e.imbalance()), 1e-5 * e.input);
}

// A state between two steps is a value: a stepper of the same system that reads it makes the same steps.
TEST_P(Coupled, ContinueFromASavedStateWithTheSameBits) {
  for (const bool slides : {false, true}) {
    const auto make = [&]() -> std::unique_ptr<Element> {
      if (!slides) return bouc_wen();
      return std::make_unique<CoupledPendulum>(
          SlidingFriction{.weight = 9.81 * mass, .radius = 2, .slow = 0.04, .fast = 0.08, .rate = 60});
    };
    Problem problem(make());
    problem.add_wall(0.01, 4e7);
    ModalSolver base(problem.system), other_base(problem.system);
    const StepperOptions options{.tolerance = 1e-4, .scheme = GetParam().scheme, .max_step = 0.01};
    Stepper stepper(problem.system, base, options), other(problem.system, other_base, options);
    for (Stepper* each : {&stepper, &other}) each->start(0, Vector2d::Zero(), Vector2d::Zero());
    test::march_evenly(stepper, 0.6, 0.01);
    other.restore(stepper.save());
    for (Stepper* each : {&stepper, &other}) test::march_evenly(*each, 1.2, 0.01);
    EXPECT_EQ(stepper.view().state().u, other.view().state().u);
    EXPECT_EQ(stepper.view().state().v, other.view().state().v);
    EXPECT_EQ(stepper.view().energies().hysteretic, other.view().energies().hysteretic);
    EXPECT_GT(stepper.view().energies().hysteretic, 0);
  }
}

// Friction along the direction of sliding: on a circular path of the ground the loss is the friction times the path.
TEST(CoupledPendulum, ClosesItsEnergiesInTheTimeIntegration) {
  Problem problem(std::make_unique<CoupledPendulum>(
      SlidingFriction{.weight = 9.81 * mass, .radius = 2, .slow = 0.04, .fast = 0.08, .rate = 60}));
  ModalSolver base(problem.system);
  Stepper stepper(problem.system, base, {.tolerance = 1e-5, .max_step = 0.01});
  stepper.start(0, Vector2d::Zero(), Vector2d::Zero());
  test::march(stepper, 3, 0.01);
  const Energies e = stepper.view().energies();
  EXPECT_GT(e.hysteretic, 0.5 * e.input);
  EXPECT_LT(std::abs(e.imbalance()), 1e-4 * e.input);
}

// Displacements at the instants of the reference, in both components of El Centro 1940.
double difference_in_el_centro(std::unique_ptr<Element> element, const test::BearingReference& expected) {
  std::vector<GroundMotion> motions;
  for (const char* component : {"ELC180-hor1", "ELC270-hor2"}) {
    Samples samples;
    samples.accelerations = test::el_centro(component);
    if (samples.accelerations.empty()) {
      ADD_FAILURE() << "missing record; run `make python` to install it";
      return 1;
    }
    for (std::size_t i = 0; i < samples.accelerations.size(); ++i)
      samples.times.push_back(0.01 * static_cast<double>(i));
    motions.emplace_back(std::move(samples));
  }
  Problem problem(std::move(element), 0, std::move(motions));
  ModalSolver base(problem.system);
  Stepper stepper(problem.system, base, {.tolerance = 1e-6, .max_step = 0.01});
  stepper.start(0, Vector2d::Zero(), Vector2d::Zero());
  double worst = 0;
  for (std::size_t n = 0; n < test::bearing_instants.size(); ++n) {
    StepController controller(stepper);
    ErrorControl policy(0.01);
    double h = 1e-3;
    while (stepper.view().time() < test::bearing_instants[n])
      h = controller.advance(h, test::bearing_instants[n], policy);
    for (int i = 0; i < 2; ++i)
      worst = std::max(worst, std::abs(stepper.view().state().u[i] - expected.values[n + 1][i]));
  }
  return worst / std::max(expected.values[0][0], expected.values[0][1]);
}

TEST(CoupledIsolators, InTheTimeIntegrationAgreeWithOpenSees) {
  test::Book book("Mass on an isolator in two directions, both components of El Centro 1940",
                  "OpenSees, refined steps (tests/verification/opensees/bearings.py)",
                  "1e-3 of the peak; the reference is converged to 1e-4");
  const double weight = 1e5 * 9.80665, k2 = 0.6e6, dy = 8e-3, stiff = 0.05 * weight / dy + k2;
  book.below(
      "elastomericBearingBoucWen in the time integration, displacements / peak [-]",
      difference_in_el_centro(std::make_unique<CoupledBoucWen>(hysteresis::BoucWen{
                                  .initial_stiffness = stiff, .yield_force = stiff * dy, .hardening = k2 / stiff}),
                              test::bouc_wen),
      1e-3);
  book.below(
      "singleFPBearing in the time integration, displacements / peak [-]",
      difference_in_el_centro(
          std::make_unique<CoupledPendulum>(SlidingFriction{
              .weight = weight, .radius = 2, .slow = 0.06, .fast = 0.06, .rate = 20, .sliding_deformation = 1e-3}),
          test::pendulum),
      1e-3);
}

}  // namespace coupled_elements_test
}  // namespace pounding
