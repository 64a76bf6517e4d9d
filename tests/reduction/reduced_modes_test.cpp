// Reduced structures against all their natural modes, dense matrices and the closed form of a rod that hits a wall.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include <pounding/frames/frame.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/reduction/reduced_modes.hpp>
#include <pounding/stepping/step_controller.hpp>
#include <pounding/structures/damping.hpp>
#include <pounding/structures/massless.hpp>
#include "support/dense.hpp"

namespace pounding {
namespace reduced_modes_test {

using petsc::ReducedDepth;
using petsc::ReducedInputs;
using petsc::ReducedModes;

// A plane frame of eight storeys and two bays, with contacts at the ends of its floors. Rotations have no mass unless
// it is consistent.
struct Tower {
  SparseMatrix mass, stiffness;
  ReducedInputs inputs;
  Eigen::VectorXd rotation;  // a couple at the roof

  explicit Tower(bool consistent) {
    GridFrame grid;
    grid.storeys = 8;
    grid.bays_x = 2;
    grid.storey_height = {3.2};
    grid.bay_width_x = {6.0};
    grid.column = Section{.area = 0.3, .inertia_y = 5e-3};
    grid.beam = Section{.area = 0.18, .inertia_y = 2.5e-3};
    grid.material = {.young = 25e9, .shear = 10e9, .density = consistent ? 2500.0 : 0.0};
    grid.mass = consistent ? BeamMass::consistent : BeamMass::lumped;
    grid.floor_mass = {72e3};
    const AssembledFrame frame = make_frame(grid).assemble();
    mass = frame.mass;
    stiffness = frame.stiffness;
    inputs.links = Eigen::MatrixXd::Zero(size(), 2);
    inputs.links.col(0) = frame.motion(grid.node(8, 2), Dof::ux).toDense();
    inputs.links.col(1) = frame.motion(grid.node(5, 2), Dof::ux).toDense();
    rotation = frame.motion(grid.node(8, 2), Dof::ry).toDense();
    inputs.ground = frame.load.leftCols(1);
    inputs.shift = std::pow(2 * std::numbers::pi * 20, 2);
  }

  int size() const { return static_cast<int>(mass.rows()); }
  ReducedModes reduced() const { return {mass, stiffness, inputs}; }
  // B^T (K + s M)^-1 B of the structure.
  Eigen::MatrixXd flexibility(double s) const {
    const Eigen::MatrixXd a = Eigen::MatrixXd(stiffness) + s * Eigen::MatrixXd(mass);
    return inputs.links.transpose() * test::dense::solve_columns(a, inputs.links);
  }
  // B^T (K + s M)^-1 B of its modes.
  Eigen::MatrixXd flexibility(const GroupModes& modes, double s) const {
    const Eigen::MatrixXd b = modes.shapes.transpose() * inputs.links;
    return b.transpose() * (modes.squares.array() + s).inverse().matrix().asDiagonal() * b;
  }
};

class ReducedTower : public testing::TestWithParam<bool> {
 protected:
  Tower tower{GetParam()};
};

TEST_P(ReducedTower, HasTheNaturalModesWhereAllBlocksAreTaken) {
  ReducedModes reduced = tower.reduced();
  tower.inputs.links.setIdentity(tower.size(), tower.size());
  ReducedModes by_all_unknowns = tower.reduced();
  const int count = reduced.maximum();
  EXPECT_EQ(count, static_cast<int>(split_by_mass(tower.mass).dynamic.size()));
  const Eigenmodes natural = dense_modes(tower.mass, tower.stiffness, count);
  const GroupModes all = by_all_unknowns.modes({.links = 2, .ground = 1});
  ASSERT_EQ(all.squares.size(), count);
  for (int i = 0; i < count; ++i)
    EXPECT_NEAR(all.squares[i], std::pow(natural.frequencies[i], 2), 1e-9 * std::pow(natural.frequencies[count - 1], 2))
        << i;
  EXPECT_NEAR(std::sqrt(all.squares[0]), natural.frequencies[0], 1e-6 * natural.frequencies[0]);
}

TEST_P(ReducedTower, IsNormalByTheMassAndFollowsWhereNoneIs) {
  const GroupModes modes = tower.reduced().modes({});
  const Eigen::Index m = modes.squares.size();
  ASSERT_GT(m, 20);
  EXPECT_LT(
      (modes.shapes.transpose() * tower.mass * modes.shapes - Eigen::MatrixXd::Identity(m, m)).cwiseAbs().maxCoeff(),
      1e-11);
  const Eigen::MatrixXd k = modes.shapes.transpose() * tower.stiffness * modes.shapes;
  EXPECT_LT((k - Eigen::MatrixXd(modes.squares.asDiagonal())).cwiseAbs().maxCoeff(), 1e-11 * modes.squares.maxCoeff());
  const Eigen::MatrixXd forces = tower.stiffness * modes.shapes;
  const std::vector<int> massless = split_by_mass(tower.mass).massless;
  EXPECT_EQ(massless.empty(), GetParam());
  for (const int i : massless)
    EXPECT_LT(forces.row(i).cwiseAbs().maxCoeff(), 1e-10 * forces.cwiseAbs().maxCoeff()) << i;
}

// Adding the directions of one block gives the modes of the next depth.
TEST_P(ReducedTower, FindsTheDirectionsOfOneBlockMore) {
  ReducedModes reduced = tower.reduced();
  const ReducedDepth depth{.links = 3, .ground = 4};
  const petsc::FurtherDirections of = reduced.further(depth);
  const GroupModes modes = reduced.modes(depth), deeper = tower.reduced().modes({.links = 4, .ground = 4});
  const Eigen::Index m = modes.squares.size(), more = of.own.cols();
  ASSERT_EQ(m + more, deeper.squares.size());
  EXPECT_EQ(of.squares, modes.squares);
  Eigen::MatrixXd both(m + more, m + more);
  both << Eigen::MatrixXd(of.squares.asDiagonal()), of.coupling, of.coupling.transpose(), of.own;
  // A direction of which 1e-9 remains after orthogonalization has a round-off of 1e-7, which depends on the order.
  EXPECT_LT((test::dense::eigenvalues(both) - deeper.squares).cwiseAbs().maxCoeff(), 1e-6 * deeper.squares.maxCoeff());
  Eigen::MatrixXd links(m + more, 2);
  links << of.links, of.further_links;
  EXPECT_LT((links.transpose() * test::dense::solve_columns(both, links) - tower.flexibility(0)).cwiseAbs().maxCoeff(),
            1e-9 * tower.flexibility(0).maxCoeff());
  EXPECT_LT((of.links - modes.shapes.transpose() * tower.inputs.links).cwiseAbs().maxCoeff(),
            1e-10 * of.links.cwiseAbs().maxCoeff());
}

TEST_P(ReducedTower, AnswersStaticForcesOfLinksAndGroundExactly) {
  const GroupModes modes = tower.reduced().modes({.links = 1, .ground = 1, .shifted = false});
  EXPECT_EQ(modes.squares.size(), 3);
  Eigen::MatrixXd loads(tower.size(), 3);
  loads << tower.inputs.links, tower.inputs.ground;
  const Eigen::MatrixXd exact = test::dense::solve_columns(tower.stiffness, loads);
  const Eigen::MatrixXd found =
      modes.shapes * modes.squares.cwiseInverse().asDiagonal() * (modes.shapes.transpose() * loads);
  const std::vector<int> dynamic = split_by_mass(tower.mass).dynamic;
  EXPECT_LT((found - exact)(dynamic, Eigen::all).cwiseAbs().maxCoeff(), 1e-9 * exact.cwiseAbs().maxCoeff());
}

// Galerkin modes omit some of the flexibility at the ends; each additional block restores a fraction.
TEST_P(ReducedTower, IsNeverSofterAtItsLinksThanTheStructure) {
  ReducedModes reduced = tower.reduced();
  const std::vector<ReducedDepth> depths{{1, 1, false}, {2, 1, false}, {4, 10, false}, {4, 10, true}};
  for (const double frequency : {0.0, 0.5, 2.0, 10.0, 20.0, 50.0, 200.0}) {
    const double s = std::pow(2 * std::numbers::pi * frequency, 2);
    const Eigen::MatrixXd exact = tower.flexibility(s);
    double last = 1e300;
    for (const ReducedDepth& depth : depths) {
      const Eigen::MatrixXd missing = exact - tower.flexibility(reduced.modes(depth), s);
      const Eigen::VectorXd parts = test::dense::eigenvalues(missing);
      EXPECT_GT(parts[0], -1e-9 * exact.norm()) << frequency;
      EXPECT_LT(missing.trace(), last + 1e-9 * exact.norm()) << frequency;
      last = missing.trace();
    }
    if (frequency <= 50) {
      EXPECT_LT(last, 2e-3 * exact.trace()) << frequency << ", up to slightly above the shift";
    }
    if (frequency == 20.0) {
      EXPECT_LT(last, 1e-9 * exact.trace()) << "the shifted block is exact there";
    }
  }
}

TEST_P(ReducedTower, HoldsWhereItStarts) {
  tower.inputs.starts = Eigen::MatrixXd::Zero(tower.size(), 2);
  const std::vector<int> dynamic = split_by_mass(tower.mass).dynamic;
  for (std::size_t i = 0; i < dynamic.size(); ++i)
    tower.inputs.starts(dynamic[i], 0) = std::sin(1.3 * static_cast<double>(i));
  const GroupModes modes = tower.reduced().modes({});
  const Eigen::VectorXd start = tower.inputs.starts.col(0);
  const Eigen::VectorXd again = modes.shapes * (modes.shapes.transpose() * (tower.mass * start));
  for (const int i : dynamic) EXPECT_NEAR(again[i], start[i], 1e-9) << i;
  tower.inputs.starts.resize(0, 0);
  EXPECT_EQ(tower.reduced().modes({}).squares.size() + 1, modes.squares.size());
}

TEST_P(ReducedTower, HasTheSameBitsTwiceAndWhereItIsMadeDeeper) {
  ReducedModes once = tower.reduced(), twice = tower.reduced();
  const GroupModes shallow = twice.modes({.links = 2, .ground = 3});
  const GroupModes a = once.modes({}), b = twice.modes({});
  EXPECT_LT(shallow.squares.size(), a.squares.size());
  EXPECT_EQ(a.shapes, b.shapes);
  EXPECT_EQ(a.squares, b.squares);
  EXPECT_EQ(twice.modes({.links = 2, .ground = 3}).shapes, shallow.shapes);
}

// The shadow is a combination of the modes of the run and equals the result of a reduction with its blocks. (Very deep
// chains, whose directions nearly coincide, differ by more: the differences are near round-off.)
TEST_P(ReducedTower, HoldsTheModesOfItsShadow) {
  tower.inputs.starts = Eigen::VectorXd::LinSpaced(tower.size(), 0, 1);
  const ReducedDepth depth{.links = 3, .ground = 3}, less{.links = 2, .ground = 1};
  ReducedModes reduced = tower.reduced();
  const GroupModes whole = reduced.modes(depth), alone = tower.reduced().modes(less);
  const ShadowModes shadow = reduced.shadow(depth, less);
  const Eigen::Index count = alone.squares.size();
  EXPECT_EQ(reduced.count(depth, less), count);
  ASSERT_EQ(shadow.squares.size(), count);
  ASSERT_LT(count, whole.squares.size());
  EXPECT_LT(
      (shadow.in_modes.transpose() * shadow.in_modes - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(),
      1e-12);
  for (Eigen::Index i = 0; i < count; ++i)
    EXPECT_NEAR(shadow.squares[i], alone.squares[i], 1e-9 * alone.squares[i]) << i;
  for (const double frequency : {0.0, 2.0, 20.0}) {
    const double s = std::pow(2 * std::numbers::pi * frequency, 2);
    const Eigen::MatrixXd exact = tower.flexibility(alone, s),
                          found = tower.flexibility({whole.shapes * shadow.in_modes, shadow.squares}, s);
    EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-9 * exact.cwiseAbs().maxCoeff()) << frequency;
  }
}

// Each input in turn changes: reused blocks must be right for the new ones.
TEST_P(ReducedTower, HasTheBitsOfANewOneWhereItIsDrivenOtherwise) {
  ReducedModes reduced = tower.reduced();
  const GroupModes first = reduced.modes({});
  const ReducedInputs before = tower.inputs;
  ReducedInputs links = before, ground = before, shift = before, starts = before;
  links.links.col(0) *= -1;
  links.links(0, 1) = 0.5;
  ground.ground(0, 0) += 1e4;
  shift.shift *= 4;
  starts.starts = Eigen::VectorXd::LinSpaced(tower.size(), 0, 1);
  for (const ReducedInputs& inputs : {links, ground, shift, starts, before}) {
    tower.inputs = inputs;
    reduced.drive(inputs);
    const GroupModes again = reduced.modes({}), by_itself = tower.reduced().modes({});
    EXPECT_EQ(again.shapes, by_itself.shapes);
    EXPECT_EQ(again.squares, by_itself.squares);
    EXPECT_EQ(inputs == before, again.squares.size() == first.squares.size() && again.squares == first.squares);
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, ReducedTower, testing::Bool(),
                         [](const auto& test) { return test.param ? "consistent" : "lumped"; });

// A couple on a massless rotation rotates it without delay, which is S of a spring there; the modes contain the
// response of the other unknowns.
TEST(ReducedModes, FollowAForceAtAnUnknownWithoutMass) {
  Tower tower(false);
  tower.inputs.links.conservativeResize(Eigen::NoChange, 3);
  tower.inputs.links.col(2) = tower.rotation;
  const GroupModes modes = tower.reduced().modes({.links = 6, .ground = 1});
  const MassSplit dofs = split_by_mass(tower.mass);
  const Eigen::VectorXd pushed = tower.rotation(dofs.massless);
  ASSERT_GT(pushed.norm(), 0);
  const Eigen::MatrixXd own = dense_submatrix(tower.stiffness, dofs.massless, dofs.massless);
  const double at_once = pushed.dot(test::dense::solve(own, pushed));
  const Eigen::MatrixXd exact = tower.flexibility(0), found = tower.flexibility(modes, 0);
  EXPECT_NEAR(found(2, 2) + at_once, exact(2, 2), 1e-9 * exact(2, 2));
  EXPECT_GT(at_once, 0.1 * exact(2, 2)) << "without it the hinge would be far too stiff";
  EXPECT_NEAR(found(2, 0), exact(2, 0), 1e-9 * std::abs(exact(2, 0)));
}

TEST(ReducedModes, RefuseWhatNothingHolds) {
  Tower tower(false);
  SparseMatrix loose(2, 2), mass(2, 2);
  loose.insert(0, 0) = 1, loose.insert(0, 1) = -1, loose.insert(1, 0) = -1, loose.insert(1, 1) = 1;
  mass.setIdentity();
  ReducedInputs inputs;
  inputs.links = Eigen::MatrixXd::Identity(2, 1);
  EXPECT_THROW(ReducedModes(mass, loose, inputs), std::invalid_argument);
  EXPECT_THROW(ReducedModes(tower.mass, tower.stiffness, inputs), std::invalid_argument);
  EXPECT_THROW(ReducedModes(loose, mass, {}), std::invalid_argument);
  EXPECT_THROW(Tower(true).reduced().drive(inputs), std::invalid_argument);
}

TEST(ReducedModes, OfAStructureThatNothingMovesAreThereStill) {
  Tower tower(true);
  tower.inputs = {};
  EXPECT_GT(tower.reduced().modes({}).squares.size(), 0);
}

// A rod of forty equal masses m between forty springs k, fixed at its foot, moves at 1 m/s towards a wall that touches
// its end through another spring k. In contact the rod is a chain fixed at both ends, with the shapes sin(j r pi / 41)
// and the frequencies 2 sqrt(k/m) sin(r pi / 82).
class Rod {
 public:
  static constexpr int masses = 40;
  static constexpr double m = 100, k = 4e7;  // [kg], [N/m]

  Rod() : contact_(laws::LinearSpring{.stiffness = k}, 0.0, 0) {
    system.mass.resize(masses, masses);
    system.stiffness.resize(masses, masses);
    system.damping.resize(masses, masses);
    for (int i = 0; i < masses; ++i) {
      system.mass.insert(i, i) = m;
      system.stiffness.insert(i, i) = i + 1 < masses ? 2 * k : k;
      if (i + 1 < masses) system.stiffness.insert(i, i + 1) = -k;
      if (i > 0) system.stiffness.insert(i, i - 1) = -k;
    }
    system.gap_jacobian.resize(masses, 1);
    system.gap_jacobian.insert(masses - 1, 0) = 1;
    system.contacts = {&contact_};
    system.load.resize(masses, 0);
    system.groups = {{.first = 0, .count = masses, .displacement_floor = 1e-6, .velocity_floor = 1e-3}};
  }

  // Force in the wall spring at a time during contact [N].
  static double closed_form(double time) {
    double displacement = 0;
    for (int r = 1; r <= masses; ++r) {
      double part = 0;
      for (int j = 1; j <= masses; ++j) part += std::sin(j * r * std::numbers::pi / (masses + 1));
      const double w = 2 * std::sqrt(k / m) * std::sin(r * std::numbers::pi / (2 * (masses + 1)));
      displacement +=
          2.0 / (masses + 1) * part * std::sin(w * time) / w * std::sin(masses * r * std::numbers::pi / (masses + 1));
    }
    return k * displacement;
  }

  // Maximum error of the force at accepted steps until `end`, relative to the maximum force.
  double error(const ReducedDepth& depth, double end) {
    ReducedInputs inputs;
    inputs.links = Eigen::MatrixXd(system.gap_jacobian);
    inputs.starts = Eigen::VectorXd::Ones(masses);
    inputs.shift = 2 * k / m;
    const auto modes =
        std::make_shared<const GroupModes>(ReducedModes(system.mass, system.stiffness, inputs).modes(depth));
    ModalSolver solver(system, {ReducedGroup{.modes = modes}});
    coordinates = solver.size();
    Stepper stepper(system, solver, {.tolerance = 1e-8, .max_step = 1e-3});
    stepper.start(0, Eigen::VectorXd::Zero(masses), Eigen::VectorXd::Ones(masses));
    StepController controller(stepper);
    ErrorControl policy(1e-3);
    double worst = 0, largest = 0;
    for (double h = 1e-6; stepper.view().time() < end;) {
      h = controller.advance(h, end, policy);
      worst = std::max(worst, std::abs(stepper.view().link_forces()[0] - closed_form(stepper.view().time())));
      largest = std::max(largest, std::abs(closed_form(stepper.view().time())));
    }
    return worst / largest;
  }

  System system;
  int coordinates = 0;

 private:
  GapContact<laws::LinearSpring> contact_;
};

TEST(RodOnAWall, PressesAsItsClosedFormWithAllBlocks) {
  const double end = 0.9 * Rod::masses / std::sqrt(Rod::k / Rod::m);  // duration of a wave across the rod
  Rod rod;
  EXPECT_LT(rod.error({.links = 40, .ground = 0}, end), 1e-6);
  EXPECT_EQ(rod.coordinates, Rod::masses);
}

// Without damping every mode that the impact excites must be present: the error decreases slowly, then abruptly.
TEST(RodOnAWall, ConvergesWithTheBlocks) {
  const double end = 0.9 * Rod::masses / std::sqrt(Rod::k / Rod::m);
  double last = 2;
  for (const int blocks : {4, 12, 24, 34}) {
    const double error = Rod().error({.links = blocks, .ground = 0}, end);
    EXPECT_LT(error, last) << blocks;
    last = error;
  }
  EXPECT_LT(last, 1e-4);
}

}  // namespace reduced_modes_test
}  // namespace pounding
