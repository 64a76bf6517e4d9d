// The shadow of reduced structures: it moves as they do if it has the same modes, and does not affect them.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <pounding/reduction/reduce.hpp>
#include <pounding/reduction/shadowed_solver.hpp>
#include <pounding/stepping/step_controller.hpp>
#include "support/models.hpp"

namespace pounding {
namespace shadow_test {

// Two plane frames with contacts at two floors, on a ground motion that counts as short for `wave` below 0.2 s.
std::string pair(double wave, const std::string& friction = "") {
  const auto frame = [&](const std::string& name, double origin, double mass) {
    return fmt::format(
        "  {}: {{frame: {{origin: [{}], material: {{E: 30 GPa}}, grid: {{storeys: 12, bays: 2, storey_height: 3.2, "
        "bay_width: 6, columns: "
        "{{rectangle: [0.6, 0.6]}}, beams: {{rectangle: [0.3, 0.6]}}, floor_mass: {} t}}}}, damping: 5 %}}\n",
        name, origin, mass);
  };
  const double gap = 0.01 * std::min(1.0, wave);
  return fmt::format("ground_motion: {{harmonic: {{amplitude: {}, period: {}, duration: 2}}}}\nstructures:\n",
                     wave < 0.2 ? 20 : 3, wave) +
         frame("left", 0, 80) + frame("right", 12 + gap, 40) +
         fmt::format(
             "links:\n  - {{between: [left.12, right.12], gap: {0}, law: hertz_damped, stiffness: 2.75e9, restitution: "
             "0.65{1}}}\n"
             "  - {{between: [left.6, right.6], gap: {0}, law: hertz_damped, stiffness: 2.75e9, restitution: "
             "0.65{1}}}\nanalysis: {{duration: 2}}\n",
             gap, friction);
}

void keep(ReducedGroups&) {}
void leave_out(ReducedGroups& groups) {
  for (auto& group : groups)
    if (group) group->shadow.reset();
}
void make_equal(ReducedGroups& groups) {
  for (auto& group : groups)
    if (group) {
      const Eigen::Index count = group->modes->squares.size();
      group->shadow = std::make_shared<const ShadowModes>(
          ShadowModes{Eigen::MatrixXd::Identity(count, count), group->modes->squares});
    }
}

struct Followed {
  Model model;
  System system;
  std::unique_ptr<StructureSolver> solver;
  const ShadowedSolver* shadowed = nullptr;  // null without a shadow
  std::unique_ptr<Stepper> stepper;
  double hardest = 0;           // force of all links [N]
  double stray = 0;             // of the penetrations of the shadow in contact [m]
  double hardest_friction = 0;  // of all links [N]
  double stray_sliding = 0;     // of the sliding velocities in contact [m/s]
  double stray_floors = 0;      // of displacements of its floors [m]
  double largest = 0;           // displacement of all floors [m]

  using Change = void (*)(ReducedGroups& groups);

  // `dashpot`: from one floor of the left frame to the ground [N s/m].
  Followed(const std::string& text, Change change,
           const Reduction& right = {.kind = Reduction::Kind::blocks, .links = 3, .ground = 6}, double dashpot = 0)
      : model(test::model_of(text)), system(assemble(model)) {
    if (dashpot > 0) {
      const int at = static_cast<int>(SparseMatrix::InnerIterator(system.gap_jacobian, 0).row());
      system.damping.coeffRef(at, at) += dashpot;
    }
    const auto [u, v] = initial_state(model);
    const Reduction blocks{.kind = Reduction::Kind::blocks, .links = 3, .ground = 6};
    std::optional<ReducedGroups> groups =
        petsc::reduced_groups(system, {{"left", "right"}, {blocks, right}, u, v, 1e-4});
    change(*groups);
    if (change == leave_out)
      solver = std::make_unique<ModalSolver>(system, *groups);
    else
      solver = std::make_unique<ShadowedSolver>(system, *groups);
    shadowed = dynamic_cast<const ShadowedSolver*>(solver.get());
    stepper = std::make_unique<Stepper>(system, *solver, StepperOptions{.tolerance = 1e-4, .max_step = 0.01});
    stepper->start(0, u, v);
    StepController controller(*stepper);
    ErrorControl policy(0.01);
    double h = 1e-4;
    while (stepper->view().time() < 2) {
      h = controller.advance(h, 2, policy);
      look();
    }
  }

  void look() {
    const Instant& end = stepper->view().instant_end_minus();
    Eigen::MatrixXd closings = end.relative, motion = stepper->view().outputs_end_minus().motion.leftCols(2);
    if (shadowed) {
      shadowed->gather_shadow(end.motion.leftCols(2), closings);
      shadowed->observe_shadow(end.motion.leftCols(2), motion);
    }
    const Eigen::MatrixXd& own = stepper->view().outputs_end_minus().motion;
    stray_floors = std::max(stray_floors, (own.leftCols(2) - motion).col(0).cwiseAbs().maxCoeff());
    largest = std::max(largest, own.col(0).cwiseAbs().maxCoeff());
    for (int i = 0; i < system.contact_count(); ++i) {
      const double force = stepper->view().link_steps()[i].force_end;
      hardest = std::max(hardest, force);
      if (force > 0) stray = std::max(stray, std::abs(end.relative(i, 0) - closings(i, 0)));
    }
    for (const Friction& friction : system.frictions) {
      if (!(stepper->view().link_steps()[friction.contact].force_end > 0)) continue;
      hardest_friction = std::max(hardest_friction, std::abs(stepper->view().link_steps()[friction.first].force_end));
      stray_sliding = std::max(stray_sliding, std::abs(end.relative(friction.first, 1) - closings(friction.first, 1)));
    }
  }
};

class Shadow : public testing::TestWithParam<double> {};

TEST_P(Shadow, LeavesTheBitsOfTheRun) {
  const Followed with(pair(GetParam()), keep), without(pair(GetParam()), leave_out);
  ASSERT_GT(with.hardest, 1e5);
  EXPECT_GT(with.solver->size(), without.solver->size());
  EXPECT_EQ(with.hardest, without.hardest);
  EXPECT_EQ(with.stepper->view().outputs().motion, without.stepper->view().outputs().motion);
  const Energies a = with.stepper->view().energies(), b = without.stepper->view().energies();
  EXPECT_EQ(a.input, b.input);
  EXPECT_EQ(a.damping, b.damping);
  EXPECT_EQ(a.kinetic, b.kinetic);
  EXPECT_EQ(a.strain, b.strain);
}

TEST_P(Shadow, MovesAsTheRunWhereItsModesAreTheSame) {
  const Followed same(pair(GetParam()), make_equal), less(pair(GetParam()), keep);
  ASSERT_GT(same.hardest, 1e5);
  EXPECT_LT(same.stray, 1e-13);
  EXPECT_LT(same.stray_floors, 1e-12 * same.largest);
  EXPECT_GT(less.stray, 1e-8);
  EXPECT_GT(less.stray_floors, 1e-7 * less.largest);
}

INSTANTIATE_TEST_SUITE_P(Waves, Shadow, testing::Values(0.9, 0.05));

TEST(ShadowOfLinksThatRub, MovesAsTheRunWhereItsModesAreTheSame) {
  const Followed same(pair(0.9, ", friction: 0.3"), make_equal), less(pair(0.9, ", friction: 0.3"), keep);
  ASSERT_GT(same.hardest, 1e5);
  ASSERT_GT(same.hardest_friction, 1e4);
  EXPECT_LT(same.stray, 1e-13);
  EXPECT_LT(same.stray_sliding, 1e-11);
  EXPECT_GT(less.stray_sliding, 1e-7);
}

// A structure in all its modes has no shadow: its own motion takes the role.
TEST(ShadowBesideAllModes, TakesTheMotionOfAWholeStructure) {
  const Followed same(pair(0.9), make_equal, {}), less(pair(0.9), keep, {});
  EXPECT_EQ(same.solver->layout().reduced.size(), 1u);
  EXPECT_LT(same.stray, 1e-13);
  EXPECT_GT(less.stray, 1e-8);
}

// A non-classical dashpot couples the modes: such steps have a factorization for every block.
TEST(ShadowOfCoupledModes, MovesAsTheRunWhereItsModesAreTheSame) {
  const Reduction blocks{.kind = Reduction::Kind::blocks, .links = 3, .ground = 6};
  const Followed same(pair(0.9), make_equal, blocks, 1e6);
  ASSERT_GT(same.hardest, 1e5);
  EXPECT_NE(same.solver->description().find("coupled"), std::string::npos);
  EXPECT_LT(same.stray, 1e-13);
  EXPECT_LT(same.stray_floors, 1e-12 * same.largest);
}

}  // namespace shadow_test
}  // namespace pounding
