// Elements with two deformations in the time integration: on masses, in series with massless unknowns, and together
// with contacts and springs of one deformation.

#include <gtest/gtest.h>

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

  // `series` > 0: stiffness between the mass and the node on the element [N/m].
  explicit Problem(std::unique_ptr<Element> on, double series = 0) : element(std::move(on)) {
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
    for (int i = 0; i < 2; ++i) {
      system.grounds.emplace_back(Harmonic{amplitude[i], period[i], duration});
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

  static double ground(int i, double t) {
    return t < duration ? amplitude[i] * std::sin(2 * pi * t / period[i]) : 0.0;
  }
};

constexpr double k = 1e7, yield_force = 1.5e5, yield = yield_force / k, hardening = 0.05;

// With g = 1 the rate of z is linear in that of d.
std::unique_ptr<Element> bouc_wen() {
  return std::make_unique<CoupledBoucWen>(hysteresis::BoucWen{
      .initial_stiffness = k, .yield_force = yield_force, .hardening = hardening, .gamma_share = 1});
}

// dz/dd of that law.
Eigen::Matrix2d flow(const Vector2d& z) { return Eigen::Matrix2d::Identity() - z * z.transpose() / (yield * yield); }

// u, v of the mass, d and z of the element; contact with a wall and its work.
Eigen::VectorXd direct(double end, double series, double gap, double wall) {
  const auto f = [&](double t, const Eigen::VectorXd& y) {
    const Vector2d u = y.head(2), v = y.segment(2, 2), z = y.segment(6, 2);
    const Vector2d d = series > 0 ? Vector2d(y.segment(4, 2)) : u;
    Vector2d force = hardening * k * d + (1 - hardening) * k * z;
    if (wall > 0) force[0] += wall * std::max(0.0, u[0] - gap);
    const Eigen::Matrix2d tangent = hardening * k * Eigen::Matrix2d::Identity() + (1 - hardening) * k * flow(z);
    const Vector2d rate =
        series > 0 ? Vector2d((series * Eigen::Matrix2d::Identity() + tangent).partialPivLu().solve(series * v)) : v;
    Eigen::VectorXd out(8);
    out << v, -force / mass - Vector2d(Problem::ground(0, t), Problem::ground(1, t)), rate, flow(z) * rate;
    return out;
  };
  return test::integrate(f, Eigen::VectorXd::Zero(8), 0, end, 0.05, {Problem::duration});
}

class Coupled : public testing::TestWithParam<test::NamedScheme> {};

INSTANTIATE_TEST_SUITE_P(Schemes, Coupled, testing::ValuesIn(test::schemes),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(Coupled, AMassOnAnIsolatorAgreesWithAnIndependentIntegration) {
  test::Book book("Elements with two deformations", "independent integration of the coupled Bouc-Wen equations",
                  "run at tolerance 1e-6");
  for (const double series : {0.0, 2e7}) {
    static constexpr double end = 2.5;
    const Eigen::VectorXd expected = direct(end, series, 0, 0);
    Problem problem(bouc_wen(), series);
    ModalSolver base(problem.system);
    Stepper stepper(problem.system, base, {.tolerance = 1e-6, .scheme = GetParam().scheme, .max_step = 0.01});
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.system.size());
    stepper.start(0, zero, zero);
    test::march(stepper, end, 0.01);
    const char* where = series > 0 ? "in series with a massless node" : "on the mass";
    book.below(fmt::format("{}: displacements, difference over size [-]", where),
               (stepper.view().state().u.head(2) - expected.head(2)).norm(), 2e-5 * expected.head(2).norm());
    book.below(fmt::format("{}: velocities, difference over size [-]", where),
               (stepper.view().state().v.head(2) - expected.segment(2, 2)).norm(), 2e-5 * expected.segment(2, 2).norm());
    if (series > 0)
      book.below("displacement of the massless node, difference over size [-]",
                 (stepper.view().state().u.tail(2) - expected.segment(4, 2)).norm(), 2e-5 * expected.segment(4, 2).norm());
    const Energies e = stepper.view().energies();
    EXPECT_GT(e.hysteretic, 0.3 * e.input);
    EXPECT_LT(std::abs(e.imbalance()), 1e-5 * e.input);
  }
}

TEST_P(Coupled, AnIsolatorBesideAContactAgreesWithAnIndependentIntegration) {
  constexpr double end = 1.2, gap = 0.03, wall = 4e7;
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
    problem.add_wall(0.03, 4e7);
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

}  // namespace coupled_elements_test
}  // namespace pounding
