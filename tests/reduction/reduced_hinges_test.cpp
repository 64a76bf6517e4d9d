// Reduced frames with hinges at massless rotations: the flexibility of the hinges against a frame assembled and solved
// here in full.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/reduction/reduced_modes.hpp>
#include <pounding/stepping/step_controller.hpp>
#include "support/dense.hpp"
#include "support/hinge_frame.hpp"

namespace pounding {
namespace reduced_hinges_test {

using test::HingeFrame;

// Twelve storeys with 26 hinges, all at massless rotations; 48 unknowns have mass.
struct Reduced {
  HingeFrame frame;
  std::unique_ptr<ModalSolver> solver;

  explicit Reduced(const petsc::ReducedDepth& depth, const GroundMotion& ground = {}) : frame({.storeys = 12}, ground) {
    const System& system = frame.system;
    const petsc::ReducedInputs inputs{
        .links = {}, .parts = Eigen::MatrixXd(system.gap_jacobian), .ground = system.load, .starts = {}};
    const GroupModes modes = petsc::ReducedModes(system.mass, system.stiffness, inputs).modes(depth);
    solver = std::make_unique<ModalSolver>(
        system, std::vector{std::optional(ReducedGroup{.modes = std::make_shared<const GroupModes>(modes)})});
  }

  // B^T (K + s M)^-1 B of all hinges, with all terms of the solver.
  Eigen::MatrixXd compliance(double s) {
    std::vector<int> hinges(static_cast<std::size_t>(frame.hinges()));
    for (int i = 0; i < frame.hinges(); ++i) hinges[static_cast<std::size_t>(i)] = i;
    Eigen::MatrixXd of_modes;
    solver->set_matrix({.mass = s, .damping = 0, .stiffness = 1}, std::nullopt);
    EXPECT_TRUE(solver->flexibility(hinges, of_modes));
    return of_modes + Eigen::MatrixXd(solver->layout().relief.flexibility());
  }
  // Compliance of all hinges in the assembled frame.
  Eigen::MatrixXd exact(double s) const {
    const Eigen::MatrixXd a = Eigen::MatrixXd(frame.system.stiffness) + s * Eigen::MatrixXd(frame.system.mass),
                          b = Eigen::MatrixXd(frame.system.gap_jacobian);
    return b.transpose() * test::dense::solve_columns(a, b);
  }
};

double square(double frequency) { return std::pow(2 * std::numbers::pi * frequency, 2); }

TEST(ReducedHinges, GiveWayToEachOtherAsInTheWholeFrame) {
  Reduced reduced({.links = 0, .ground = 4, .shifted = false, .parts = 1});
  EXPECT_LT(reduced.solver->size(), 32);
  const Eigen::MatrixXd exact = reduced.exact(0), found = reduced.compliance(0);
  EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-9 * exact.cwiseAbs().maxCoeff());
  // Without S they would be far too stiff: it is a large fraction of the flexibility of a hinge.
  const Eigen::MatrixXd at_once = Eigen::MatrixXd(reduced.solver->layout().relief.flexibility());
  EXPECT_GT((at_once.diagonal().array() / exact.diagonal().array()).minCoeff(), 0.2);
}

// With inertia, each additional block brings the hinges closer to the frame, from the stiff side.
TEST(ReducedHinges, AreNeverSofterThanInTheWholeFrame) {
  for (const double frequency : {0.5, 2.0, 5.0, 10.0}) {
    double last = 1;
    for (const int ground : {1, 6}) {
      Reduced reduced({.links = 0, .ground = ground, .shifted = false, .parts = 1});
      const Eigen::MatrixXd exact = reduced.exact(square(frequency)),
                            missing = exact - reduced.compliance(square(frequency));
      EXPECT_GT(test::dense::eigenvalues(missing)[0], -1e-9 * exact.norm()) << frequency;
      const double error = missing.cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
      EXPECT_LE(error, last * (1 + 1e-9)) << frequency;
      last = error;
    }
    EXPECT_LT(last, 0.05) << frequency;
    Reduced deeper({.links = 0, .ground = 4, .shifted = false, .parts = 2});
    const Eigen::MatrixXd exact = deeper.exact(square(frequency));
    EXPECT_LT((deeper.compliance(square(frequency)) - exact).cwiseAbs().maxCoeff(), 1e-9 * exact.cwiseAbs().maxCoeff())
        << "all modes at " << frequency;
  }
}

// While hinges yield, the massless rotations are in equilibrium with them, and each hinge rotates by the difference of
// its two sides.
TEST(ReducedHinges, StayInEquilibriumWhileTheyYield) {
  Reduced reduced({.links = 0, .ground = 4, .shifted = false, .parts = 1},
                  GroundMotion(Harmonic{.amplitude = 4, .period = 1.2, .duration = 2}));
  const System& system = reduced.frame.system;
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(system.size());
  double largest_way = 0, unbalanced = 0, apart = 0, turned = 0;
  const StepperOptions options{.tolerance = 1e-4, .max_step = 0.01};
  const test::HingeFrameRun run =
      test::run_hinge_frame(reduced.frame, *reduced.solver, options, 2, 0, [&](StepController& controller) {
        const State& state = controller.stepper().view().state();
        loads = system.stiffness * state.u + system.gap_jacobian * state.force;
        const Eigen::VectorXd turns = system.gap_jacobian.transpose() * state.u;
        for (int i = 0; i < system.size(); ++i)
          if (system.mass.coeff(i, i) == 0) unbalanced = std::max(unbalanced, std::abs(loads[i]));
        for (int i = 0; i < reduced.frame.hinges(); ++i)
          apart = std::max(apart, std::abs(controller.stepper().view().link_motion(i).penetration - turns[i]));
        turned = std::max(turned, turns.cwiseAbs().maxCoeff());
        largest_way =
            std::max(largest_way, (reduced.solver->layout().relief.flexibility() * state.force).cwiseAbs().maxCoeff());
      });
  EXPECT_GT(*std::ranges::max_element(run.ductility), 2);
  EXPECT_GT(largest_way, 0.1 * turned) << "the test would not notice a missing S";
  EXPECT_LT(apart, 1e-10 * turned);
  EXPECT_LT(unbalanced, 1e-9 * *std::ranges::max_element(run.peak_moment));
}

}  // namespace reduced_hinges_test
}  // namespace pounding
